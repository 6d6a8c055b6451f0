"""Reads what `coseg run --out DIR` leaves, and writes meshes for it. Knows nothing of Blender.

Faces keep the order of the input files, so that label k is that of face k. The coloured meshes DIR/ply/NAME.ply are
read, because the files that the run was given may have moved.
"""
import json
import os
import struct
from dataclasses import dataclass, field

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class RunError(Exception):
    """A sentence for the user: a folder or a file that cannot be used."""


@dataclass
class Shape:
    """A shape of a run: coordinates in the unit of its file, corners of polygons, the part of each face."""
    name: str
    vertices: list
    faces: list
    parts: list
    rotation: tuple = IDENTITY  #: by which it stands like the others


@dataclass
class Run:
    """`names` and `colors` (red, green, blue in 0 .. 255) are those of the parts."""
    folder: str
    names: list
    colors: list = field(default_factory=list)
    shapes: list = field(default_factory=list)


def exact_name(entry):
    """A name of report.json or alignment.json, whose bytes stand beside it where they are no UTF-8."""
    return os.fsdecode(bytes.fromhex(entry["name_bytes"])) if "name_bytes" in entry else entry["name"]


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read ({error}); choose the folder that coseg run was given with --out") from error


def read_names(folder, parts):
    """Of names.txt in the folder, one a line or `NUMBER NAME`; else part_0, part_1 and so on."""
    names = [f"part_{part}" for part in range(parts)]
    path = os.path.join(folder, "names.txt")
    if not os.path.exists(path):
        return names
    with open(path, encoding="utf-8-sig") as file:
        lines = [line.split() for line in file if line.strip()]
    numbered = all(len(words) > 1 and words[0].isdigit() for words in lines)
    for row, words in enumerate(lines):
        part = int(words[0]) if numbered else row
        if part < parts:
            names[part] = " ".join(words[1:] if numbered else words)
    return names


def read_labels(path, count):
    try:
        with open(path, encoding="ascii") as file:
            labels = [int(word) for word in file.read().split()]
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read ({error})") from error
    if len(labels) != count:
        raise RunError(f"{path}: has {len(labels)} labels for {count} faces")
    return labels


def read_ply(path):
    """Vertices, faces and a colour for each face of a coloured mesh as coseg writes it."""
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise RunError(f"{path}: cannot be read ({error})") from error
    end = data.find(b"end_header\n")
    header = data[:max(end, 0)].decode("ascii", "replace").split("\n")
    if end < 0 or "format binary_little_endian 1.0" not in header:
        raise RunError(f"{path}: is not a mesh that coseg run has written")
    count = {words[1]: int(words[2]) for words in map(str.split, header) if words[:1] == ["element"]}
    number = "d" if "property double x" in header else "f"
    tail = struct.Struct("<3B" + ("f" if "property float confidence" in header else ""))
    at = end + len(b"end_header\n")
    try:
        flat = struct.unpack_from(f"<{3 * count['vertex']}{number}", data, at)
        at += struct.calcsize(f"<{3 * count['vertex']}{number}")
        faces, colors = [], []
        for _ in range(count["face"]):
            corners = data[at]
            faces.append(struct.unpack_from(f"<{corners}i", data, at + 1))
            at += 1 + 4 * corners
            colors.append(tail.unpack_from(data, at)[:3])
            at += tail.size
    except (struct.error, IndexError, KeyError) as error:
        raise RunError(f"{path}: ends too early") from error
    return [flat[k:k + 3] for k in range(0, len(flat), 3)], faces, colors


def read_rotations(folder):
    path = os.path.join(folder, "alignment.json")
    if not os.path.exists(path):
        return {}
    return {exact_name(shape): tuple(map(tuple, shape["rotation"])) for shape in read_json(path)["shapes"]}


def read_run(folder):
    """All shapes of a finished run, with parts, names and colours."""
    report = read_json(os.path.join(folder, "report.json"))
    if not str(report.get("format", "")).startswith("coseg report"):
        raise RunError(f"{folder}: report.json is not that of coseg run")
    count = len(report["partition"]["part_area"])
    run = Run(folder, read_names(folder, count), [(160, 160, 160)] * count)
    rotations = read_rotations(folder)
    for entry in report["meshes"]:
        name = exact_name(entry)
        vertices, faces, colors = read_ply(os.path.join(folder, "ply", name + ".ply"))
        parts = read_labels(os.path.join(folder, "labels", name + ".seg"), len(faces))
        for part, color in zip(parts, colors):
            run.colors[part] = color
        run.shapes.append(Shape(name, vertices, faces, parts, rotations.get(name, IDENTITY)))
    return run


def grid_places(sizes):
    """A place (column, row) in a square grid for each shape, in units of the largest size."""
    columns = max(1, int(round(len(sizes) ** 0.5)))
    step = 1.2 * max(sizes, default=1.0)
    return [(step * (k % columns), -step * (k // columns)) for k in range(len(sizes))]


def file_names(names):
    """A different file name for each object: letters, digits, `-` and `_`, with a number where two would be alike."""
    taken, result = set(), []
    for name in names:
        clean = "".join(c if c.isalnum() or c in "-_" else "_" for c in name) or "shape"
        number, candidate = 1, clean
        while candidate.lower() in taken:
            number += 1
            candidate = f"{clean}_{number}"
        taken.add(candidate.lower())
        result.append(candidate)
    return result


def write_off(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(" ".join(f"{x:.9g}" for x in vertex) + "\n" for vertex in vertices)
        file.writelines(f"{len(face)} " + " ".join(map(str, face)) + "\n" for face in faces)


def write_collection(folder, meshes):
    """Writes (name, vertices, faces) of each mesh as an OFF file; the paths in the same order."""
    if not meshes:
        raise RunError("no mesh is selected; select the objects that are to be segmented together")
    os.makedirs(folder, exist_ok=True)
    paths = []
    for file_name, (_, vertices, faces) in zip(file_names([mesh[0] for mesh in meshes]), meshes):
        paths.append(os.path.join(folder, file_name + ".off"))
        write_off(paths[-1], vertices, faces)
    return paths


def run_command(folder, parts):
    """What to type in a shell to segment the collection."""
    quoted = "'" + folder.rstrip("/").replace("'", "'\\''")
    return f"coseg run --parts {parts} --out {quoted}_result' {quoted}'"
