#!/usr/bin/env bash
# Shapes that come later take the parts of a finished run: as a full run labels them, the same bytes on any number of ranks
# and whatever else is assigned beside them.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

"$COSEG" generate goblet --count 8 --faces 2000 --out "$work/all" >/dev/null
mkdir "$work/old" "$work/new"
cp "$work"/all/meshes/goblet_000[0-5].off "$work/old"
cp "$work"/all/meshes/goblet_000[67].off "$work/new"
bare=(--quiet --no-html --no-sheet)
run=(run "${bare[@]}" --parts 3 --geodesic-samples 100)
ranks 2 "$COSEG" "${run[@]}" --out "$work/full" "$work/all/meshes"
ranks 2 "$COSEG" "${run[@]}" --out "$work/run" "$work/old"
"$COSEG" "${run[@]}" --out "$work/serial" "$work/old"
cmp "$work/run/model.h5" "$work/serial/model.h5" || fail "the model differs between 1 and 2 ranks"

assign=("$COSEG" assign --to "$work/run" "${bare[@]}")
for count in 1 2 4; do
    ranks $count "${assign[@]}" --out "$work/new$count" "$work/new"
    for folder in labels patches ply; do
        diff -r "$work/new1/$folder" "$work/new$count/$folder" || fail "$folder on 1 and on $count ranks"
    done
done
"${assign[@]}" --out "$work/alone" "$work/new/goblet_0007.off"
cmp "$work/alone/labels/goblet_0007.seg" "$work/new1/labels/goblet_0007.seg" || fail "labels depend on what else is assigned"
echo "ok: the same bytes on 1, 2 and 4 ranks, alone and together"

accuracy() {
    "$COSEG" score --json --truth "$work/all/truth" --labels "$1" "$work/$2" |
        python3 -c 'import json, sys; print(json.load(sys.stdin)["one_to_one"])'
}
full=$(accuracy "$work/full/labels" new)
assigned=$(accuracy "$work/new1/labels" new)
# The numbers of the parts must be those of the run: one assignment of parts for old and new shapes together.
cp -r "$work/run/labels" "$work/together"
cp "$work"/new1/labels/* "$work/together"
together=$(accuracy "$work/together" all/meshes)
echo "accuracy of the new shapes: full run $full, assigned $assigned; of all, with one numbering, $together"
python3 -c 'import sys; full, new, all = map(float, sys.argv[1:]); sys.exit(not (new > full - 3 and new > 85 and all > 85))' \
    "$full" "$assigned" "$together" || fail "assigned labels are not those of a full run"
python3 - "$work/new1/report.json" <<'END' || fail "the report of an assignment"
import json, sys
report = json.load(open(sys.argv[1]))
optimisation, options = report["optimisation"], report["options"]
assert optimisation["reason"] == "gap_reached" and 0 <= optimisation["relative_gap"] <= 1e-4, optimisation
assert optimisation["lower_bound"] <= optimisation["objective"] < optimisation["objective_at_zero"], optimisation
assert options["oversegmentations"] == 8 and optimisation["allowed_pairs"] == optimisation["patches"] * 6 * 8 * 50, (options, optimisation)
assert options["parts"] == 3 and options["geodesic-samples"] == 100 and options["to"].endswith("/run"), options
assert [mesh["name"] for mesh in report["meshes"]] == ["goblet_0006", "goblet_0007"]
END
"$COSEG" render "$work/new1" --out "$work/picture" >/dev/null
[[ -s $work/picture/contact_sheet.png ]] || fail "coseg render of an assignment"

"${assign[@]}" --state "$work/state" --out "$work/kept1" "$work/new"
"${assign[@]}" --state "$work/state" --out "$work/kept2" "$work/new"
diff -r "$work/kept2/labels" "$work/new1/labels" || fail "labels with a state folder"
python3 -c 'import json, sys; state = json.load(open(sys.argv[1]))["state"]; sys.exit(state["meshes_reused"] != 2)' \
    "$work/kept2/report.json" || fail "descriptions are not taken from the state folder"

# The run's names of parts are those of the new shapes.
printf '0 cup\n2 foot\n' >"$work/run/names.txt"
"${assign[@]}" --out "$work/named" "$work/new/goblet_0006.off"
[[ $(cat "$work/named/names.txt") == $'0 cup\n2 foot' ]] || fail "names of parts"
rm "$work/run/names.txt"

# Labels of some faces of new shapes: the first half of the faces of one shape has part 0, whatever the run says.
mkdir "$work/examples"
python3 - "$work/new1/labels/goblet_0006.seg" "$work/examples/goblet_0006.seg" <<'END'
import sys
labels = open(sys.argv[1]).read().split()
half = len(labels) // 2
open(sys.argv[2], "w").write("\n".join(["0"] * half + ["-1"] * (len(labels) - half)) + "\n")
END
for count in 1 2 4; do
    ranks $count "${assign[@]}" --examples "$work/examples" --out "$work/by_example$count" "$work/new"
    diff -r "$work/by_example1/labels" "$work/by_example$count/labels" || fail "labels by example on 1 and on $count ranks"
done
python3 - "$work/examples" "$work/by_example1/labels" "$work/new1/labels" <<'END' || fail "what is said is not kept"
import sys
said, got, before = ([int(x) for x in open(folder + "/goblet_0006.seg")] for folder in sys.argv[1:])
assert all(b == a for a, b in zip(said, got) if a >= 0), "a face has another part than is said"
assert any(b != c for b, c in zip(got, before)), "nothing was to be said"
END
"${assign[@]}" --examples "$work/examples" --out "$work/example_alone" "$work/new/goblet_0006.off"
cmp "$work/example_alone/labels/goblet_0006.seg" "$work/by_example1/labels/goblet_0006.seg" ||
    fail "labels of an example depend on what else is assigned"
cp "$work/examples/goblet_0006.seg" "$work/examples/nobody.seg"
refuses "an example of no shape" 3 "nobody.seg: no shape of this name" "${assign[@]}" --examples "$work/examples" --out "$work/x" "$work/new"
rm "$work/examples/nobody.seg"
sed -i '1s/.*/3/' "$work/examples/goblet_0006.seg"
refuses "a part that the run has not" 3 "face 0 has label 3, but there are 3 parts" \
    ranks 2 "${assign[@]}" --examples "$work/examples" --out "$work/x" "$work/new"
