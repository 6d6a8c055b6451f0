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
open(ply, "wb").write(whole)
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
coseg_blender.unregister()
print("inside: ok")
END
timeout 100 blender --background --factory-startup --python-exit-code 1 --python "$work/inside.py" -- "$(dirname "$addon")" "$work" \
    >"$work/blender.log" 2>&1 || fail "inside Blender: $(tail -5 "$work/blender.log")"
grep -q "inside: ok" "$work/blender.log" || fail "Blender did not run the test: $(tail -5 "$work/blender.log")"
[[ $(find "$work/exported" -name '*.off' | wc -l) -eq 3 ]] || fail "three objects are three files"
"$COSEG" check "$work/exported" >/dev/null || fail "coseg refuses what Blender has exported"
echo "ok: blender add-on"
