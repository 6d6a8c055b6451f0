#!/usr/bin/env bash
# coseg cluster on matrices as users make them: what is wrong is named with the file and ends all ranks with its exit code;
# what is merely unusual (one item, one feature, duplicates, no penalties) is clustered, in both scopes.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

python=/usr/bin/python3
"$python" -c "import numpy, h5py" 2>/dev/null || { echo "skipped: no numpy and h5py"; exit 77; }
"$python" - "$work" <<'END'
import h5py, numpy as np, sys
random = np.random.default_rng(5)
groups = np.arange(40, dtype="i4") // 10


def made(features=2, items=40):
    parts = [random.random((4, 12))[np.arange(items) % 4] ** 3 + 0.2 * random.random((items, 12)) for _ in range(features)]
    return [x / np.linalg.norm(x, axis=1, keepdims=True) for x in parts]


def write(name, features, mesh_of=groups, **others):
    with h5py.File(f"{sys.argv[1]}/{name}.h5", "w") as file:
        for h, x in enumerate(features):
            file[f"features/f{h}"] = x
        if mesh_of is not None:
            file["mesh_of"] = mesh_of
        for place, values in others.items():
            file[place.replace("__", "/")] = np.asarray(values)


def changed(name, value, row=7, h=1):
    x = made()
    x[h][row] = value
    write(name, x)


good = made()
write("good", good)
changed("nan", np.nan)
changed("infinite", np.inf)
changed("negative", -1e-3)
changed("zero", 0.0)
changed("tiny", 1e-200)
changed("huge", 1e200)
write("ragged", [good[0], good[1][:37]])
write("flat", [good[0].reshape(-1)])
write("complex", [good[0].astype(complex)])
write("no_items", [np.zeros((0, 5))], None)
write("no_rows", [np.zeros((40, 0))])
write("area", good, patch_area=np.full(40, np.nan))
write("far", good, np.r_[np.zeros(39), 2e9].astype("i4"))
write("fractions", good, np.linspace(0, 3, 40))
pair = dict(neighbors__first=[0], neighbors__second=[1], neighbors__boundary_length=[1.0], neighbors__concavity=[0.5])
write("concavity", good, **(pair | {"neighbors__concavity": [np.nan]}))
write("length", good, **(pair | {"neighbors__boundary_length": [np.inf]}))
write("one_group", good, np.zeros(40, "i4"))
write("one_item", made(items=1), np.zeros(1, "i4"))
write("one_feature", made(1))
write("integers", [(1000 * x).astype("i4") for x in good])
for x in good:
    x[[11, 12, 33]] = x[2]
write("duplicates", good)
write("all_alike", [np.tile(x[:1], (40, 1)) for x in good])
END

parts=4
cluster() { # NAME RANKS OPTION... : of NAME.h5
    local command=("$COSEG" cluster --parts "$parts" --out "$work/k.txt" --coefficients "$work/w.h5" "${@:3}" "$work/$1.h5")
    rm -f "$work/k.txt" "$work/w.h5"
    if (($2 == 1)); then "${command[@]}"; else ranks "$2" "${command[@]}"; fi
}
# bad NAME WORDS : refused with a sentence that names the file, and nothing is written.
bad() {
    refuses "$1" 3 "$2" cluster "$1" 1
    grep -q -F "$1.h5" "$work/err" || fail "$1: the file is not named"
    [[ ! -e $work/k.txt && ! -e $work/w.h5 ]] || fail "$1: a refused file left results"
}
bad nan "feature 2, column 8 holds a value that is not a finite number"
bad infinite "feature 2, column 8 holds a value that is not a finite number"
bad negative "feature 2, column 8 holds the negative value"
bad zero "feature 2, column 8 is all zeros"
bad tiny "feature 2, column 8 is all zeros (or too small to square)"
bad huge "feature 2, column 8 is too large to square"
bad ragged "feature 2 has 37 columns but feature 1 has 40"
bad flat "has 1 axes, not 2"
bad complex "does not hold numbers"
bad no_items "no columns"
bad no_rows "feature 1, column 1 is all zeros"
bad area "'patch_area' holds a value"
bad far "'mesh_of' holds the number 2000000000"
bad fractions "'mesh_of' holds floating-point numbers"
bad concavity "'neighbors/concavity' holds a value"
bad length "'neighbors', pair 0"
for scope in rows meshes; do refuses "a bad file on 4 ranks, scope $scope" 3 "feature 2, column 8" cluster nan 4 --scope $scope; done
refuses "a bad dataset on 2 ranks" 3 "'neighbors', pair 0" cluster length 2
refuses "one group cannot be linked" 3 "at least two groups" cluster one_group 2 --scope meshes
refuses "more parts than items" 2 "4 parts are asked for" cluster one_item 2
[[ ! -e $work/w.h5 ]] || fail "solved although there are more parts than items"

