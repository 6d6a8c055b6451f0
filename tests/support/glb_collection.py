#!/usr/bin/env python3
"""Makes a collection of textured GLB files of many forms, and checks what coseg export makes of it, by two readers.

usage: glb_collection.py make OFF_FOLDER GLB_FOLDER       every OFF file as a GLB file: nodes with transforms, one to three
                                                          primitives a mesh, indices of 16 or 32 bits or none, a picture
       glb_collection.py check READER GLB_FOLDER RUN NAME ...
                                                          RUN/glb has the triangles of GLB_FOLDER in nodes of these names,
                                                          with the same bits. READER is own (the bytes, by this file) or
                                                          assimp (the program of that name reads both)
"""
import hashlib
import json
import os
import struct
import subprocess
import sys
import tempfile

from textured_glb import Builder, File, as_float, glb, png, read_off

IDENTITY = [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0]  # by rows


def product(a, b):
    return [sum(a[4 * i + k] * b[4 * k + j] for k in range(4)) for i in range(4) for j in range(4)]


# ---- Making ----

def texture_place(shape, vertex, chart):
    digest = hashlib.sha256(b"%d %d %d" % (shape, vertex, chart)).digest()
    return tuple(as_float(int.from_bytes(digest[4 * k:4 * k + 4], "little") / 2**32) for k in (0, 1))


def local_points(points, node):
    """The points in the frame of a node; on the grid of make() all of this is exact."""
    if node == 0:  # translation (0.5, 0, 1), scale 2
        return [((x - 0.5) / 2, y / 2, (z - 1) / 2) for x, y, z in points]
    return [(y, -x, z) for x, y, z in points]  # a quarter turn about z


