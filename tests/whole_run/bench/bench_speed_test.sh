#!/usr/bin/env bash
# The harness of the speed benchmark: what it runs, counts and writes; never how fast anything was.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"
speed=$COSEG_SOURCE/bench/speed.py

mkdir "$work/meshes"
peanut "$work/meshes/thin.off" 0.8
peanut "$work/meshes/thick.off" 0.5
peanut "$work/meshes/middle.off" 0.65

# Stands in for the peer: burns a known amount of CPU time and says which files it was given.
cat >"$work/peer" <<END
#!/usr/bin/env python3
import os, sys, time
while time.process_time() < 0.3: pass
os.makedirs(sys.argv[1], exist_ok=False)
open("$work/given", "a").write("|".join(sys.argv[2:]) + "\n")
END
chmod +x "$work/peer"

timeout 100 python3 "$speed" --coseg "$COSEG" --peer "$work/peer" --parts 2 --rounds 2 --json "$work/speed.json" \
    "$work/meshes" -- --patches 10 --seed 5 >"$work/out" || fail "speed.py with a peer"
python3 - "$work" <<'END' || fail "figures with a peer"
import json, sys
work = sys.argv[1]
speed = json.load(open(f"{work}/speed.json"))
assert speed["meshes"] == 3 and speed["faces"] == 3 * 1104 and speed["ranks"] == 2 and speed["parts"] == 2
assert speed["options"] == ["--patches", "10", "--seed", "5"] and "Embree" in speed["versions"]
assert len(speed["rounds"]) == 2
for one in speed["rounds"]:
    # Two processes of 0.3 s each: a sum of 0.6, at once or one after the other.
    assert one["peer"]["cpu"] >= 0.6 and one["peer"]["wall"] >= 0.3
    assert one["wall_ratio"] == one["coseg"]["wall"] / one["peer"]["wall"]
    assert one["cpu_ratio"] == one["coseg"]["cpu"] / one["peer"]["cpu"]
    assert sum(one["coseg"]["stages"].values()) <= one["coseg"]["wall"]
for name in ("wall_ratio", "cpu_ratio"):
    ratios = sorted(one[name] for one in speed["rounds"])
    assert speed[name] == {"min": ratios[0], "median": sum(ratios) / 2, "max": ratios[1]}
assert list(speed["stages"]) == ["describe", "features", "optimise", "align", "cut", "label", "write"]
steps = speed["steps"]
assert {"describe/read", "describe/shape_diameter", "describe/oversegmentation"} <= set(steps)
for one in speed["rounds"]:
    assert all(seconds > 0 for seconds in one["coseg"]["steps"].values())
    # Steps are summed over the 2 ranks.
    assert sum(one["coseg"]["steps"].values()) <= 2 * one["coseg"]["stages"]["describe"]
shares = [line.split("|") for line in open(f"{work}/given").read().split()]
assert len(shares) == 4 and sorted(map(len, shares)) == [1, 1, 2, 2]
given = sorted(path for share in shares for path in share)
assert given == sorted(2 * [f"{work}/meshes/{name}.off" for name in ("thin", "thick", "middle")])
END
grep -q '^round 2: coseg .* peer .* ratio' "$work/out" || fail "no line for round 2"
echo "ok: with a peer"

timeout 100 python3 "$speed" --coseg "$COSEG" --ranks 1 --parts 2 --rounds 1 --json "$work/alone.json" "$work/meshes" \
    -- --patches 10 >"$work/out" || fail "speed.py without a peer"
python3 -c 'import json, sys; s = json.load(open(sys.argv[1])); assert "peer" not in s and "wall_ratio" not in s and s["ranks"] == 1' \
    "$work/alone.json" || fail "figures without a peer"
echo "ok: without a peer"

# A run that fails is no measurement.
printf '#!/bin/sh\necho "no such mesh"\nexit 3\n' >"$work/peer"
mkdir "$work/empty"
refuses "a peer that fails" 1 "ended with code 3" python3 "$speed" --coseg "$COSEG" --peer "$work/peer" --parts 2 \
    --rounds 1 "$work/meshes" -- --patches 10
refuses "a folder without meshes" 2 "has no OFF files" python3 "$speed" --coseg "$COSEG" --parts 2 "$work/empty"
refuses "a program that is not there" 2 "cannot be run" python3 "$speed" --coseg "$work/none" --parts 2 "$work/meshes"