sed -i 's/.*/-1/' "$work/examples/goblet_0006.seg"
refuses "examples that say nothing" 3 "no face has a label" "${assign[@]}" --examples "$work/examples" --out "$work/x" "$work/new"
echo "ok: labels of some faces of new shapes are kept"

"$COSEG" run "${bare[@]}" --parts 1 --patches 10 --geodesic-samples 40 --out "$work/one" "$work/old"
ranks 2 "$COSEG" assign --to "$work/one" "${bare[@]}" --out "$work/one_new" "$work/new"
[[ $(sort -u "$work"/one_new/labels/*.seg) == 0 ]] || fail "labels where the run has one part"

refuses "no run" 3 "is no run" "$COSEG" assign --to "$work/old" --out "$work/x" "$work/new"
"$COSEG" run "${bare[@]}" --parts 3 --patches 10 --geodesic-samples 40 --no-choose --no-keep-model --out "$work/bare" "$work/old"
[[ ! -e $work/bare/model.h5 ]] || fail "--no-keep-model keeps a model"
refuses "a run without a model" 3 "holds no model.h5" "$COSEG" assign --to "$work/bare" --out "$work/x" "$work/new"
cp "$work/run/model.h5" "$work/bare/model.h5"
printf 'x' | dd of="$work/bare/model.h5" bs=1 seek=20000 conv=notrunc status=none
refuses "a damaged model" 3 "model.h5" "$COSEG" assign --to "$work/bare" --out "$work/x" "$work/new"
refuses "no mesh" 2 "input" "$COSEG" assign --to "$work/run" --out "$work/x"
refuses "a folder in use" 4 "--force" "$COSEG" assign --to "$work/run" --out "$work/one" "$work/new"
refuses "the folder of the run itself" 2 "holds the run" "$COSEG" assign --to "$work/run" --force --out "$work/run/." "$work/new"
[[ -f $work/run/model.h5 ]] || fail "the run has lost its model"
printf 'OFF\n1 0 0\n0 0 0\n' >"$work/bad.off"
refuses "a mesh that cannot be used" 3 "bad.off" ranks 2 "$COSEG" assign --to "$work/run" --quiet --out "$work/x" "$work/bad.off"
echo "ok: assign"
