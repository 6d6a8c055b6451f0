#!/usr/bin/env bash
# --subsets and --segments: the collection cut in overlapping subsets is cut like the whole one; the same on any number of ranks.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
for waist in 0.40 0.45 0.50 0.55 0.60 0.65 0.70; do peanut "$work/set/p$waist.off" $waist; done
patches=(--quiet --patches 8 --geodesic-samples 40 --oversegmentations 3 --bins 20 --no-sheet --no-html)
common=("${patches[@]}" --parts 2)

"$COSEG" run "${common[@]}" --out "$work/whole" "$work/set"
for count in 1 2 3; do
    ranks $count "$COSEG" run "${common[@]}" --subsets 4 --out "$work/subsets$count" "$work/set"
    diff -r "$work/subsets1/labels" "$work/subsets$count/labels" || fail "--subsets gives other labels on $count ranks"
done
python3 - "$work/subsets1/report.json" "$work/subsets2/report.json" "$work/whole/report.json" <<'END' || fail "report of subsets"
import json, sys
one, two, whole = (json.load(open(path)) for path in sys.argv[1:])
o = one["optimisation"]
assert (o["subsets"], o["common_meshes"]) == (3, 2), o  # 2 common and 5 others, 2 to a subset
assert 0.5 <= o["subset_agreement"] <= 1, o
assert o["allowed_pairs"] < whole["optimisation"]["allowed_pairs"] and whole["optimisation"]["subsets"] == 1
assert o["lower_bound"] <= o["objective"]
assert one["features"]["coefficient_blocks"] == two["features"]["coefficient_blocks"]
END
"$COSEG" run "${common[@]}" --subsets 7 --out "$work/one" "$work/set"
diff -r "$work/one/labels" "$work/whole/labels" || fail "a single subset is not the whole"

for count in 1 2; do
    ranks $count "$COSEG" run "${common[@]}" --segments --out "$work/segments$count" "$work/set"
    [[ $(wc -l <"$work/segments$count/labels/p0.40.seg") -eq 1104 ]] || fail "--segments: a part a face"
done
diff -r "$work/segments1/labels" "$work/segments2/labels" || fail "--segments gives other labels on 2 ranks"

refuses "more parts than patches of a subset" 2 "--parts 97 exceeds the 96 patches of a subset of --subsets 4" \
    "$COSEG" run "${patches[@]}" --parts 97 --subsets 4 --out "$work/x" "$work/set"
refuses "subsets that are too small" 2 "--subsets" "$COSEG" run "${common[@]}" --subsets 3 --out "$work/x" "$work/set"
echo "ok: subsets and segments"
