"""Reads what `coseg run --out DIR` leaves, and writes meshes for it. Knows nothing of Blender.

Faces keep the order of the input files, so that label k is that of face k. The coloured meshes DIR/ply/NAME.ply are
read, because the files that the run was given may have moved.
"""
import json
import os
import struct
from dataclasses import dataclass, field

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


#: Of struct, by what a header of PLY calls them.
NUMBERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
           "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f",
           "float64": "d"}


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


def readable(text):
    """Text that Blender takes, which knows nothing but UTF-8: what is none is shown as U+FFFD."""
    return os.fsencode(text).decode("utf-8", "replace")


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError, RecursionError) as error:
        raise RunError(f"{path}: cannot be read ({error}); choose the folder that coseg run was given with --out") from error


def read_names(folder, parts):
    """Of names.txt in the folder, one a line or `NUMBER NAME`; else part_0, part_1 and so on."""
    names = [f"part_{part}" for part in range(parts)]
    path = os.path.join(folder, "names.txt")
    if not os.path.exists(path):
        return names
    try:
        with open(path, encoding="utf-8-sig") as file:
            lines = [line.split() for line in file if line.strip()]
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read as names in UTF-8 ({error}); correct it or remove it") from error
    numbered = all(len(words) > 1 and words[0].isdecimal() for words in lines)
    for row, words in enumerate(lines):
        part = int(words[0]) if numbered else row
        if part < parts:
            names[part] = " ".join(words[1:] if numbered else words)
    return names


def read_labels(path, count, parts):
    """The part of each of so many faces, 0 .. parts - 1."""
    try:
        with open(path, encoding="ascii") as file:
            labels = [int(word) for word in file.read().split()]
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read ({error})") from error
    if len(labels) != count:
        raise RunError(f"{path}: has {len(labels)} labels for {count} faces")
    for face, label in enumerate(labels):
        if not 0 <= label < parts:
            raise RunError(f"{path}: face {face} has {label}, which the run did not have; correct the file, or run coseg "
                           "run again")
    return labels


def ply_elements(path, header):
    """[(name, count, [(name of a property, type)])]; the type of a list is (type of its length, type of its items)."""
    elements = []
    try:
        for words in map(str.split, header):
            if words[:1] == ["element"]:
                elements.append((words[1], int(words[2]), []))
            elif words[:2] == ["property", "list"]:
                elements[-1][2].append((words[4], (NUMBERS[words[2]], NUMBERS[words[3]])))
            elif words[:1] == ["property"]:
                elements[-1][2].append((words[2], NUMBERS[words[1]]))
    except (IndexError, KeyError, ValueError) as error:
        raise RunError(f"{path}: has a header that is not of coseg run ({error!r})") from error
    return elements


def ply_row(data, at, properties):
    """The values of one vertex or face by name, and where the next one begins."""
    row = {}
    for name, kind in properties:
        if isinstance(kind, tuple):
            (length,) = struct.unpack_from("<" + kind[0], data, at)
            at += struct.calcsize("<" + kind[0])
            kind = f"{length}{kind[1]}"
            row[name] = struct.unpack_from("<" + kind, data, at)
        else:
            (row[name],) = struct.unpack_from("<" + kind, data, at)
        at += struct.calcsize("<" + kind)
    return row, at


