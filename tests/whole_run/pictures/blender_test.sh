#!/usr/bin/env bash
# The Blender add-on: it reads a run back face by face, and exports meshes that a run accepts. Blender itself where it is installed.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

addon=$COSEG_SOURCE/contrib/blender/coseg_blender
mkdir "$work/meshes"
for k in 1 2 3; do peanut "$work/meshes/peanut $k.off" "0.$((4 + k))"; done
"$COSEG" run --quiet --no-sheet --no-html --no-keep-model --align off --parts 2 --patches 10 --geodesic-samples 50 --out "$work/run" "$work/meshes"
printf 'body\nwaist\n' >"$work/run/names.txt"

cat >"$work/plain.py" <<'END'
import os, sys
addon, work = sys.argv[1:]
sys.path.insert(0, addon)
import run_folder
run = run_folder.read_run(work + "/run")
assert run.names == ["body", "waist"] and len(set(run.colors)) == 2, (run.names, run.colors)
assert [s.name for s in run.shapes] == ["peanut 1", "peanut 2", "peanut 3"]
for shape in run.shapes:
    lines = open(f"{work}/meshes/{shape.name}.off").read().split("\n")
    vertices = [[float(x) for x in line.split()] for line in lines[2:2 + len(shape.vertices)]]
    faces = [tuple(map(int, line.split()[1:])) for line in lines[2 + len(vertices):] if line]
    assert shape.faces == faces, "faces keep their order"
    assert max(abs(a - b) for p, q in zip(vertices, shape.vertices) for a, b in zip(p, q)) < 1e-6
    assert shape.parts == [int(x) for x in open(f"{work}/run/labels/{shape.name}.seg")]
    assert shape.rotation == run_folder.IDENTITY
assert run_folder.file_names(["Leg.001", "leg 001", "", "ä"]) == ["Leg_001", "leg_001_2", "shape", "ä"]
paths = run_folder.write_collection(work + "/plain", [(s.name, s.vertices, s.faces) for s in run.shapes])
assert [os.path.basename(p) for p in paths] == ["peanut_1.off", "peanut_2.off", "peanut_3.off"]
assert run_folder.run_command("/a b/", 3) == "coseg run --parts 3 --out '/a b_result' '/a b'"

def sentence(call):
    try:
        call()
    except run_folder.RunError as error:
        return str(error)
    raise AssertionError("nothing is raised")

assert "choose the folder" in sentence(lambda: run_folder.read_run(work))
assert "no mesh is selected" in sentence(lambda: run_folder.write_collection(work + "/none", []))
with open(work + "/run/labels/peanut 2.seg", "a") as file:
    file.write("1\n")
assert "has 1105 labels for 1104 faces" in sentence(lambda: run_folder.read_run(work + "/run"))
with open(work + "/run/labels/peanut 2.seg", "r+") as file:
    text = file.read()[:-2]
    file.seek(0)
    file.truncate()
    file.write(text)
ply = work + "/run/ply/peanut 3.ply"
whole = open(ply, "rb").read()
open(ply, "wb").write(whole[:-5])
assert "ends too early" in sentence(lambda: run_folder.read_run(work + "/run"))
# A count of corners of four bytes, as coseg writes it where a face has more than 255.
body = whole.index(b"end_header\n") + len(b"end_header\n") + 12 * len(run.shapes[2].vertices)
wide = whole[:body].replace(b"list uchar int", b"list int int")
for k in range(len(run.shapes[2].faces)):
    row = whole[body + k * 20:body + (k + 1) * 20]
    wide += bytes([row[0], 0, 0, 0]) + row[1:]
open(ply, "wb").write(wide)
assert run_folder.read_run(work + "/run").shapes[2].faces == run.shapes[2].faces
open(ply, "wb").write(wide.replace(b"list int int", b"list long int"))
assert "has a header that is not of coseg run" in sentence(lambda: run_folder.read_run(work + "/run"))
open(ply, "wb").write(whole[:body + 1] + b"\xff" * 4 + whole[body + 5:])
assert "face 0 refers to a vertex that is none" in sentence(lambda: run_folder.read_run(work + "/run"))
open(ply, "wb").write(whole)

def with_text(name, change, words):
    """The sentence where a file of the run is changed so."""
    path = f"{work}/run/{name}"
    kept = open(path, "rb").read()
    open(path, "wb").write(change(kept))
    said = sentence(lambda: run_folder.read_run(work + "/run"))
    open(path, "wb").write(kept)
    assert words in said and name.split("/")[-1] in said, said

with_text("names.txt", lambda text: b"\xff\xfe" + text, "cannot be read as names in UTF-8")
for label in (b"2", b"-1"):
    with_text("labels/peanut 2.seg", lambda text: label + text[1:], f"face 0 has {label.decode()}, which the run did not have")
