#!/usr/bin/env bash
# Help: fits a screen, says what was probably meant, and makes the manual page and completion that work; the forms of the log.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

"$COSEG" run --help >"$work/help"
[[ $(wc -l <"$work/help") -le 50 ]] || fail "coseg run --help has $(wc -l <"$work/help") lines"
grep -q -- "--parts" "$work/help" || fail "--help without --parts"
if grep -q -- "--lambda" "$work/help"; then fail "--help shows what few need"; fi
"$COSEG" run --help-all >"$work/help"
grep -q -- "--lambda" "$work/help" || fail "--help-all without --lambda"
echo "ok: --help and --help-all"

refuses "a misspelt option" 2 "did you mean --parts?" "$COSEG" run --prts 3 --out "$work/x" "$work"
refuses "a misspelt command" 2 "did you mean render?" "$COSEG" rendr
refuses "a misspelt family" 2 "did you mean 'goblet'?" "$COSEG" generate gobelt --out "$work/x"
refuses "an option like none" 2 "--wavelength is not an option of coseg run" "$COSEG" run --wavelength 3

"$COSEG" man >"$work/coseg.1"
for word in 'coseg run' 'coseg render' 'feature\\-weights' 'EXIT STATUS'; do
    grep -q -- "$word" "$work/coseg.1" || fail "the manual page does not name $word"
done
if command -v groff >/dev/null; then
    [[ -z $(groff -man -Tascii -ww -W break "$work/coseg.1" 2>&1 >/dev/null) ]] || fail "groff complains of the manual page"
fi
"$COSEG" completion >"$work/completion"
complete_line() { # WORD... : what bash offers for the last word
    bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _coseg; printf "%s\n" "${COMPREPLY[@]}"' \
        bash "$work/completion" "$@"
}
[[ $(complete_line coseg rend) == render ]] || fail "completion of commands"
[[ $(complete_line coseg run --lam) == --lambda ]] || fail "completion of options"
[[ $(complete_line coseg generate gob) == goblet ]] || fail "completion of families"
echo "ok: manual page and completion"

"$COSEG" generate table --count 2 --faces 2000 --out "$work/set" >"$work/out"
quick=(--patches 10 --oversegmentations 1 --geodesic-samples 20 --no-choose --parts 2 --force --no-html --out "$work/r" "$work/set/meshes")
"$COSEG" run --json-log "${quick[@]}" 2>"$work/log"
python3 - "$work/log" <<'END' || fail "--json-log"
import json, sys
events = [json.loads(line) for line in open(sys.argv[1])]
stages = [e["stage"] for e in events if e["event"] == "stage"]
assert stages == ["describe", "features", "optimise", "align", "cut", "label", "write", "picture"], stages
assert events[0]["steps"]["geodesics"] >= 0
END
"$COSEG" run --verbose "${quick[@]}" 2>"$work/log"
grep -q "^  geodesics" "$work/log" || fail "--verbose without steps"
"$COSEG" run --quiet "${quick[@]}" 2>"$work/log"
[[ ! -s $work/log ]] || fail "--quiet is not quiet: $(cat "$work/log")"
"$COSEG" run "${quick[@]}" 2>"$work/log"
[[ $(wc -l <"$work/log") -eq 8 ]] || fail "a log has not one line a stage: $(cat "$work/log")"
if script -qec true /dev/null >"$work/out" 2>&1 </dev/null; then # containers may lack pseudo-terminals
    script -qec "'$COSEG' run --ranks 1 ${quick[*]}" /dev/null >"$work/log" </dev/null
    grep -q "describe.*%.*s left" "$work/log" || fail "no share done and time left on a terminal"
fi
echo "ok: forms of the log"

"$COSEG_SOURCE/jobs/quickstart.sh" --help >"$work/quickstart" || fail "quickstart.sh --help"
grep -q "fresh clone" "$work/quickstart" || fail "quickstart.sh --help says nothing"
for script in "$COSEG_SOURCE"/jobs/*.sbatch; do
    if env -u COSEG_HOME -u SLURM_SUBMIT_DIR bash "$script" 2>"$work/error"; then fail "$script outside a job"; fi
    grep -q "give this file to sbatch" "$work/error" || fail "$script outside a job says: $(cat "$work/error")"
    if COSEG_HOME=$work bash "$script" 2>"$work/error"; then fail "$script with another folder"; fi
    grep -q "$work/jobs/in_allocation.sh" "$work/error" || fail "$script with another folder says: $(cat "$work/error")"
done
echo "ok: job scripts where they cannot work"
