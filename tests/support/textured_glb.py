#!/usr/bin/env python3
"""Makes GLB files with textures out of OFF files, and checks what coseg export makes of them.

usage: textured_glb.py make IN.off OUT.glb          two nodes and two materials, seams, a picture, members that nobody knows
       textured_glb.py check SOURCE.glb EXPORT.glb LABELS.seg NAME ...
                                                    EXPORT has the triangles of SOURCE, shared out among nodes of these names
       textured_glb.py alone SOURCE.glb PIECE.glb LABELS.seg PIECES.seg PART PIECE NAME
                                                    PIECE.glb has the triangles of one piece of a part, and nothing else
"""
import hashlib
import json
import struct
import sys
import zlib

TYPES = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def read_off(path):
    numbers = open(path, encoding="utf-8").read().split()[1:]
    vertices, faces = int(numbers[0]), int(numbers[1])
    points = [tuple(map(float, numbers[3 + 3 * k:6 + 3 * k])) for k in range(vertices)]
    begin = 3 + 3 * vertices
    return points, [tuple(map(int, numbers[begin + 4 * f + 1:begin + 4 * f + 4])) for f in range(faces)]


def png(size):
    rows = b"".join(b"\0" + bytes((x * 7 + y * 13) % 256 for x in range(3 * size)) for y in range(size))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def glb(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


class Builder:
    def __init__(self):
        self.binary = b""
        self.views, self.accessors = [], []

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return len(self.views) - 1

    def accessor(self, rows, component_type, kind):
        data = b"".join(struct.pack("<%d%s" % (len(row), TYPES[component_type]), *row) for row in rows)
        self.accessors.append({"bufferView": self.view(data), "componentType": component_type, "count": len(rows), "type": kind})
        if kind == "VEC3":
            self.accessors[-1]["min"] = [min(column) for column in zip(*rows)]
            self.accessors[-1]["max"] = [max(column) for column in zip(*rows)]
        return len(self.accessors) - 1


def as_float(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def texture_place(face, corner):
    digest = hashlib.sha256(b"%d %d" % (face, corner)).digest()
    return tuple(as_float(int.from_bytes(digest[4 * k:4 * k + 4], "little") / 2**32) for k in (0, 1))


def make(source, target):
    points, faces = read_off(source)
    points = [tuple(map(as_float, p)) for p in points]
    builder = Builder()
    meshes = []
    half = len(faces) // 2
    for part, numbers in enumerate((range(half), range(half, len(faces)))):
        positions, normals, places, indices, known = [], [], [], [], {}
        for f in numbers:
            for corner, v in enumerate(faces[f]):
                chart = f // 50  # a new texture coordinate for a vertex in every 50 faces: seams
                if (v, chart) not in known:
                    known[v, chart] = len(positions)
                    positions.append(points[v])
                    normals.append((0.0, 0.0, 1.0))
                    places.append(texture_place(f, corner))
                indices.append((known[v, chart],))
        wide = 5125 if part else 5123
        attributes = {"POSITION": builder.accessor(positions, 5126, "VEC3"), "NORMAL": builder.accessor(normals, 5126, "VEC3"),
                      "TEXCOORD_0": builder.accessor(places, 5126, "VEC2")}
        meshes.append({"name": "half %d" % part, "primitives": [
            {"attributes": attributes, "indices": builder.accessor(indices, wide, "SCALAR"), "material": part,
             "extras": {"kept": None}}]})
    picture = builder.view(png(16))
    document = {
        "asset": {"version": "2.0", "generator": "textured_glb.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "body", "children": [1, 2], "translation": [0.5, 0, 0]}, {"mesh": 0, "name": "first"},
                  {"mesh": 1, "name": "second"}],
        "meshes": meshes, "accessors": builder.accessors, "bufferViews": builder.views,
        "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                      {"name": "steel", "pbrMetallicRoughness": {"metallicFactor": 1.0}}],
        "textures": [{"source": 0}], "images": [{"bufferView": picture, "mimeType": "image/png"}],
        "somethingNew": {"number": 0.1, "nothing": None}, "buffers": [{"byteLength": len(builder.binary)}]}
    with open(target, "wb") as file:
        file.write(glb(document, builder.binary))


class File:
    def __init__(self, path):
        data = open(path, "rb").read()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data)), path
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.json = json.loads(data[20:20 + size])
        assert data[24 + size:28 + size] == b"BIN\0"
        self.binary = data[28 + size:]

    def view_bytes(self, number):
        view = self.json["bufferViews"][number]
        begin = view.get("byteOffset", 0)
        return self.binary[begin:begin + view["byteLength"]]

    def elements(self, number):
        """The bytes of every element of an accessor."""
        accessor = self.json["accessors"][number]
        size = COMPONENTS[accessor["type"]] * struct.calcsize(TYPES[accessor["componentType"]])
        data = self.view_bytes(accessor["bufferView"])[accessor.get("byteOffset", 0):]
        return [data[k * size:(k + 1) * size] for k in range(accessor["count"])]

    def triangles(self, mesh):
        """For every triangle its material and the bytes of all attributes of its corners."""
        for primitive in self.json["meshes"][mesh]["primitives"]:
            accessor = self.json["accessors"][primitive["indices"]]
            kind = TYPES[accessor["componentType"]]
            indices = [struct.unpack("<" + kind, element)[0] for element in self.elements(primitive["indices"])]
            attributes = [self.elements(primitive["attributes"][name]) for name in ("POSITION", "NORMAL", "TEXCOORD_0")]
            assert primitive["extras"] == {"kept": None}
            for k in range(0, len(indices), 3):
                yield primitive["material"], tuple(values[v] for v in indices[k:k + 3] for values in attributes)


