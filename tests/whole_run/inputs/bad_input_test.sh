#!/usr/bin/env bash
# Each kind of bad input ends all ranks with one sentence and its exit code, and leaves no folder behind.
# shellcheck disable=SC2016  # $ in the scripts of sed is its last line
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/good" "$work/empty" "$work/one"
peanut "$work/good/a.off" 0.5
peanut "$work/good/b.off" 0.6
peanut "$work/good/c.off" 0.7
peanut "$work/one/x.off" 0.5

parts=2
run() { ranks "$1" "$COSEG" run --quiet --no-sheet --no-html --parts "$parts" --patches 10 --geodesic-samples 40 --out "$work/result" "${@:2}"; }

refuses "empty folder" 3 "$work/empty" run 2 "$work/empty"
refuses "missing folder" 3 "$work/nowhere" run 4 "$work/nowhere"
refuses "unknown extension" 3 "notes.txt" run 1 "$work/notes.txt"
mkdir "$work/twice"
cp "$work/good/a.off" "$work/twice/x.off"
refuses "two files of one name" 3 "x.off" run 2 "$work/one" "$work/twice"

# broken NAME SED_SCRIPT WORDS : one bad mesh among good ones is fatal under --strict and set aside without.
broken() {
    mkdir -p "$work/$1"
    cp "$work/good/a.off" "$work/good/b.off" "$work/$1/"
    sed "$2" "$work/good/c.off" >"$work/$1/bad.off"
    refuses "$1 (--strict, 4 ranks)" 3 "$3" run 4 --strict "$work/$1"
    [[ ! -e $work/result ]] || fail "$1: a refused run left a result"
    run 2 "$work/$1" 2>"$work/err" || { cat "$work/err" >&2; fail "$1: the good meshes were not segmented"; }
    grep -q -F "set aside" "$work/err" || fail "$1: no warning"
    grep -q -F "bad.off" "$work/result/report.json" || fail "$1: not in the report"
    [[ $(ls "$work/result/labels") == $'a.seg\nb.seg' ]] || fail "$1: labels of the good meshes are missing"
    rm -r "$work/result"
    echo "ok: $1 set aside"
}
broken truncated_header '2,$d' "bad.off"
broken truncated_body '500,$d' "bad.off"
broken index_out_of_range '$s/.*/3 0 1 99999/' "99999"
broken not_a_number '3s/.*/nan 0 0/' "bad.off"
broken infinite '3s/.*/inf 0 0/' "bad.off"
broken zero_faces '2s/.*/554 0 0/;557,$d' "bad.off"
broken zero_area '3,556s/.*/0 0 0/' "bad.off"

# What circulates is read, with one warning where something is left out; what is no mesh costs only itself.
mkdir "$work/mixed"
cp "$work/good/a.off" "$work/mixed/"
{ cat "$work/good/b.off" && echo '<!DOCTYPE FilterScript>' && echo '<FilterScript>'; } >"$work/mixed/b.off"
awk 'NR == 1 { print "NCOFF"; next } NR > 2 && NF == 3 { print $0, 255, 0, 0, 255, 0, 0, 1; next } { print }' \
    "$work/good/c.off" >"$work/mixed/c.off"
ln -s nowhere.off "$work/mixed/dangling.off"
ln -s loop.ply "$work/mixed/loop.ply"
mkdir "$work/mixed/folder.off"
mkfifo "$work/mixed/pipe.stl"
printf 'version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n' >"$work/mixed/pointer.obj"
printf '\xef\xbb\xbf%s\r\n' "$work/mixed" >"$work/mixed.txt"
PETSC_OPTIONS="-eps_ncv 3 -no_such_option -log_view nonsense:" run 2 @/dev/stdin <"$work/mixed.txt" 2>"$work/err" \
    || { cat "$work/err" >&2; fail "a mixed folder was not segmented"; }
for words in "dangling.off: is a link to nowhere.off" "folder.off: is a folder" "loop.ply: is a link that leads back" \
    "pipe.stl: is a pipe" "pointer.obj: the file is a Git LFS pointer" "b.off:1661: the file goes on after the 1104 faces"; do
    [[ $(grep -c -F "$words" "$work/err") -eq 1 ]] || { cat "$work/err" >&2; fail "a mixed folder: no '$words'"; }