with_text("report.json", lambda text: text.replace(b'"partition"', b'"portion"', 1).replace(b'"partition"', b'"portion"'), "'partition'")
with_text("report.json", lambda text: b"[]", "is not that of coseg run")
assert run_folder.readable("caf\udce9") == "caf\ufffd"
assert run_folder.faces_that_blender_holds([(0, 1, 2), (3,), (), (0, 1), (1, 2, 1), (2, 0, 1), (0, 1, 2, 3)]) == [0, 6]
quarter = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
corners = [(100.0, 50.0, 7.0), (104.0, 50.0, 7.0), (104.0, 52.0, 8.0), (900.0, 0.0, 0.0)]
assert run_folder.bounds(corners, [(0, 1, 2)], quarter) == ((-52.0, 100.0, 7.0), (-50.0, 104.0, 8.0))
boxes = [((0.0, 0.0, 0.0), (4.0, 1.0, 1.0)), ((100.0, 50.0, 7.0), (102.0, 51.0, 8.0))]
for scale, wanted in ((False, [(1.0, (-2.0, -0.5, -0.5)), (1.0, (-101.0, -4.8 - 50.5, -7.5))]),
                      (True, [(0.25, (-0.5, -0.125, -0.125)), (0.5, (-50.5, -1.2 - 25.25, -3.75))])):
    for (by, at), (other, there) in zip(run_folder.side_by_side(boxes, scale), wanted):
        assert by == other and max(abs(a - b) for a, b in zip(at, there)) < 1e-9, (by, at)
END
python3 "$work/plain.py" "$addon" "$work" || fail "the part of the add-on that needs no Blender"
"$COSEG" check "$work/plain" >/dev/null || fail "coseg refuses what the add-on has exported"

if ! command -v blender >/dev/null; then
    echo "ok: blender add-on (without Blender, which is not installed)"
    exit 0
fi
cat >"$work/inside.py" <<'END'
import sys
import bpy
addon, work = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
import coseg_blender
coseg_blender.register()
bpy.ops.wm.read_factory_settings(use_empty=True)
assert bpy.ops.import_scene.coseg_run(directory=work + "/run", mark="MATERIALS") == {"FINISHED"}
objects = [o for o in bpy.data.objects if o.type == "MESH"]
assert sorted(o.name for o in objects) == ["peanut 1", "peanut 2", "peanut 3"], objects
for obj in objects:
    labels = [int(x) for x in open(f"{work}/run/labels/{obj.name}.seg")]
    assert [p.material_index for p in obj.data.polygons] == labels, obj.name
    assert [m.name for m in obj.data.materials] == ["body", "waist"]
bpy.context.view_layer.update()
for obj in objects:
    obj.select_set(True)
assert bpy.ops.export_scene.coseg_collection(directory=work + "/exported", parts=2) == {"FINISHED"}
groups = coseg_blender.import_run(bpy.context, work + "/run", "GROUPS")
assert all([g.name for g in o.vertex_groups] == ["body", "waist"] for o in groups)
first = groups[0]
corners = {c for p, l in zip(first.data.polygons, map(int, open(f"{work}/run/labels/peanut 1.seg"))) if l == 1 for c in p.vertices}
assert {v.index for v in first.data.vertices if any(g.group == 1 for g in v.groups)} == corners
# Shapes of other origins stand side by side, and faces that Blender does not hold are left out with their labels.
from coseg_blender import run_folder
far = run_folder.Shape("far\udce9", [(100.0 + x, 100.0 * y, z) for x, y, z in ((0, 1, 0), (1, 1, 0), (1, 1.01, 0), (0, 1, 1))],
                       [(0, 1, 2), (3,), (1, 1, 2), (0, 1, 3), (2, 1, 0), (0, 2, 3)], [0, 1, 1, 1, 1, 0])
near = run_folder.Shape("near", [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [(0, 1, 2)], [1])
coseg_blender.run_folder.read_run = lambda folder: run_folder.Run(folder, ["body", "waist"], [(1, 2, 3)] * 2, [far, near])
for scale in (False, True):
    placed = coseg_blender.import_run(bpy.context, "", scale=scale)
    bpy.context.view_layer.update()
    assert placed[0].name.startswith("far\ufffd"), placed[0].name
    assert [p.material_index for p in placed[0].data.polygons] == [0, 1, 0]
    assert [one.value for one in placed[0].data.attributes["coseg_face"].data] == [0, 3, 5]
    assert not placed[0].data.validate()
    points = [[o.matrix_world @ v.co for v in o.data.vertices] for o in placed]
    assert max(abs(x) for o in points for v in o for x in v) < 4, "a shape is away from its place"
    assert min(v.y for v in points[0]) > max(v.y for v in points[1]) + 0.05, "shapes stand in each other"
bpy.context.view_layer.objects.active = placed[0]
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.mesh.normals_make_consistent()
bpy.ops.object.mode_set(mode="OBJECT")
coseg_blender.unregister()
print("inside: ok")
END
timeout 100 blender --background --factory-startup --python-exit-code 1 --python "$work/inside.py" -- "$(dirname "$addon")" "$work" \
    >"$work/blender.log" 2>&1 || fail "inside Blender: $(tail -5 "$work/blender.log")"
grep -q "inside: ok" "$work/blender.log" || fail "Blender did not run the test: $(tail -5 "$work/blender.log")"
[[ $(find "$work/exported" -name '*.off' | wc -l) -eq 3 ]] || fail "three objects are three files"
"$COSEG" check "$work/exported" >/dev/null || fail "coseg refuses what Blender has exported"
echo "ok: blender add-on"
