#!/usr/bin/env bash
# The same labels, patches and objective, to the byte, on 1, 2, 3 and 4 ranks, for both presets.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/fixture.sh"

"$COSEG" generate table --count 7 --seed 5 --faces 2000 --out "$work/set"
for preset in default paper; do
    for count in 1 2 3 4; do
        ranks "$count" "$COSEG" run --quiet --preset "$preset" --parts 2 --patches 20 --geodesic-samples 100 \
            --out "$work/$preset.$count" "$work/set/meshes"
        diff -r "$work/$preset.1/labels" "$work/$preset.$count/labels" || fail "$preset: labels differ on $count ranks"
        diff -r "$work/$preset.1/patches" "$work/$preset.$count/patches" || fail "$preset: patches differ on $count ranks"
        diff <(grep '"objective"' "$work/$preset.1/report.json") <(grep '"objective"' "$work/$preset.$count/report.json") ||
            fail "$preset: the objective differs on $count ranks"
    done
    echo "ok: $preset"
done