# fine NAME RANKS OPTION... : clustered; the bounds are in order, the gap is reached, each item has its part.
fine() {
    cluster "$@" >"$work/answer.json" 2>"$work/err" || { cat "$work/err" >&2; fail "$*"; }
    "$python" - "$work/answer.json" "$work/k.txt" <<'END' || fail "$*: certificate or parts"
import json, sys
answer, parts = json.load(open(sys.argv[1])), [int(line) for line in open(sys.argv[2])]
assert answer["reason"] == "gap_reached" and answer["lower_bound"] <= answer["objective"], answer
assert [parts.count(k) for k in range(answer["parts"])] == answer["items_of_part"] and len(parts) == answer["n"], answer
END
    echo "ok: $*"
}
parts=1
fine one_item 2
parts=4
fine one_group 2
for scope in rows meshes; do
    fine one_feature 2 --scope $scope
    fine integers 2 --scope $scope --unit-columns
    fine duplicates 2 --scope $scope
    fine all_alike 2 --scope $scope
    fine good 2 --scope $scope --alpha 0 --beta 0 --lambda 0
    parts=1
    fine good 2 --scope $scope --beta 1e6 # W = 0, and nothing to cut
    parts=4
    refuses "optimum W = 0, scope $scope" 3 "the optimum is W = 0 (certified)" cluster good 2 --scope $scope --beta 1e6
    for limit in "--max-iterations 2" "--max-seconds 0"; do
        # shellcheck disable=SC2086  # two words
        refuses "$limit, scope $scope" 5 "was not reached" cluster good 2 --scope $scope --gap 1e-13 $limit
        [[ -s $work/k.txt && -s $work/w.h5 ]] || fail "$limit, scope $scope: the last state is not kept"
    done
done
for variant in single-feature independent concatenated ssc ssc-signed ssqp; do
    fine one_feature 1 --variant $variant
    fine duplicates 1 --variant $variant --alpha 0 --beta 0 --lambda 0 --unit-columns
done
for variant in single-feature independent concatenated ssc ssc-signed; do
    refuses "optimum W = 0, $variant" 3 "the optimum is W = 0 (certified)" cluster good 1 --variant $variant --beta 1e6
done
cp "$work/good.h5" "$work/kept.h5"
refuses "clusters over the input" 2 "is an input, which would be overwritten" \
    "$COSEG" cluster --parts 2 --out "$work/kept.h5" "$work/kept.h5"
refuses "coefficients over the input" 2 "is an input, which would be overwritten" \
    "$COSEG" cluster --parts 2 --out "$work/k.txt" --coefficients "$work/kept.h5" "$work/kept.h5"
cmp "$work/good.h5" "$work/kept.h5" || fail "the input is overwritten"
refuses "links in row scope" 2 "links would have no effect" "$COSEG" cluster "$work/good.h5" --parts 4 --scope rows --links 5 --out "$work/x"
refuses "one file for two results" 2 "--out and --coefficients name the same file" \
    "$COSEG" cluster "$work/good.h5" --parts 4 --out "$work/x" --coefficients "$work/../${work##*/}/x"
# Before the work: the gap could not be reached, which would be said of a solve.
unreachable=(--gap 1e-14 --max-iterations 1)
refuses "a folder that is not there" 4 "nowhere/x: cannot be created" "$COSEG" cluster "$work/good.h5" --parts 4 "${unreachable[@]}" --out "$work/nowhere/x"
refuses "coefficients in place of a folder" 4 "cannot be written (Is a directory)" \
    "$COSEG" cluster "$work/good.h5" --parts 4 "${unreachable[@]}" --out "$work/x" --coefficients "$work"
[[ ! -e $work/x ]] || fail "a refused command leaves a file"
echo "ok: cluster input"
