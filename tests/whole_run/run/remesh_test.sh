#!/usr/bin/env bash
# Turned tables drawn with few rings of long thin triangles are cut like their finely meshed twins, on any number of ranks.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

# turned_tables FOLDER LENGTH : five tables of a plate (0), a stem (1) and a foot (2); walls cut into rings of that length, 0: not cut
turned_tables() {
    python3 - "$1" "$2" <<'END'
import math, os, sys
folder, length = sys.argv[1], float(sys.argv[2])
os.makedirs(folder + "/meshes")
os.makedirs(folder + "/truth")
for k in range(5):
    height, plate, foot, stem, sides = 0.8 + 0.1 * k, 0.7 - 0.04 * k, 0.25 + 0.03 * k, 0.04 + 0.006 * k, 96
    corners = [(0, 0, 2), (foot, 0, 2), (foot, 0.2, 2), (stem, 0.25, 1), (stem, height, 0), (plate, height, 0),
               (plate, height + 0.06, 0), (0, height + 0.06, 0)]
    rings = []
    for a, b in zip(corners, corners[1:]):
        pieces = max(1, math.ceil(math.dist(a[:2], b[:2]) / length)) if length > 0 else 1
        rings += [(a[0] + (b[0] - a[0]) * i / pieces, a[1] + (b[1] - a[1]) * i / pieces, a[2]) for i in range(pieces)]
    rings.append(corners[-1])
    points, faces, truth, of_ring = [], [], [], []
    for radius, z, _ in rings:
        count = sides if radius > 0 else 1
        of_ring.append([len(points) + i % count for i in range(sides)])
        points += [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), z) for i in range(count)]
    for low, high, ring in zip(of_ring, of_ring[1:], rings):
        for i in range(sides):
            j = (i + 1) % sides
            for face in ((low[i], low[j], high[j]), (low[i], high[j], high[i])):
                if len(set(face)) == 3:
                    faces.append(face)
                    truth.append(ring[2])
    with open(f"{folder}/meshes/{k}.off", "w") as off:
        off.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        off.writelines("%.9g %.9g %.9g\n" % p for p in points)
        off.writelines("3 %d %d %d\n" % f for f in faces)
    with open(f"{folder}/truth/{k}.seg", "w") as seg:
        seg.writelines(f"{label}\n" for label in truth)
END
}

# accuracy COLLECTION RESULT : one-to-one accuracy in percent
accuracy() {
    "$COSEG" score --json --truth "$1/truth" --labels "$2/labels" "$1/meshes" |
        python3 -c 'import json, sys; print(json.load(sys.stdin)["one_to_one"])'
}

turned_tables "$work/drawn" 0
turned_tables "$work/fine" 0.03
common=(--quiet --no-sheet --no-html --parts 3 --geodesic-samples 100 --oversegmentations 3)
ranks 2 "$COSEG" run "${common[@]}" --out "$work/drawn.auto" "$work/drawn/meshes" 2>"$work/warnings"
"$COSEG" run "${common[@]}" --out "$work/drawn.one" "$work/drawn/meshes"
"$COSEG" run "${common[@]}" --remesh never --out "$work/drawn.never" "$work/drawn/meshes"
ranks 2 "$COSEG" run "${common[@]}" --out "$work/fine.auto" "$work/fine/meshes"

drawn=$(accuracy "$work/drawn" "$work/drawn.auto")
fine=$(accuracy "$work/fine" "$work/fine.auto")
never=$(accuracy "$work/drawn" "$work/drawn.never")
echo "accuracy: drawn $drawn, drawn without remeshing $never, finely meshed $fine"
python3 -c 'import sys; drawn, fine, never = map(float, sys.argv[1:]); sys.exit(not (fine > 95 and drawn > 95 and drawn >= never))' \
    "$drawn" "$fine" "$never" || fail "drawn and finely meshed tables are not cut alike"
diff -r "$work/drawn.auto/labels" "$work/drawn.one/labels" || fail "labels of remeshed shapes differ between 1 and 2 ranks"
grep -q "0.off: .* remeshed internally to" "$work/warnings" || fail "nothing is said of remeshing"
for k in 0 1 2 3 4; do
    [[ $(wc -l <"$work/drawn.auto/labels/$k.seg") -eq $(wc -l <"$work/drawn/truth/$k.seg") ]] || fail "a label a face of the file"
done
python3 - "$work"/{drawn.auto,drawn.never,fine.auto}/report.json <<'END' || fail "what the report says of remeshing"
import json, sys
auto, never, fine = (json.load(open(path))["meshes"] for path in sys.argv[1:])
assert all(m["remeshed"] and m["overlong_area"] > 0.7 and m["working_faces"] > m["faces"] for m in auto), auto
assert not any(m["remeshed"] for m in never + fine)
assert all(m["overlong_area"] < 0.1 for m in fine), fine
END
refuses "an unknown way of remeshing" 2 "--remesh" "$COSEG" run "${common[@]}" --remesh maybe --out "$work/x" "$work/drawn/meshes"
echo "ok: remesh"
