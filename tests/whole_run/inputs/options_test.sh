#!/usr/bin/env bash
# The command line: help, versions, configuration files, presets, PETSc options, input forms.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

for command in "" run score generate solve; do
    # shellcheck disable=SC2086
    "$COSEG" $command --help >"$work/help" || fail "coseg $command --help"
    grep -q -- "--help" "$work/help" || fail "coseg $command --help says nothing"
done
"$COSEG" --version >"$work/version"
for library in coseg MPI PETSc SLEPc Eigen Embree OpenMesh; do
    grep -q "^$library " "$work/version" || fail "--version does not name $library"
done
refuses "no subcommand" 2 "subcommand" "$COSEG"
refuses "unknown subcommand" 2 "segment" "$COSEG" segment

refuses "an option with an empty value" 2 "--out has an empty value" "$COSEG" run --parts 2 --out "" "$work"
refuses "an empty value behind =" 2 "--state has an empty value" "$COSEG" run --parts 2 --state= --out "$work/x" "$work"
refuses "a seed below 0" 2 "--seed" "$COSEG" generate table --count 1 --seed -1 --out "$work/x"
refuses "a seed beyond 64 bits" 2 "--seed" "$COSEG" solve --seed 99999999999999999999999999 "$work/x"
refuses "days that are no number" 2 "nan is not finite" "$COSEG" state prune "$work" --unused-days nan
for ranks in abc -1 100001; do
    refuses "COSEG_RANKS=$ranks" 2 "COSEG_RANKS: '$ranks' is no number of ranks" env COSEG_RANKS="$ranks" "$COSEG" run --parts 2 --out "$work/x" "$work"
done
refuses "too many ranks" 2 "--ranks" "$COSEG" run --parts 2 --ranks 100001 --out "$work/x" "$work"
refuses "a gap that no sum can reach" 2 "'0' is no number from 1e-12 to 1" "$COSEG" run --parts 2 --gap 0 --out "$work/x" "$work"

refuses "a number that is none" 2 "'+5' is no whole number" "$COSEG" generate table --count +5 --out "$work/x"
refuses "a number in another base" 2 "'0x10' is no whole number" "$COSEG" run --parts 2 --patches 0x10 --out "$work/x" "$work"
refuses "zeros before a number that is too small" 2 "a mesh needs at least 2" "$COSEG" solve --links 01 "$work/x"
mkdir "$work/dash"
touch "$work/dash/-meshes"
refuses "a path that looks like an option" 2 "'-meshes' begins with a dash like an option; write './-meshes'" \
    env --chdir="$work/dash" "$COSEG" check -meshes
refuses "results longer than a name" 4 "File name too long" "$COSEG" run --parts 2 --out "$work/$(printf 'n%.0s' {1..256})" "$work"

mkdir "$work/set"
peanut "$work/set/a.off" 0.5
peanut "$work/set/b.off" 0.6
peanut "$work/set/c.off" 0.7
common=(--quiet --no-sheet --no-html --patches 10 --geodesic-samples 40)

"$COSEG" describe --patches 10 --geodesic-samples 40 --json-log --state "$work/described" "$work/set" >"$work/log" 2>&1
printf 'levels = true\npatches = 12\n' >"$work/run.toml"
"$COSEG" describe --quiet --geodesic-samples 40 --config "$work/run.toml" --state "$work/described" "$work/set" ||
    fail "coseg describe takes no file of coseg run"
echo 'levls = true' >>"$work/run.toml"
refuses "a key of no command" 2 "--levls" "$COSEG" describe --config "$work/run.toml" --state "$work/described" "$work/set"
if grep -v '^{' "$work/log"; then fail "coseg describe --json-log prints other lines"; fi
mkdir -p "$work/earlier/labels"
yes 0 | head -n 1104 >"$work/earlier/labels/a.seg" || true
refuses "examples in the results" 4 "--examples $work/earlier/labels: lies in the folder labels/ of the results" \
    "$COSEG" run "${common[@]}" --parts 2 --examples "$work/earlier/labels" --force --out "$work/earlier" "$work/set"

"$COSEG" run "${common[@]}" --parts 2 --alpha 0.02 --preset paper --lambda 10 --out "$work/by_option" "$work/set"
printf 'parts = 2\nalpha = 0.02\npreset = "paper"\nlambda = 10\n' >"$work/run.toml"
"$COSEG" run "${common[@]}" --config "$work/run.toml" --out "$work/by_file" "$work/set"
diff -r "$work/by_option/labels" "$work/by_file/labels" || fail "a configuration file gives other labels"
python3 - "$work/by_option/report.json" "$work/by_file/report.json" <<'END' || fail "resolved options"
import json, sys
by_option, by_file = (json.load(open(path))["options"] for path in sys.argv[1:])
for options in (by_option, by_file):
    del options["out"], options["config"]