done
mv "$work/result" "$work/result_mixed"
run 2 "$work/good"
cmp <(cat "$work"/result/labels/*.seg) <(cat "$work"/result_mixed/labels/*.seg) || fail "a mixed folder gives other labels"
rm -r "$work/result" "$work/result_mixed"
COSEG_RANKS=2 "$COSEG" run --quiet --parts 2 --patches 10 --geodesic-samples 40 --out "$work/result" @<(echo "$work/good") \
    || fail "a list from a pipe of the shell"
[[ $(ls "$work/result/labels") == $'a.seg\nb.seg\nc.seg' ]] || fail "a list from a pipe of the shell is not read whole"
rm -r "$work/result"
run 2 @<(echo "$work/good") || fail "a list from a pipe that mpirun was given"
[[ $(ls "$work/result/labels") == $'a.seg\nb.seg\nc.seg' ]] || fail "a list from a pipe that mpirun was given is not read whole"
rm -r "$work/result"
refuses "a bad entry of a folder (--strict)" 3 "dangling.off: is a link to nowhere.off" run 2 --strict "$work/mixed"
echo "ok: mixed folder"

mkdir "$work/all_bad"
head -n 2 "$work/good/a.off" >"$work/all_bad/a.off"
refuses "no usable mesh" 3 "a.off" run 2 "$work/all_bad"
parts=900
refuses "more parts than patches" 3 "--parts 900" run 2 "$work/good"
parts=2
refuses "unknown option" 2 "--no-such-option" run 2 --no-such-option 1 "$work/good"
refuses "value out of range" 2 "--alpha" run 2 --alpha -1 "$work/good"
refuses "value that is not a number" 2 "--gap" run 2 --gap nan "$work/good"
refuses "negative seed" 2 "--seed" run 2 --seed -1 "$work/good"
refuses "seed beyond 64 bits" 2 "is more than 18446744073709551615" run 2 --seed 18446744073709551616 "$work/good"
refuses "no feature" 2 "--feature-weights" run 2 --feature-weights=0,0,0,0,0 "$work/good"
refuses "no set of words" 2 "--word-sets" run 2 --word-sets 0 "$work/good"
refuses "balance beyond its range" 2 "--mesh-balance" run 2 --mesh-balance 1.5 "$work/good"
refuses "balance of the paper's cut" 2 "--mesh-balance" run 2 --preset paper --mesh-balance 0.3 "$work/good"
refuses "value that the eigensolver refuses" 2 "abc" run 2 "$work/good" -- -eps_tol abc
refuses "unknown PETSc prefix" 2 "-no_such_option" run 2 "$work/good" -- -no_such_option 1
refuses "misspelt PETSc option" 2 "-eps_ncw" run 2 "$work/good" -- -eps_ncw 3
[[ ! -e $work/result ]] || fail "a refused run left a result"

for scope in rows meshes; do
    refuses "gap not reached, scope $scope" 5 "was not reached" run 2 --scope $scope --max-iterations 2 --gap 1e-12 "$work/good"
    [[ $(ls "$work/result/labels") == $'a.seg\nb.seg\nc.seg' ]] || fail "gap not reached, scope $scope: the results are not kept"
    rm -r "$work/result"
done

mkdir "$work/result"
echo mine >"$work/result/notes.txt"
refuses "folder that is not empty" 4 "--force" run 2 "$work/good"
run 2 --force "$work/good"
[[ $(<"$work/result/notes.txt") == mine ]] || fail "--force touched a file that is not ours"
rm -r "$work/result"

run 2 "$work/one" 2>"$work/err"
grep -q -F "one mesh alone" "$work/err" || fail "a single mesh is not warned of"
[[ $(wc -l <"$work/result/labels/x.seg") -eq 1104 ]] || fail "a single mesh is not labelled"
rm -r "$work/result"
echo "ok: single mesh"

parts=1
run 2 "$work/good"
[[ $(sort -u "$work"/result/labels/*.seg) == 0 ]] || fail "one part is not part 0"
rm -r "$work/result"
parts=2
echo "ok: one part"

mkdir "$work/ply"
cp "$work/good/a.off" "$work/ply/"
refuses "meshes in the folder of results" 4 "ply/a.off" \
    "$COSEG" run --quiet --parts 2 --out "$work" --force "$work/ply"
[[ -f $work/ply/a.off ]] || fail "a mesh is gone"

# A rank that is killed and a run that is told to end: over at once. A process that is told to end leaves nothing; the
# others of a killed rank have a second before mpirun kills them too, and what then stays goes with the next run.
mkdir "$work/none"
"$COSEG" generate table --count 3 --faces 20000 --out "$work/long" >"$work/out"
wait_for_end_of() { # FOLDER : no process of ours writes to it any more
    for ((k = 0; k < 300; ++k)); do
        pgrep -f -- "--out $1 " >"$work/out" || return 0
        sleep 0.1
    done
    fail "a process still runs: $(<"$work/out")"
}
ended() { # WHAT SIGNAL : the signal goes to the last rank's process (KILL) or to a lone one
    local what=$1 signal=$2 pid victim start=$SECONDS
    if [[ $signal == KILL ]]; then
        OMPI_MCA_odls_base_sigkill_timeout=1 mpirun --oversubscribe -n 3 "$COSEG" run --quiet --parts 2 --out "$work/ended" "$work/long/meshes" 2>"$work/err" &
    else
        "$COSEG" run --quiet --parts 2 --out "$work/ended" "$work/long/meshes" 2>"$work/err" &
    fi
    pid=$!
    for ((k = 0; k < 300; ++k)); do
        compgen -G "$work/ended.partial-*" >"$work/out" && break
        sleep 0.1
    done
    [[ -s $work/out ]] || fail "$what: did not start"
    victim=$pid
    if [[ $signal == KILL ]]; then victim=$(pgrep -P "$pid" | sort -n | tail -n 1); fi
    kill -s "$signal" "$victim"
    if wait "$pid"; then fail "$what: success"; fi
    ((SECONDS - start < 60)) || fail "$what: took $((SECONDS - start)) s"
    [[ ! -e $work/ended ]] || fail "$what: there is a folder of results"
    if [[ $signal == KILL ]]; then
        wait_for_end_of "$work/ended"
        refuses "$what, and the next run" 3 "$work/none" "$COSEG" run --quiet --parts 2 --out "$work/ended" "$work/none"
    fi
    if compgen -G "$work/ended*"; then fail "$what: something is left"; fi
    echo "ok: $what"
}
ended "SIGTERM" TERM
ended "SIGHUP" HUP
ended "a rank is killed" KILL
