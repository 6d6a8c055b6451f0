#!/usr/bin/env bash
# GLB files with textures become GLB files with named parts, with the same bytes but the indices; parts, pieces, borders and
# measures are exported.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"
glb=$COSEG_SOURCE/tests/support/textured_glb.py

"$COSEG" generate pliers --count 4 --seed 2 --faces 2000 --out "$work/set" >"$work/out"
mkdir "$work/meshes"
for mesh in "$work"/set/meshes/*.off; do python3 "$glb" make "$mesh" "$work/meshes/$(basename "$mesh" .off).glb"; done
"$COSEG" run --quiet --patches 20 --oversegmentations 1 --geodesic-samples 40 --no-choose --parts 3 \
    --out "$work/result" "$work/meshes"
printf 'left arm\nright arm\njaw\n' >"$work/result/names.txt"
ranks 2 "$COSEG" export "$work/result" --to glb,borders --no-descriptors >"$work/out"
for mesh in "$work"/meshes/*.glb; do
    name=$(basename "$mesh" .glb)
    python3 "$glb" check "$mesh" "$work/result/glb/$name.glb" "$work/result/labels/$name.seg" "left arm" "right arm" jaw ||
        fail "what became of $name"
done
"$COSEG" check "$work/result/glb" --json "$work/check.json" >"$work/out" 2>&1 || fail "the exported files are not read"
echo "ok: GLB in, GLB with named parts out"

python3 - "$work" <<'END_PYTHON' || fail "the measures"
import csv, json, math, sys
work = sys.argv[1]
faces = {m["name"]: m["faces"] for m in json.load(open(f"{work}/check.json"))["meshes"]}
rows = list(csv.DictReader(open(f"{work}/result/borders/parts.csv", newline="")))
table = json.load(open(f"{work}/result/borders/parts.json"))
assert table["format"] == "coseg parts 1" and len(table["shapes"]) == 4
assert len(rows) == sum(len(shape["parts"]) for shape in table["shapes"])
for shape in table["shapes"]:
    name = shape["name"]
    mine = [row for row in rows if row["shape"] == name]
    assert faces[name] == sum(1 for line in open(f"{work}/result/labels/{name}.seg"))
    assert abs(sum(float(row["share"]) for row in mine) - 1) < 1e-12
    length = {(int(row["part"]), k): float(row[f"border_{k}"]) for row in mine for k in range(3)}
    assert all(abs(length[a, b] - length.get((b, a), 0)) < 1e-9 for a, b in length)
    points, drawn = [], 0.0
    for line in open(f"{work}/result/borders/{name}.obj"):
        word, *rest = line.split()
        if word == "v":
            points.append(tuple(map(float, rest)))
        if word == "l":
            ends = [points[int(k) - 1] for k in rest]
            drawn += sum(map(math.dist, ends, ends[1:]))
    assert drawn > 0 and abs(drawn - sum(length.values()) / 2) < 1e-9 * drawn
    assert all(float(row["volume"]) > 0 for row in mine) and {row["name"] for row in mine} <= {"left arm", "right arm", "jaw"}
END_PYTHON
echo "ok: borders and measures"

"$COSEG" export "$work/result" --to obj,glb,stl --split --instances --out "$work/split" >"$work/out"
"$COSEG" export "$work/result" --to borders --no-descriptors --instances --out "$work/one" >"$work/out"
cmp "$work/one/borders/parts.csv" "$work/result/borders/parts.csv" || fail "measures depend on the number of ranks"
diff -r "$work/one/instances" "$work/split/instances" >"$work/out" || fail "instances depend on what is exported"
name=pliers_0001
[[ -f $work/split/glb/$name/part_0_left_arm_1.glb ]] || fail "no file of the first part: $(ls "$work/split/glb/$name")"
for piece in "$work/split/glb/$name"/*.glb; do
    [[ $(basename "$piece" .glb) =~ ^part_([0-9]+)_(.*)_([0-9]+)$ ]] || fail "the name $piece"
    part=${BASH_REMATCH[1]} number=${BASH_REMATCH[3]} label=${BASH_REMATCH[2]//_/ }
    python3 "$glb" alone "$work/meshes/$name.glb" "$piece" "$work/result/labels/$name.seg" "$work/split/instances/$name.seg" \
        "$part" "$number" "$label $number" || fail "what is in $piece"
done
for format in obj glb stl; do
    "$COSEG" check "$work/split/$format/$name" --json "$work/split.json" >"$work/out" 2>&1 || true
    python3 - "$work" "$name" <<'END_PYTHON' || fail "the faces of the pieces as $format"
import json, sys
work, name = sys.argv[1:]
labels = [int(line) for line in open(f"{work}/result/labels/{name}.seg")]
pieces = [int(line) for line in open(f"{work}/split/instances/{name}.seg")]
expected = {}
for key in zip(labels, pieces):
    expected[key] = expected.get(key, 0) + 1
found = json.load(open(f"{work}/split.json"))["meshes"]
assert sorted(mesh["faces"] for mesh in found) == sorted(expected.values()), (found, expected)
assert min(pieces) == 1
END_PYTHON
done
echo "ok: every piece in a file of its own"