def read_ply(path):
    """Vertices, faces and a colour for each face of a coloured mesh as coseg writes it."""
    try:
        with open(path, "rb") as file:
            data = file.read()
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read ({error})") from error
    end = data.find(b"end_header\n")
    header = data[:max(end, 0)].decode("ascii", "replace").split("\n")
    if end < 0 or "format binary_little_endian 1.0" not in header:
        raise RunError(f"{path}: is not a mesh that coseg run has written")
    at = end + len(b"end_header\n")
    rows = {"vertex": [], "face": []}
    try:
        for element, count, properties in ply_elements(path, header):
            for _ in range(count):
                row, at = ply_row(data, at, properties)
                rows[element].append(row)
        vertices = [(row["x"], row["y"], row["z"]) for row in rows["vertex"]]
        faces = [row["vertex_indices"] for row in rows["face"]]
        colors = [(row["red"], row["green"], row["blue"]) for row in rows["face"]]
    except (struct.error, MemoryError) as error:
        raise RunError(f"{path}: ends too early") from error
    except KeyError as error:
        raise RunError(f"{path}: is not a mesh that coseg run has written, as to {error}") from error
    for number, face in enumerate(faces):
        if face and not 0 <= min(face) <= max(face) < len(vertices):
            raise RunError(f"{path}: face {number} refers to a vertex that is none of the {len(vertices)}")
    return vertices, faces, colors


def read_rotations(folder):
    path = os.path.join(folder, "alignment.json")
    if not os.path.exists(path):
        return {}
    raw = read_json(path)
    try:
        return {exact_name(shape): tuple(tuple(float(x) for x in row) for row in shape["rotation"])
                for shape in raw["shapes"]}
    except (KeyError, TypeError, ValueError) as error:
        raise RunError(f"{path}: is not the alignment of a run ({error!r})") from error


def read_report(folder):
    """The number of parts, and the names of the shapes."""
    report = read_json(os.path.join(folder, "report.json"))
    if not isinstance(report, dict) or not str(report.get("format", "")).startswith("coseg report"):
        raise RunError(f"{folder}: report.json is not that of coseg run")
    try:
        return len(report["partition"]["part_area"]), [exact_name(entry) for entry in report["meshes"]]
    except (KeyError, TypeError, ValueError) as error:
        raise RunError(f"{folder}: report.json is not that of a finished run ({error!r})") from error


def read_run(folder):
    """All shapes of a finished run, with parts, names and colours."""
    count, names = read_report(folder)
    run = Run(folder, read_names(folder, count), [(160, 160, 160)] * count)
    rotations = read_rotations(folder)
    for name in names:
        vertices, faces, colors = read_ply(os.path.join(folder, "ply", name + ".ply"))
        parts = read_labels(os.path.join(folder, "labels", name + ".seg"), len(faces), count)
        for part, color in zip(parts, colors):
            run.colors[part] = color
        run.shapes.append(Shape(name, vertices, faces, parts, rotations.get(name, IDENTITY)))
    return run


def faces_that_blender_holds(faces):
    """The numbers of the faces with three corners at least, all different, and not those of an earlier face.

    Blender crashes by others, as by faces of one corner.
    """
    numbers, seen = [], set()
    for number, face in enumerate(faces):
        corners = frozenset(face)
        if len(face) >= 3 and len(corners) == len(face) and corners not in seen:
            seen.add(corners)
            numbers.append(number)
    return numbers


def bounds(vertices, faces, rotation):
    """The lowest and the highest coordinates of the turned shape, without vertices that are in no face."""
    used = {corner for face in faces for corner in face} or range(len(vertices))
    turned = [tuple(sum(r * x for r, x in zip(row, vertices[k])) for row in rotation) for k in used]
    if not turned:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    return tuple(map(min, zip(*turned))), tuple(map(max, zip(*turned)))


def side_by_side(boxes, scale):
    """(enlargement, translation) of each turned shape with these (lowest, highest) coordinates, which sets the middle of
    its box on a place of its own in a grid; with `scale` all boxes become of size 1."""
    sizes = [max(max(h - l for l, h in zip(low, high)), 1e-12) for low, high in boxes]
    enlargements = [1.0 / size if scale else 1.0 for size in sizes]
    places = grid_places([1.0 if scale else size for size in sizes])
    return [(by, tuple(place - by * (l + h) / 2 for place, l, h in zip((*at, 0.0), low, high)))
            for by, at, (low, high) in zip(enlargements, places, boxes)]


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