def check(source_path, export_path, labels_path, names):
    source, export = File(source_path), File(export_path)
    length = source.json["buffers"][0]["byteLength"]
    assert export.binary[:length] == source.binary[:length], "the bytes of the buffer"
    assert export.view_bytes(export.json["images"][0]["bufferView"]) == source.view_bytes(source.json["images"][0]["bufferView"])
    for kept in ("somethingNew", "textures", "images", "asset"):
        assert export.json[kept] == source.json[kept], kept
    assert export.json["materials"][:2] == source.json["materials"]
    variants = export.json["extensions"]["KHR_materials_variants"]["variants"]
    assert variants[-1] == {"name": "parts"} and "KHR_materials_variants" in export.json["extensionsUsed"]

    labels = [int(line) for line in open(labels_path, encoding="utf-8")]
    faces = [triangle for mesh in range(2) for triangle in source.triangles(mesh)]
    assert len(faces) == len(labels)
    tops = [export.json["nodes"][k] for k in export.json["scenes"][0]["nodes"]]
    parts = {node["extras"]["part"]: node for node in tops if "extras" in node}
    assert sorted(parts) == sorted(set(labels))
    assert [node for node in tops if "extras" not in node][0]["name"] == "body"
    for part, node in parts.items():
        assert node["name"] == names[part], node["name"]
        assert node["matrix"] == [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 1]
        found = list(export.triangles(node["mesh"]))
        assert found == [face for face, label in zip(faces, labels) if label == part], f"triangles of part {part}"
        for primitive in export.json["meshes"][node["mesh"]]["primitives"]:
            mapping = primitive["extensions"]["KHR_materials_variants"]["mappings"][-1]
            assert export.json["materials"][mapping["material"]]["name"] == names[part]


def alone(source_path, piece_path, labels_path, pieces_path, part, piece, name):
    source, own = File(source_path), File(piece_path)
    numbers = [[int(line) for line in open(path, encoding="utf-8")] for path in (labels_path, pieces_path)]
    wanted = [key == (int(part), int(piece)) for key in zip(*numbers)]
    faces = [triangle for mesh in range(2) for triangle in source.triangles(mesh)]
    expected = [face for face, is_wanted in zip(faces, wanted) if is_wanted]
    drawn = [node for node in own.json["nodes"] if "mesh" in node]
    assert len(drawn) == 1 and drawn[0]["name"] == name and drawn[0]["matrix"][12] == 0.5, drawn
    found = [(own.json["materials"][material]["name"], corners) for material, corners in own.triangles(drawn[0]["mesh"])]
    assert found == [(source.json["materials"][material]["name"], corners) for material, corners in expected]
    assert [node["name"] for node in own.json["nodes"] if node["name"] in ("body", "first", "second")] == []
    used = {0: set(), 1: set()}
    for material, corners in expected:
        used[material].update(corners[k:k + 3] for k in (0, 3, 6))
    for primitive in own.json["meshes"][drawn[0]["mesh"]]["primitives"]:
        rows = list(zip(*(own.elements(primitive["attributes"][key]) for key in ("POSITION", "NORMAL", "TEXCOORD_0"))))
        material = 0 if own.json["materials"][primitive["material"]]["name"] == "wood" else 1
        assert set(rows) == used[material], "vertices that the piece does not use"
        accessor = own.json["accessors"][primitive["attributes"]["POSITION"]]
        places = [struct.unpack("<3f", row[0]) for row in rows]
        assert accessor["min"] == [min(axis) for axis in zip(*places)] and accessor["max"] == [max(axis) for axis in zip(*places)]
    assert ("images" in own.json) == ("textures" in own.json) == bool(used[0]), "pictures"
    if used[0]:
        assert own.view_bytes(own.json["images"][0]["bufferView"]) == source.view_bytes(source.json["images"][0]["bufferView"])
    assert len(own.binary) < 100 + sum(len(own.view_bytes(k)) + 3 for k in range(len(own.json["bufferViews"])))
    assert own.json["somethingNew"] == source.json["somethingNew"]


if __name__ == "__main__":
    if sys.argv[1:2] == ["make"] and len(sys.argv) == 4:
        make(*sys.argv[2:])
    elif sys.argv[1:2] == ["check"] and len(sys.argv) > 5:
        check(*sys.argv[2:5], sys.argv[5:])
    elif sys.argv[1:2] == ["alone"] and len(sys.argv) == 9:
        alone(*sys.argv[2:])
    else:
        sys.exit(__doc__)
