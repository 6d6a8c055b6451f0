#!/usr/bin/env bash
# The same labels, patches and objective, to the byte, on 1, 2, 3, 4 and 8 ranks, for both presets.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 5 "$work/set"
for preset in default paper; do
    for count in 1 2 3 4 8; do
        ranks "$count" "$COSEG" run --quiet --no-sheet --no-html --preset "$preset" --parts 2 --patches 20 --geodesic-samples 50 \
            --out "$work/$preset.$count" "$work/set/meshes"
        diff -r "$work/$preset.1/labels" "$work/$preset.$count/labels" || fail "$preset: labels differ on $count ranks"
        diff -r "$work/$preset.1/patches" "$work/$preset.$count/patches" || fail "$preset: patches differ on $count ranks"
        diff <(grep '"objective"' "$work/$preset.1/report.json") <(grep '"objective"' "$work/$preset.$count/report.json") ||
            fail "$preset: the objective differs on $count ranks"
    done
    echo "ok: $preset"
done

several=(--quiet --no-sheet --no-html --parts 2 --patches 20 --geodesic-samples 50 --word-sets 3)
for count in 1 3; do ranks "$count" "$COSEG" run "${several[@]}" --out "$work/words.$count" "$work/set/meshes"; done
diff -r "$work/words.1/labels" "$work/words.3/labels" || fail "several sets of words: labels differ on 3 ranks"
objective() { grep '"objective"' "$1/report.json"; }
diff <(objective "$work/words.1") <(objective "$work/words.3") || fail "several sets of words: the objective differs on 3 ranks"
[[ $(objective "$work/words.1") != $(objective "$work/default.1") ]] || fail "several sets of words change nothing"
echo "ok: several sets of words"
