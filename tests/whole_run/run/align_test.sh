#!/usr/bin/env bash
# Shapes that are turned at random are aligned by their parts, for labels, pictures and instances; shapes that stand alike stay.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

"$COSEG" generate quadruped --count 7 --seed 3 --faces 2000 --out "$work/set" >/dev/null
python3 - "$COSEG_SOURCE/bench" "$work/set/meshes" "$work/turned" <<'END'
import os, sys
sys.path.insert(0, sys.argv[1])
from accuracy import turn_meshes
turn_meshes(sys.argv[2], os.listdir(sys.argv[2]), sys.argv[3])
END
common=(--parts 4 --patches 30 --geodesic-samples 100 --oversegmentations 3 --no-html)
# What is described once serves all runs but that on two ranks.
ranks 2 "$COSEG" run "${common[@]}" --out "$work/two" "$work/turned" 2>"$work/log"
"$COSEG" run "${common[@]}" --quiet --state "$work/state" --out "$work/one" "$work/turned"
"$COSEG" run "${common[@]}" --quiet --align off --state "$work/state" --out "$work/off" "$work/turned"
"$COSEG" run "${common[@]}" --no-sheet --state "$work/state" --out "$work/upright" "$work/set/meshes" 2>"$work/upright.log"
"$COSEG" run "${common[@]}" --no-sheet --quiet --align off --state "$work/state" --out "$work/upright_off" "$work/set/meshes"

grep -q "align .* aligned: links agree to" "$work/log" || fail "the log says nothing of the alignment"
grep -q "align .* as they stand: .* stand like the others already" "$work/upright.log" || fail "the log says not why nothing is aligned"
for file in labels alignment.json contact_sheet.png; do
    diff -r "$work/one/$file" "$work/two/$file" || fail "$file differs between 1 and 2 ranks"
done
diff -r "$work/upright/labels" "$work/upright_off/labels" || fail "labels of shapes that stand alike change with --align"
python3 - "$COSEG_SOURCE/bench" "$work" <<'END' || fail "alignment.json"
import json, math, os, sys
sys.path.insert(0, sys.argv[1])
from accuracy import random_rotation
from alignment import angle, product
work = sys.argv[2]
read = lambda run: json.load(open(f"{work}/{run}/alignment.json"))
aligned, off, upright = read("one"), read("off"), read("upright")
assert aligned["aligned"] and not off["aligned"] and not upright["aligned"], (aligned["reason"], upright["reason"])
assert off["reason"] == "it is switched off", off
together = [product(s["rotation"], random_rotation(s["name"] + ".off")) for s in aligned["shapes"]]
best = min(sorted(angle(a, b) for b in together)[5] for a in together)
assert best < 12, f"six of seven shapes differ by up to {best} degrees"
identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
assert all(s["rotation"] == identity for s in off["shapes"] + upright["shapes"])
# The transform takes the shape's centre to about the origin and its size to about that of all.
for s in aligned["shapes"]:
    rows = open(f"{work}/turned/{s['name']}.off").read().split("\n")
    points = [[float(x) for x in row.split()] for row in rows[2:2 + int(rows[1].split()[0])]]
    placed = [[s["scale"] * sum(r * x for r, x in zip(row, p)) + t for row, t in zip(s["rotation"], s["translation"])] for p in points]
    mean = [sum(p[a] for p in placed) / len(placed) for a in range(3)]
    size = math.sqrt(sum(math.dist(p, mean) ** 2 for p in placed) / len(placed) / 3)
    assert math.hypot(*mean) < 0.5 and 0.7 < size < 1.4, (s["name"], mean, size)
END
# Subsets are aligned each for its own cut, and then all together.
ranks 2 "$COSEG" run "${common[@]}" --quiet --no-sheet --subsets 5 --state "$work/state" --out "$work/subsets" "$work/turned"
python3 - "$COSEG_SOURCE/bench" "$work" <<'END' || fail "the alignment of subsets"
import json, sys
sys.path.insert(0, sys.argv[1])
from accuracy import random_rotation
from alignment import angle, product
subsets = json.load(open(sys.argv[2] + "/subsets/alignment.json"))
assert subsets["aligned"], subsets["reason"]
together = [product(s["rotation"], random_rotation(s["name"] + ".off")) for s in subsets["shapes"]]
best = min(sorted(angle(a, b) for b in together)[4] for a in together)
assert best < 15, f"five of seven shapes differ by up to {best} degrees"
END
accuracy_of() { "$COSEG" score --json --truth "$work/set/truth" --labels "$work/$1/labels" "$work/turned" | python3 -c 'import json, sys; print(round(json.load(sys.stdin)["one_to_one"]))'; }
(($(accuracy_of subsets) > $(accuracy_of one) - 5)) || fail "labels of subsets: $(accuracy_of subsets) %, of the whole $(accuracy_of one) %"
"$COSEG" render --out "$work/again" "$work/one" >/dev/null
cmp "$work/again/contact_sheet.png" "$work/one/contact_sheet.png" || fail "coseg render does not turn the shapes as the run did"
if cmp -s "$work/off/contact_sheet.png" "$work/one/contact_sheet.png"; then fail "the sheet is not aligned"; fi
python3 "$COSEG_SOURCE/bench/alignment.py" --coseg "$COSEG" --generated quadruped --shapes 4 --ranks 1 --table "$work/table" >"$work/bench.log" ||
    fail "bench/alignment.py"
