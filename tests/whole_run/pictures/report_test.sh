#!/usr/bin/env bash
# report.html: one small self-contained file, the same on any number of ranks, that works in a browser.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

"$COSEG" generate goblet --count 5 --seed 2 --faces 2000 --out "$work/set" >"$work/out"
status=0
"$COSEG" run --quiet --patches 20 --oversegmentations 1 --geodesic-samples 40 --parts 3 --out "$work/result" "$work/set/meshes" || status=$?
[[ $status -eq 0 ]] || fail "the run ends with $status"
if [[ ! -f $work/result/report.html ]]; then
    "$COSEG" report "$work/result" 2>&1 | grep -q libjs-three || fail "no report.html and no word why"
    echo "skipped: built without libjs-three and libjs-chart.js"
    exit 77
fi
size=$(stat -c %s "$work/result/report.html")
((size > 1000000 && size < 5000000)) || fail "report.html has $size bytes"
if grep -oE '(src|href)="[^"]{0,40}' "$work/result/report.html" | grep -vE '="data:' | grep -q .; then
    fail "report.html refers to other files"
fi
ranks 1 "$COSEG" report "$work/result" --truth "$work/set/truth" >"$work/out"
cp "$work/result/report.html" "$work/one.html"
ranks 3 "$COSEG" report "$work/result" --truth "$work/set/truth" >"$work/out"
cmp "$work/one.html" "$work/result/report.html" || fail "the report depends on the ranks"
echo "ok: self-contained, the same on 1 and 3 ranks"
"$COSEG" run --quiet --patches 20 --oversegmentations 1 --geodesic-samples 40 --parts 3 --scope rows --out "$work/paper" "$work/set/meshes"
accuracy=(--accuracy)
for report in "$work/result" "$work/paper"; do
    status=0
    python3 "$(dirname "${BASH_SOURCE[0]}")/report_in_browser.py" "$report/report.html" 5 3 "${accuracy[@]}" || status=$?
    [[ $status -eq 0 || $status -eq 77 ]] || fail "the report of $report in a browser"
    accuracy=() # the second run has no known labels
done
exit "$status"