assert by_option == by_file, (by_option, by_file)
assert by_option["alpha"] == 0.02 and by_option["lambda"] == 10 and by_option["scope"] == "rows"
assert by_option["oversegmentations"] == 1 and by_option["adjacency"] == 0
assert by_option["drop-below"] == 1e-6 and by_option["cut-offset"] == 0.5
END
{ printf '\xef\xbb\xbf' && cat "$work/run.toml"; } >"$work/bom.toml"
{ printf '\xff\xfe' && iconv -t UTF-16LE "$work/run.toml"; } >"$work/utf16.toml"
for encoding in bom utf16; do
    "$COSEG" run "${common[@]}" --config "$work/$encoding.toml" --out "$work/$encoding" "$work/set"
    diff -r "$work/by_file/labels" "$work/$encoding/labels" || fail "a configuration file in another encoding: $encoding"
done
printf 'parts = 2\nno_such_key = 1\n' >"$work/wrong.toml"
refuses "unknown key in a file" 2 "no_such_key" "$COSEG" run "${common[@]}" --config "$work/wrong.toml" --out "$work/x" "$work/set"
printf '[solve]\nparts = 2\n' >"$work/section.toml"
refuses "section of another command" 2 "[solve]" "$COSEG" run "${common[@]}" --config "$work/section.toml" --out "$work/x" "$work/set"
printf 'parts =\n' >"$work/valueless.toml"
refuses "key without a value" 2 "'parts'" "$COSEG" run "${common[@]}" --config "$work/valueless.toml" --out "$work/x" "$work/set"
refuses "configuration file that is a folder" 2 "$work/set" \
    "$COSEG" run "${common[@]}" --config "$work/set" --parts 2 --out "$work/x" "$work/set"
refuses "output that cannot be written" 4 "standard output" bash -c "'$COSEG' generate list >/dev/full"
printf '[run]\nfeature-weights = [1, 0, 1, 0, 1]\ninput = ["%s"]\n' "$work/set" >"$work/weights.toml"
"$COSEG" run "${common[@]}" --config "$work/weights.toml" --parts 2 --out "$work/weights"
[[ -f $work/weights/report.json ]] || fail "inputs and weights in a file"
refuses "a weight too small to count" 3 "all zeros (or too small" \
    "$COSEG" run "${common[@]}" --feature-weights 1e-310 --parts 2 --out "$work/x" "$work/set"
refuses "configuration file that is missing" 2 "$work/none.toml" \
    "$COSEG" run "${common[@]}" --config "$work/none.toml" --parts 2 --out "$work/x" "$work/set"

common+=(--oversegmentations 3)
"$COSEG" run "${common[@]}" --parts 3 --no-choose --refine none --out "$work/voted" "$work/set"
"$COSEG" run "${common[@]}" --parts 3 --no-choose --refine fuzzy --out "$work/fuzzy" "$work/set"
diff -rq "$work/voted/labels" "$work/fuzzy/labels" >"$work/differences" && fail "--refine fuzzy moves nothing"
refuses "an unknown refinement" 2 "--refine" "$COSEG" run "${common[@]}" --parts 2 --refine maybe --out "$work/x" "$work/set"

refuses "results and state in one folder" 2 "--out and --state name the same folder" \
    "$COSEG" run "${common[@]}" --parts 2 --force --state "$work/both/" --out "$work/both" "$work/set"
"$COSEG" run "${common[@]}" --parts 02 --seed 010 --no-choose --state "$work/state" --out "$work/decimal" "$work/set"
grep -q '"seed": 10,' "$work/decimal/report.json" || fail "a zero before a number makes it octal"
(
    ulimit -S -s 64
    "$COSEG" run "${common[@]}" --parts 2 --seed 10 --no-choose --state "$work/state" --out "$work/small_stack" "$work/set"
) || fail "a stack of 64 KiB"
diff -r "$work/decimal/labels" "$work/small_stack/labels" || fail "a small stack gives other labels"

"$COSEG" run "${common[@]}" --parts 2 --scope rows --out "$work/rows" "$work/set"
"$COSEG" run "${common[@]}" --parts 2 --scope paper --out "$work/old_word" "$work/set"
diff -r "$work/rows/labels" "$work/old_word/labels" || fail "--scope paper is not --scope rows"
refuses "an offset beside a balance" 2 "--cut-offset" "$COSEG" run "${common[@]}" --parts 2 --cut-offset 0.5 --out "$work/x" "$work/set"

printf '# two of them\nset/a.off\n\nset/c.off\n' >"$work/list.txt"
"$COSEG" run "${common[@]}" --parts 2 --out "$work/listed" "@$work/list.txt"
[[ $(ls "$work/listed/labels") == $'a.seg\nc.seg' ]] || fail "a list of meshes"

"$COSEG" run "${common[@]}" --parts 2 --out "$work/petsc" "$work/set" -- -eps_ncv 40
[[ -f $work/petsc/report.json ]] || fail "options of PETSc"
refuses "folder below a file" 4 "$work/list.txt" "$COSEG" run "${common[@]}" --parts 2 --out "$work/list.txt/x" "$work/set"
echo "ok: options"