grep -q "^| generated_quadruped | 4 | yes |" "$work/table" || fail "the table of bench/alignment.py: $(cat "$work/table")"
# Two bulbs and a waist, and the same shape upside down: the numbers of the bulbs follow the shape where the run says how it is turned.
mkdir "$work/bulbs"
peanut "$work/bulbs/a.off" 0.6
awk 'NR > 2 && NF == 3 { print $1, -$2, -$3; next } { print }' "$work/bulbs/a.off" >"$work/bulbs/b.off"
"$COSEG" run --quiet --no-sheet --no-html --no-keep-model --align off --parts 2 --patches 10 --geodesic-samples 50 --oversegmentations 3 --out "$work/pieces" "$work/bulbs"
python3 - "$work" <<'END'
import json, sys
work = sys.argv[1]
lines = open(work + "/bulbs/a.off").read().split("\n")
heights = [float(line.split()[2]) for line in lines[2:2 + int(lines[1].split()[0])]]
faces = [list(map(int, line.split()[1:])) for line in lines[2 + len(heights):] if line]
waist = [1 if abs(sum(heights[v] for v in f)) / 3 < 0.2 else 0 for f in faces]
for name in "ab":
    open(f"{work}/pieces/labels/{name}.seg", "w").writelines(f"{part}\n" for part in waist)
END
"$COSEG" export --to obj --instances --out "$work/in_files" "$work/pieces" >/dev/null
python3 - "$work/pieces/alignment.json" <<'END'
import json, sys
alignment = json.load(open(sys.argv[1]))
alignment["aligned"] = True
alignment["shapes"][1]["rotation"] = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]
json.dump(alignment, open(sys.argv[1], "w"))
END
"$COSEG" export --to obj --instances --out "$work/in_frame" "$work/pieces" >/dev/null
cmp -s "$work/in_files/instances/a.seg" "$work/in_files/instances/b.seg" && fail "a shape upside down has the same numbers as it stands"
cmp "$work/in_frame/instances/a.seg" "$work/in_frame/instances/b.seg" || fail "numbers do not follow the alignment"
# New shapes are turned to stand like those of the run, and those that stand like them stay as they are.
new=("$work/turned/quadruped_0001.off" "$work/turned/quadruped_0004.off")
for count in 1 2; do
    ranks $count "$COSEG" assign --to "$work/upright" --quiet --no-html --out "$work/new$count" "${new[@]}"
done
diff -r "$work/new1/labels" "$work/new2/labels" || fail "labels of turned new shapes differ between 1 and 2 ranks"
cmp "$work/new1/alignment.json" "$work/new2/alignment.json" || fail "the poses of new shapes differ between 1 and 2 ranks"
"$COSEG" assign --to "$work/upright" --quiet --no-html --no-sheet --out "$work/standing" "${new[@]/turned/set/meshes}"
"$COSEG" assign --to "$work/upright_off" --quiet --no-html --no-sheet --out "$work/never" "${new[@]}"
python3 - "$COSEG_SOURCE/bench" "$work" <<'END' || fail "new shapes do not stand like the run's"
import json, sys
sys.path.insert(0, sys.argv[1])
from accuracy import random_rotation
from alignment import angle, product
work = sys.argv[2]
read = lambda run: json.load(open(f"{work}/{run}/alignment.json"))
new = read("new1")
assert new["aligned"] and new["agreement_after"] > 2 * new["agreement_before"], new
for s in new["shapes"]:
    together = product(s["rotation"], random_rotation(s["name"] + ".off"))
    assert s["found"] and angle(together, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) < 12, (s["name"], together)
assert not read("standing")["aligned"] and not read("never")["aligned"]
same = total = 0
for name in ("quadruped_0001", "quadruped_0004"):
    turned, standing = (open(f"{work}/{run}/labels/{name}.seg").read().split() for run in ("new1", "standing"))
    same += sum(a == b for a, b in zip(turned, standing))
    total += len(turned)
assert same > .95 * total, f"{same} of {total} faces have the labels of the shape that stands"
END
# Also where places do not count, pictures show a new shape as it stands in the frame of the run: one of the run itself, as there.
"$COSEG" run "${common[@]}" --quiet --no-sheet --no-places --state "$work/state" --out "$work/no_places" "$work/turned"
cp "$work/turned/quadruped_0002.off" "$work/again.off"
"$COSEG" assign --to "$work/no_places" --quiet --no-html --no-sheet --out "$work/added" "$work/again.off"
python3 - "$COSEG_SOURCE/bench" "$work" <<'END' || fail "a new shape is not turned where places do not count"
import json, sys
sys.path.insert(0, sys.argv[1])
from alignment import angle
of_run, of_new = (json.load(open(f"{sys.argv[2]}/{run}/alignment.json")) for run in ("no_places", "added"))
[inside] = [s["rotation"] for s in of_run["shapes"] if s["name"] == "quadruped_0002"]
assert of_run["aligned"] and of_new["aligned"] and angle(of_new["shapes"][0]["rotation"], inside) < 12, (inside, of_new)
END
refuses "an unknown way of aligning" 2 "--align" "$COSEG" run "${common[@]}" --align maybe --out "$work/x" "$work/turned"
echo "ok: align"
