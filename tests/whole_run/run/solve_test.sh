#!/usr/bin/env bash
# coseg solve: one JSON object on standard output, the same numbers on any number of ranks, documented exit codes.
set -euo pipefail

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1 OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }

# Two features of unit columns in the plane: the angles of six patches.
python3 - "$folder/problem.txt" <<'PYTHON'
import math, sys
angles = [0.1, 0.15, 0.2, 1.2, 1.25, 1.4]
lines = ["2 2 6", "1 0.01 0.1", "12 0"]
for shift in (0.0, 0.05):
    lines.append(" ".join(repr(math.cos(a + shift)) for a in angles))
    lines.append(" ".join(repr(math.sin(a + shift)) for a in angles))
open(sys.argv[1], "w").write("\n".join(lines) + "\n")
PYTHON

# check FILE: the object parses, has what is promised, and its bounds are in order.
check() {
    python3 - "$1" <<'PYTHON'
import json, sys
answer = json.load(open(sys.argv[1]))
for key in ("objective", "lower_bound", "relative_gap", "iterations", "nonzero_groups", "reason", "kkt_residual",
            "working_pairs", "passes", "seconds", "ranks", "solver", "scope", "n", "h", "lambda", "alpha", "beta"):
    assert key in answer, key
assert answer["lower_bound"] <= answer["objective"] <= answer["objective_at_zero"], answer
assert answer["relative_gap"] <= 1e-8, answer
assert answer["reason"] == "gap_reached", answer
assert (answer["n"], answer["h"], answer["lambda"]) == (6, 2, 1), answer
assert answer["nonzero_groups"] > 0, answer
for row in answer["history"]:
    assert row["lower_bound"] <= answer["objective"] * (1 + 1e-12) and row["pass"] > 0, row
last = answer["history"][-1]
assert last["objective"] == answer["objective"] and last["relative_gap"] == answer["relative_gap"], last
PYTHON
}

for scope in rows meshes; do
    for ranks in 1 3; do
        mpirun -n $ranks "$COSEG" solve "$folder/problem.txt" --scope $scope --gap 1e-8 > "$folder/$scope$ranks.json" \
            || fail "scope $scope on $ranks ranks ended with $?"
        check "$folder/$scope$ranks.json"
        grep -vE '"(seconds|ranks)"' "$folder/$scope$ranks.json" > "$folder/$scope$ranks.txt"
        cmp "$folder/${scope}1.txt" "$folder/$scope$ranks.txt" || fail "scope $scope differs on $ranks ranks"
    done
done

for variant in single-feature independent concatenated ssc ssc-signed ssqp; do
    "$COSEG" solve "$folder/problem.txt" --variant $variant --gap 1e-8 > "$folder/$variant.json" \
        || fail "variant $variant ended with $?"
    check "$folder/$variant.json"
done
"$COSEG" solve "$folder/problem.txt" --scope meshes --links 2 --gap 1e-8 > "$folder/links.json"
check "$folder/links.json"
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["allowed_pairs"] == 12' "$folder/links.json" \
    || fail "pairs that links allow"

"$COSEG" solve "$folder/problem.txt" --solver dense --gap 1e-8 > "$folder/dense.json"
check "$folder/dense.json"
python3 - "$folder/dense.json" "$folder/rows1.json" <<'PYTHON'
import json, sys
dense, sparse = (json.load(open(name))["objective"] for name in sys.argv[1:])
assert abs(dense - sparse) <= 1e-8 * dense, (dense, sparse)
PYTHON

# expect CODE WORDS ARGUMENTS...: ends with CODE and says WORDS.
expect() {
    local code=$1 words=$2 status=0 launcher=()
    shift 2
    ((code == 2)) || launcher=(mpirun -n 2) # the command line is the same on any number of ranks
    timeout 60 "${launcher[@]}" "$COSEG" solve "$@" > "$folder/out" 2> "$folder/err" || status=$?
    [ "$status" -eq "$code" ] || fail "solve $* ended with $status instead of $code: $(cat "$folder/err")"
    grep -q -- "$words" "$folder/err" || fail "solve $* did not say '$words' but: $(cat "$folder/err")"
}

expect 5 "was not reached" "$folder/problem.txt" --solver dense --gap 1e-12 --max-iterations 2
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["reason"] == "iteration_limit"' "$folder/out" \
    || fail "no JSON beside exit code 5"
expect 2 "" "$folder/problem.txt" --solver fast
expect 2 "" "$folder/problem.txt" --gap 2
expect 2 "not finite" "$folder/problem.txt" --gap nan
expect 2 "not finite" "$folder/problem.txt" --max-seconds nan
expect 2 "feature 3 is asked for" "$folder/problem.txt" --variant single-feature --feature 3
expect 2 "is an input, which would be overwritten" "$folder/problem.txt" --coefficients "$folder/problem.txt"
expect 2 "needs --scope meshes" "$folder/problem.txt" --links 2
expect 2 "at least 2" "$folder/problem.txt" --scope meshes --links 1
expect 2 "" "$folder/problem.txt" --no-such-option
expect 3 "cannot open" "$folder/missing.txt"
head -n 5 "$folder/problem.txt" > "$folder/short.txt"
expect 3 "short.txt, line" "$folder/short.txt"
sed '5s/[^ ]*/nan/' "$folder/problem.txt" > "$folder/nan.txt"
expect 3 "nan.txt, line 5" "$folder/nan.txt"
printf '9 9000000 900000000\n1 1 1\n0 0\n' > "$folder/huge.txt"
expect 3 "too short" "$folder/huge.txt"
printf '1 2 2\n1 1 1\n0 0\n1 0\n1 0\n' > "$folder/zero.txt"
expect 3 "feature 1, column 2 is all zeros" "$folder/zero.txt"
echo "solve: JSON, ranks and exit codes as documented"
