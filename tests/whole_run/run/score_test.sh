#!/usr/bin/env bash
# coseg score from outside: figures that can be checked by hand, and one case for each kind of bad input.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# two shapes: a square of area 1 in two triangles, and a rectangle 3 x 1 of one quad and two triangles
mkdir meshes truth labels
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n' >meshes/square.off
printf 'OFF\n6 3 0\n0 0 0\n2 0 0\n3 0 0\n3 1 0\n2 1 0\n0 1 0\n4 0 1 4 5\n3 1 2 3\n3 1 3 4\n' >meshes/strip.off
printf '0\n1\n' >truth/square.seg
printf '0\n1\n1\n' >truth/strip.seg
printf '7\n5\n' >labels/square.seg
printf '7\n7\n5\n' >labels/strip.seg

# strip: 2/3 + 1/6 of the area is right
"$COSEG" score --truth truth --labels labels meshes >table.txt
grep -Eq '^square +100\.00 +100\.00 +1\.0000$' table.txt || fail "row of square: $(cat table.txt)"
grep -Eq '^strip +83\.33 +83\.33 ' table.txt || fail "row of strip: $(cat table.txt)"
grep -Eq '^mean of 2 +91\.67 +91\.67 ' table.txt || fail "row of means: $(cat table.txt)"
grep -q 'one single part for everything would score 58.33$' table.txt || fail "one part: $(cat table.txt)"

check_json() { # FILE EXPRESSION
    python3 -c 'import json, sys; r = json.load(open(sys.argv[1])); sys.exit(not eval(sys.argv[2]))' "$1" "$2" ||
        fail "$2 does not hold in $(cat "$1")"
}
"$COSEG" score --truth truth --labels labels --json meshes/square.off meshes/strip.off >score.json
check_json score.json 'abs(r["one_to_one"] - 91.6667) < 1e-3 and r["shapes"] == 2 and r["missing"] == []'
check_json score.json 'abs(r["per_shape"]["strip"] - 83.3333) < 1e-3 and r["clusters"] == 2 and r["labels"] == 2'
# areas 2/3 + 1/6 together against 1/6: of ordered pairs 2 * 2/3 * 1/6 + 2 * 1/6 * 1/6 differ
check_json score.json 'abs(r["per_shape_rand_index"]["strip"] - (1 - 2/9 - 1/18)) < 1e-3'

# the same on two ranks, printed once
if command -v mpirun >/dev/null; then
    mpirun -n 2 "$COSEG" score --truth truth --labels labels --json meshes >two.json
    "$COSEG" score --truth truth --labels labels --json meshes >one.json
    cmp one.json two.json || fail "two ranks print something else"
fi

# a shape without labels counts as 0 and is named; a mesh without truth is left out and named
cp meshes/square.off meshes/other.off
rm labels/strip.seg
"$COSEG" score --truth truth --labels labels --json meshes >missing.json
check_json missing.json 'r["one_to_one"] == 50 and r["missing"] == ["strip"] and r["meshes_without_truth"] == ["other"]'
"$COSEG" score --truth truth --labels labels --json meshes/square.off >part.json
check_json part.json 'r["one_to_one"] == 100 and r["shapes"] == 1 and r["truth_without_mesh"] == ["strip"]'
rm meshes/other.off

expect_error() { # CODE PIECE-OF-THE-SENTENCE ARGUMENTS...
    local code=$1 piece=$2 status=0
    shift 2
    timeout 60 "$COSEG" score "$@" >out.txt 2>err.txt || status=$?
    [[ $status == "$code" ]] || fail "exit code $status instead of $code for: $* ($(cat err.txt))"
    grep -qF -- "$piece" err.txt || fail "no '$piece' in: $(cat err.txt)"
    [[ ! -s out.txt ]] || fail "something on standard output for: $* ($(cat out.txt))"
}
expect_error 3 "'nowhere' is not a folder" --truth nowhere --labels labels meshes
expect_error 3 "'nowhere' is not a folder" --truth truth --labels nowhere meshes
mkdir empty
expect_error 3 "no mesh has its truth in 'empty'" --truth empty --labels labels meshes
expect_error 3 "no mesh has its labels in 'empty'" --truth truth --labels empty meshes
expect_error 3 "nowhere.off" --truth truth --labels labels nowhere.off
printf '7\n7\n5\n5\n' >labels/strip.seg
expect_error 3 "4 labels, but the mesh has 3 faces" --truth truth --labels labels meshes
grep -q labels/strip.seg err.txt || fail "the file is not named: $(cat err.txt)"
printf '7\nseven\n5\n' >labels/strip.seg
expect_error 3 "labels/strip.seg" --truth truth --labels labels meshes
grep -q 2 err.txt || fail "the line is not named: $(cat err.txt)"
printf '7\n7\n5\n' >labels/strip.seg
printf '0\n' >truth/square.seg
expect_error 3 "1 labels, but the mesh has 2 faces" --truth truth --labels labels meshes
expect_error 2 "--truth" --labels labels meshes
expect_error 2 "--no-such-option" --truth truth --labels labels --no-such-option meshes
echo "score: figures and errors as expected"
