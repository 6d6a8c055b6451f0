#!/usr/bin/env bash
# bench/collection.py measures a small collection beside a smaller one: every stage, memory, accuracy and the sizes of the pages.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

python3 "$COSEG_SOURCE/bench/collection.py" --coseg "$COSEG" --family pliers --shapes 6 --beside 4 --faces 2000 --scratch "$work/scratch" \
    --out "$work/collection.json" --table "$work/collection.md" -- --patches 20 --geodesic-samples 100
python3 - "$work/collection.json" <<'END' || fail "collection.json"
import json, sys
result = json.load(open(sys.argv[1]))
small, large = result["rows"]
assert (small["shapes"], large["shapes"]) == (4, 6), result
for row in result["rows"]:
    assert row["parts"] == 3 and row["cpu"] > 0 and row["peak_mib"] > 20 and row["most_open_files"] > 3, row
    assert [stage["stage"] for stage in row["stages"]][:6] == ["describe", "features", "optimise", "align", "cut", "label"], row
    assert 50 < row["accuracy"] <= 100 and row["bytes"]["report.json"] > 1000, row
END
grep -q '^| 6 pliers | ' "$work/collection.md" || { cat "$work/collection.md" >&2; fail "the table"; }
echo "ok: two collections"