def primitive(builder, shape, points, faces, index_type):
    """Vertices are split where charts meet, so that texture coordinates have seams."""
    known, positions, normals, places, indices = {}, [], [], [], []
    for number, face in enumerate(faces):
        for vertex in face:
            key = (vertex, number // 40) if index_type else (vertex, len(indices))
            if key not in known:
                known[key] = len(positions)
                positions.append(points[vertex])
                normals.append((0.0, 0.0, 1.0))
                places.append(texture_place(shape, *key))
            indices.append((known[key],))
    attributes = {"POSITION": builder.accessor(positions, 5126, "VEC3"), "NORMAL": builder.accessor(normals, 5126, "VEC3"),
                  "TEXCOORD_0": builder.accessor(places, 5126, "VEC2")}
    return {"attributes": attributes, **({"indices": builder.accessor(indices, index_type, "SCALAR")} if index_type else {})}


def make_one(shape, source, target):
    points, faces = read_off(source)
    points = [tuple(round(4096 * c) / 4096 for c in point) for point in points]
    builder, meshes = Builder(), []
    half = len(faces) // 2
    for node, own in enumerate((faces[:half], faces[half:])):
        count = 1 + (shape + node) % 3
        local = local_points(points, node)
        pieces = [own[len(own) * k // count:len(own) * (k + 1) // count] for k in range(count)]
        index_type = (5123, 5125, None)[(shape + 2 * node) % 3]
        meshes.append({"primitives": [{**primitive(builder, shape, local, piece, index_type), "material": (k + node) % 2}
                                      for k, piece in enumerate(pieces)]})
    picture = builder.view(png(8 + shape))
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "shape %d" % shape, "children": [1, 2], "rotation": [0.5, 0.5, 0.5, 0.5], "translation": [shape, 0, 0]},
                  {"mesh": 0, "name": "front", "translation": [0.5, 0, 1], "scale": [2, 2, 2]},
                  {"mesh": 1, "name": "back", "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
        "meshes": meshes, "accessors": builder.accessors, "bufferViews": builder.views,
        "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                      {"name": "steel", "pbrMetallicRoughness": {"metallicFactor": 1.0}}],
        "textures": [{"source": 0}], "images": [{"bufferView": picture, "mimeType": "image/png"}],
        "buffers": [{"byteLength": len(builder.binary)}]}
    with open(target, "wb") as file:
        file.write(glb(document, builder.binary))


def make(source, target):
    os.makedirs(target)
    for shape, name in enumerate(sorted(os.listdir(source))):
        make_one(shape, f"{source}/{name}", f"{target}/{name[:-4]}.glb")


# ---- Reading: (name, matrix, [(material, bytes of places and texture coordinates of the corners)], children) of a node ----

class OwnReader:
    """By the bytes of the GLB file."""

    def __init__(self, path):
        self.file = File(path)
        self.nodes = [self.node(k) for k in self.file.json["scenes"][0]["nodes"]]
        images = self.file.json.get("images", [])
        self.pictures = [self.file.view_bytes(image["bufferView"]) for image in images]

    def node(self, number):
        node = self.file.json["nodes"][number]
        triangles = [one for primitive in self.file.json["meshes"][node["mesh"]]["primitives"] for one in self.triangles(primitive)
                     ] if "mesh" in node else []
        return node.get("name", ""), self.matrix(node), triangles, [self.node(k) for k in node.get("children", [])]

    @staticmethod
    def matrix(node):
        if "matrix" in node:
            return [node["matrix"][4 * j + i] for i in range(4) for j in range(4)]
        x, y, z, w = node.get("rotation", [0, 0, 0, 1])
        turn = [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 2 * (x * y + z * w), 1 - 2 * (x * x + z * z),
                2 * (y * z - x * w), 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]
        scale, move = node.get("scale", [1, 1, 1]), node.get("translation", [0, 0, 0])
        rows = [[turn[3 * i + j] * scale[j] for j in range(3)] + [move[i]] for i in range(3)]
        return rows[0] + rows[1] + rows[2] + [0, 0, 0, 1]

    def triangles(self, one):
        attributes = [self.file.elements(one["attributes"][name]) for name in ("POSITION", "TEXCOORD_0")]
        indices = range(len(attributes[0]))
        if "indices" in one:
            letter = {5123: "H", 5125: "I"}[self.file.json["accessors"][one["indices"]]["componentType"]]
            indices = [struct.unpack("<" + letter, element)[0] for element in self.file.elements(one["indices"])]
        material = self.file.json["materials"][one["material"]]["name"]
        return [(material, tuple(values[v] for v in indices[k:k + 3] for values in attributes)) for k in range(0, len(indices), 3)]


class AssimpReader:
    """By assimp, which writes what it has read in a binary form of its own (code/AssetLib/Assbin). It turns texture
    coordinates over, in both files alike."""

    def __init__(self, path):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["assimp", "export", path, folder + "/scene.assbin", "-fassbin"], check=True, stdout=subprocess.DEVNULL)
            with open(folder + "/scene.assbin", "rb") as file:
                self.bytes = file.read()
        assert self.bytes.startswith(b"ASSIMP.binary-dump."), path
        self.place = 512
        self.chunk(0x1239)
        _, meshes, materials, _, textures, _, _ = self.numbers(7)
        root = self.node()
        self.meshes = [self.mesh() for _ in range(meshes)]
        names = [self.material() for _ in range(materials)]
        # The format has no room for pictures beside their number.
        self.pictures = textures
        self.nodes = [self.with_triangles(root, names)]

    def take(self, layout):
        values = struct.unpack_from("<" + layout, self.bytes, self.place)
        self.place += struct.calcsize("<" + layout)
        return values

    def numbers(self, count):
        return self.take("%dI" % count)

    def text(self):
        length, = self.numbers(1)
        return self.take("%ds" % length)[0]

    def chunk(self, magic):
        found, length = self.numbers(2)
        assert found == magic, hex(found)
        return self.place + length

    def node(self):
        end = self.chunk(0x123c)
        name = self.text().decode()
        matrix = list(self.take("16f"))
        children, meshes, _ = self.numbers(3)
        own = self.numbers(meshes)
        below = [self.node() for _ in range(children)]
        self.place = end  # behind the metadata
        return name, matrix, own, below

    def mesh(self):
        end = self.chunk(0x1237)
        _, vertices, faces, _, material = self.numbers(5)
        components, = self.numbers(1)
        has = [bool(components & bit) for bit in (1, 2, 4, 0x100, 0x200, 0x10000)]
        assert has[0] and has[3] and not has[4] and not has[5], hex(components)
        positions = [self.take("12s")[0] for _ in range(vertices)]
        self.place += 12 * vertices * (has[1] + 2 * has[2])
        self.numbers(1)
        places = [self.take("12s")[0][:8] for _ in range(vertices)]
        triangles = []
        for _ in range(faces):
            corners, = self.take("H")
            assert corners == 3
            indices = self.take("3H" if vertices < 2**16 else "3I")
            triangles.append(tuple(values[v] for v in indices for values in (positions, places)))
        assert self.place == end
        return material, triangles

    def material(self):
        end = self.chunk(0x123d)
        count, = self.numbers(1)
        name = ""
        for _ in range(count):
            self.chunk(0x123e)
            key = self.text()
            _, _, length, _ = self.numbers(4)
            data = self.take("%ds" % length)[0]
            if key == b"?mat.name":
                name = data[4:].rstrip(b"\0").decode()
        assert self.place == end
        return name

    def with_triangles(self, node, names):
        name, matrix, own, below = node
        triangles = [(names[self.meshes[k][0]], corners) for k in own for corners in self.meshes[k][1]]
        return name, matrix, triangles, [self.with_triangles(child, names) for child in below]


# ---- Comparing ----

def drawn(nodes, above=None):
    """(matrix to the scene, material, corners) of all triangles, a node before its children."""
    for _, matrix, triangles, children in nodes:
        to_scene = product(above or IDENTITY, matrix)
        for material, corners in triangles:
            yield to_scene, material, corners
        yield from drawn(children, to_scene)


def named(nodes, name, above=None):
    for node in nodes:
        to_scene = product(above or IDENTITY, node[1])
        if node[0] == name:
            yield above, node
        else:
            yield from named(node[3], name, to_scene)


def check_one(reader, source_path, export_path, labels_path, names):
    source, export = reader(source_path), reader(export_path)
    labels = [int(line) for line in open(labels_path, encoding="utf-8")]
    faces = list(drawn(source.nodes))
    assert len(faces) == len(labels) > 1000, (len(faces), len(labels))
    assert source.pictures == export.pictures and source.pictures, "pictures"
    assert sum(1 for _ in drawn(export.nodes)) == len(faces), "triangles of the whole file"
    for part in sorted(set(labels)):
        found_nodes = list(named(export.nodes, names[part]))
        assert len(found_nodes) == 1, f"{len(found_nodes)} nodes are called {names[part]}"
        above, node = found_nodes[0]
        found = list(drawn([node], above))
        expected = [face for face, label in zip(faces, labels) if label == part]
        assert [row[1:] for row in found] == [row[1:] for row in expected], f"triangles of {names[part]}"
        for (own, *_), (before, *_) in zip(found, expected):
            assert all(abs(a - b) < 1e-6 for a, b in zip(own, before)), (own, before)
    return len(faces)


def check(reader, sources, run, names):
    count = faces = 0
    for name in sorted(os.listdir(sources)):
        stem = name[:-4]
        faces += check_one({"own": OwnReader, "assimp": AssimpReader}[reader], f"{sources}/{name}", f"{run}/glb/{name}",
                           f"{run}/labels/{stem}.seg", names)
        count += 1
    assert count == 20, count
    print(f"{count} files, {faces} triangles")


if __name__ == "__main__":
    if sys.argv[1:2] == ["make"] and len(sys.argv) == 4:
        make(*sys.argv[2:])
    elif sys.argv[1:2] == ["check"] and len(sys.argv) > 5 and sys.argv[2] in ("own", "assimp"):
        check(*sys.argv[2:5], sys.argv[5:])
    else:
        sys.exit(__doc__)
