#!/usr/bin/env bash
# --variant and --links: every form of the problem runs and says what it was; links are the same on any number of ranks.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
for waist in 0.4 0.5 0.6 0.7 0.8; do peanut "$work/set/p$waist.off" $waist; done
common=(--quiet --patches 8 --geodesic-samples 40 --bins 20 --parts 2 --no-sheet --no-html)

# facts FOLDER VARIANT SCOPE FEATURES: what the report says of the optimisation, and its certificate.
facts() {
    python3 - "$@" <<'END' || fail "report of $2"
import json, sys
folder, variant, scope, features = sys.argv[1:]
report = json.load(open(folder + "/report.json"))
o = report["optimisation"]
assert (o["variant"], o["scope"]) == (variant, scope), o
assert o["lower_bound"] <= o["objective"] <= o["objective_at_zero"], o
assert o["reason"] == "gap_reached" and 0 < o["nonzero_groups"] <= o["allowed_pairs"], o
names = [row["feature"] for row in report["features"]["strengths"]]
assert names == [features] if features else len(names) == 5, names
END
}

for variant in single-feature independent concatenated ssc ssc-signed ssqp; do
    gap=(--gap 1e-2) # without lambda or with it alone the graph is dense: its test is tests/distributed
    "$COSEG" run "${common[@]}" "${gap[@]}" --variant $variant --out "$work/$variant" "$work/set"
done
facts "$work/single-feature" single-feature meshes shape_diameter
facts "$work/independent" independent meshes ""
facts "$work/concatenated" concatenated meshes concatenated
facts "$work/ssc" ssc rows concatenated
facts "$work/ssc-signed" ssc-signed rows concatenated
facts "$work/ssqp" ssqp rows concatenated

for count in 1 2 3; do
    ranks $count "$COSEG" run "${common[@]}" --links 2 --out "$work/links$count" "$work/set"
    diff -r "$work/links1/labels" "$work/links$count/labels" || fail "--links gives other labels on $count ranks"
done
"$COSEG" run "${common[@]}" --out "$work/all" "$work/set"
python3 - "$work/links1/report.json" "$work/all/report.json" <<'END' || fail "pairs that links allow"
import json, sys
some, every = (json.load(open(path))["optimisation"] for path in sys.argv[1:])
assert (some["links"], every["links"]) == (2, 4)
assert 2 * some["allowed_pairs"] == every["allowed_pairs"]
END

# the baselines are presets: the same as their options, and the same on any number of ranks
"$COSEG" run "${common[@]}" --preset single:shape_diameter --gap 1e-2 --out "$work/single" "$work/set"
diff -r "$work/single/labels" "$work/single-feature/labels" || fail "preset single:shape_diameter is not that variant"
"$COSEG" run "${common[@]}" --preset concatenated --gap 1e-2 --out "$work/stacked" "$work/set"
diff -r "$work/stacked/labels" "$work/concatenated/labels" || fail "preset concatenated is not that variant"
for count in 1 2; do
    ranks $count "$COSEG" run "${common[@]}" --preset descriptor-space --out "$work/space$count" "$work/set"
done
diff -r "$work/space1/labels" "$work/space2/labels" || fail "descriptor-space gives other labels on 2 ranks"
python3 - "$work/space1/report.json" "$work/all/report.json" <<'END' || fail "descriptor-space in the report"
import json, sys
space, every = (json.load(open(path)) for path in sys.argv[1:])
assert space["options"]["partition"] == "diffusion" and space["partition"]["starts"] == [], space["partition"]
blocks = every["features"]["coefficient_blocks"]
assert abs(sum(map(sum, blocks)) - 1) < 1e-9 and len(blocks) == 2, blocks
assert all(0 <= share <= 1 for share in every["features"]["inside_part"])
END
refuses "an unknown baseline" 2 "--preset" "$COSEG" run "${common[@]}" --preset single:colour --out "$work/x" "$work/set"

refuses "links over all pairs" 2 "need --scope meshes" "$COSEG" run "${common[@]}" --scope rows --links 4 --out "$work/x" "$work/set"
refuses "links of an l1 problem" 2 "need --scope meshes" "$COSEG" run "${common[@]}" --variant ssc --links 4 --out "$work/x" "$work/set"
refuses "one link" 2 "links" "$COSEG" run "${common[@]}" --links 1 --out "$work/x" "$work/set"
refuses "feature without weight" 2 "its weight is 0" "$COSEG" run "${common[@]}" --variant single-feature \
    --feature-weights 1,0,1,1,1 --out "$work/x" "$work/set"
echo "ok: variants"
