#!/usr/bin/env bash
# A run that is started without mpirun: on all cores, or on as many ranks as asked for, with the same bytes.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"
unset COSEG_RANKS

mkdir "$work/set"
for waist in 0.4 0.5 0.6; do peanut "$work/set/waist_$waist.off" "$waist"; done
common=(--quiet --no-sheet --no-html --patches 10 --geodesic-samples 40 --parts 2)

# expects RANKS DIR : the report says so, and the bytes are those of one rank.
expects() {
    python3 - "$1" "$2/report.json" <<'END' || fail "$2: not on $1 ranks"
import json, sys
assert json.load(open(sys.argv[2]))["ranks"] == int(sys.argv[1])
END
    diff -r "$work/one/labels" "$2/labels" || fail "$2: other labels"
}

"$COSEG" run "${common[@]}" --ranks 1 --out "$work/one" "$work/set"
expects 1 "$work/one"
"$COSEG" run "${common[@]}" --out "$work/all" "$work/set"
expects "$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)" "$work/all"
"$COSEG" run "${common[@]}" --ranks=3 --out "$work/three" "$work/set" -- -eps_ncv 40
expects 3 "$work/three"
COSEG_RANKS=2 "$COSEG" run "${common[@]}" --out "$work/two" "$work/set"
expects 2 "$work/two"
COSEG_RANKS=3 "$COSEG" run "${common[@]}" --ranks 0 --out "$work/cores" "$work/set"
expects "$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)" "$work/cores"
echo "ranks = 2" > "$work/ranks.toml"
"$COSEG" run "${common[@]}" --config "$work/ranks.toml" --out "$work/file" "$work/set"
expects 2 "$work/file"
ranks 2 "$COSEG" run "${common[@]}" --ranks 4 --out "$work/mpirun" "$work/set"
expects 2 "$work/mpirun"

# Commands that give up or answer at once do so before MPI starts, which could not start here.
for words in "run --bogus" "run --parts many" "run --ranks 2 --config $work/none.toml" "rum"; do
    # shellcheck disable=SC2086  # several words
    refuses "a mistake before MPI: $words" 2 "coseg: " env OMPI_MCA_pml=none "$COSEG" $words
done
OMPI_MCA_pml=none "$COSEG" run --help >"$work/help"
grep -q -- "--parts" "$work/help" || fail "help before MPI"

# One process makes no folder of a session: others that end would remove it from under one that starts.
touch "$work/no_folder"
OMPI_MCA_orte_tmpdir_base="$work/no_folder" "$COSEG" check "$work/set" > "$work/checked" ||
    fail "a process alone needs a folder of a session"
for process in 1 2 3 4; do
    (for time in 1 2 3 4 5; do "$COSEG" check "$work/set" > "$work/checked_$process" 2>&1 || echo "$time" >> "$work/failed"; done) &
done
wait
[ ! -e "$work/failed" ] || fail "one of processes that start side by side: $(cat "$work"/checked_?)"

env -i LD_LIBRARY_PATH="${LD_LIBRARY_PATH-}" COSEG_RANKS=2 "$COSEG" run "${common[@]}" --out "$work/bare" "$work/set"
expects 2 "$work/bare"

# Who ends the process ends its ranks, and it says by what it was ended.
for signal in TERM INT; do
    env -u OMPI_MCA_odls_base_sigkill_timeout --default-signal=INT "$COSEG" run --quiet --parts 2 --ranks 2 --out "$work/ended_$signal" "$work/set" 2>"$work/err" &
    process=$!
    until compgen -G "$work/ended_$signal.partial-*" >/dev/null || ! kill -0 "$process" 2>/dev/null; do sleep 0.05; done
    kill -s "$signal" "$process"
    status=0
    wait "$process" || status=$?
    # An interrupt is left to the terminal's other processes for three seconds, within which the run may end.
    [[ $status -eq $((128 + $(kill -l "$signal"))) || ($signal == INT && $status -eq 0) ]] || { cat "$work/err" >&2; fail "exit code $status after SIG$signal"; }
    if compgen -G "$work/ended_$signal.partial-*" >/dev/null; then fail "SIG$signal leaves a partial folder"; fi
done

refuses "a number of ranks that is none" 2 "--ranks" "$COSEG" run "${common[@]}" --ranks many --out "$work/x" "$work/set"
refuses "a negative number of ranks" 2 "--ranks" "$COSEG" run "${common[@]}" --ranks -2 --out "$work/x" "$work/set"
refuses "an error on all cores" 3 "no such file" "$COSEG" run "${common[@]}" --ranks 2 --out "$work/x" "$work/none"
echo "ok: a run without mpirun"
