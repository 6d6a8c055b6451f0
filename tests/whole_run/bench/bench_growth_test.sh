#!/usr/bin/env bash
# The harness of the growth benchmark: what it refines, runs and writes; never how fast anything was.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"
growth=$COSEG_SOURCE/bench/growth.py

python3 - "$COSEG_SOURCE/bench" <<'END' || fail "subdivision"
import math, sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import growth
tetrahedron = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
def volume(vertices, faces):
    det = lambda a, b, c: (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                           + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return sum(det(*(vertices[v] for v in face)) for face in faces) / 6
finer = growth.subdivided(*growth.subdivided(*tetrahedron))
# Closed: V - E + F = 2 with E = 3 F / 2.
assert len(finer[1]) == 64 and len(finer[0]) == 34, (len(finer[0]), len(finer[1]))
assert math.isclose(volume(*finer), volume(*tetrahedron)) and math.isclose(volume(*finer), 1 / 6)
END
echo "ok: subdivision"

timeout 100 python3 "$growth" --coseg "$COSEG" --only faces --largest 8000 --out "$work/growth.json" --table "$work/growth.md" ||
    fail "growth.py"
python3 - "$work/growth.json" <<'END' || fail "figures"
import json, sys
rows = json.load(open(sys.argv[1]))["series"]["faces"]
assert [row["at"] for row in rows] == [2000, 8000]
assert rows[1]["faces"] == 4 * rows[0]["faces"] and all(row["shapes"] == 2 and row["ranks"] == 2 for row in rows)
assert all(0 <= row["idle"] < 1 and 0 < row["seconds_a_mesh"] <= row["describe"] and row["mib_a_rank"] > 1 for row in rows)
END
[[ $(wc -l <"$work/growth.md") -eq 4 ]] || fail "the table"
refuses "a program that fails" 1 "ended with 1" python3 "$growth" --coseg /bin/false --only faces

timeout 100 python3 "$growth" --coseg "$COSEG" --make "$work/made" --faces 24000 --count 2 || fail "growth.py --make"
for mesh in "$work"/made/*.off; do
    read -r _ faces _ < <(sed -n 2p "$mesh")
    ((faces > 20000 && faces < 28000)) || fail "$mesh has $faces faces"
done
[[ $(find "$work/made" -type f | wc -l) -eq 2 && ! -e $work/made/report.json ]] || fail "what --make leaves"
echo "ok: growth"
