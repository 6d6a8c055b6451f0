#!/usr/bin/env bash
# --state: what is kept is used again, to the byte; ended and killed runs continue, on other numbers of ranks too; damage is
# found, named and repaired; one run at a time; a folder that cannot be written ends the run with a message.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

state=$work/state
options=(--quiet --no-sheet --no-html --geodesic-samples 100 --oversegmentations 3)
tables 8 "$work/set"
mkdir "$work/seven"
cp "$work"/set/meshes/*[0-6].off "$work/seven/"

# run RANKS NAME OPTION... : a run with the state folder, into the folder NAME.
run() {
    local count=$1 name=$2
    shift 2
    ranks "$count" "$COSEG" run "${options[@]}" "$@" --state "$state" --out "$work/$name" 2>"$work/err" ||
        { cat "$work/err" >&2; fail "$name: ended with $?"; }
}
same() {
    diff -r "$work/plain/labels" "$work/$1/labels" >/dev/null || fail "$1: other labels than without state"
    diff -r "$work/plain/patches" "$work/$1/patches" >/dev/null || fail "$1: other patches than without state"
}
# same_history NAME... : the optimiser's history is that of a run that was never interrupted.
same_history() {
    python3 - "$@" <<'END' || fail "another history of the optimiser"
import json, sys
first, *others = [json.load(open(name))["optimisation"] for name in sys.argv[1:]]
assert len(first["history"]) > 1 and first["history"][-1]["relative_gap"] == first["relative_gap"]
assert all(other["history"] == first["history"] for other in others)
END
}
# reported NAME KEY VALUE : what the report says of the state.
reported() {
    python3 -c 'import json, sys; s = json.load(open(sys.argv[1]))["state"]; sys.exit(s[sys.argv[2]] != int(sys.argv[3]))' \
        "$work/$1/report.json" "$2" "$3" || { grep -A6 '"state"' "$work/$1/report.json" >&2; fail "$1: $2 is not $3"; }
}

ranks 2 "$COSEG" run "${options[@]}" --parts 2 --patches 20 --out "$work/plain" "$work/seven"
run 2 first --parts 2 --patches 20 "$work/seven"
same first && reported first meshes_described 7
run 3 second --parts 2 --patches 20 "$work/seven"
same second && same_history "$work"/{plain,first,second}/report.json && reported second meshes_described 0 && reported second meshes_reused 7 && reported second tiles_solved 0 && reported second cuts_reused 1
echo "ok: a second run describes and solves nothing"

run 2 other_parts --parts 3 --patches 20 --lambda 90 "$work/seven"
reported other_parts meshes_described 0
run 2 one_more --parts 2 --patches 20 "$work/set/meshes"
reported one_more meshes_described 1 && reported one_more meshes_reused 7
run 1 other_patches --parts 2 --patches 21 "$work/seven"
reported other_patches meshes_described 7
echo "ok: what changed is computed, no more"

# Damage: one description, one cut short, one run of tiles, all cuts.
mapfile -t kept < <(find "$state/meshes" -name '*.h5' -printf '%T@ %p\n' | sort | cut -d' ' -f2 | head -n 7)
printf 'X' | dd of="${kept[0]}" bs=1 seek=5000 conv=notrunc status=none
truncate -s 1000 "${kept[1]}"
tiles=$(find "$state/solver" -name 'tiles-*.h5' -printf '%T@ %p\n' | sort | cut -d' ' -f2 | head -n 1)
printf 'X' | dd of="$tiles" bs=1 seek=3000 conv=notrunc status=none
mapfile -t cuts < <(find "$state/cuts" -name '*.h5')
for cut in "${cuts[@]}"; do printf 'X' | dd of="$cut" bs=1 seek=2500 conv=notrunc status=none; done
refuses "damage is found" 3 "$((3 + ${#cuts[@]})) damaged" ranks 2 "$COSEG" state verify "$state"
run 2 repaired --parts 2 --patches 20 "$work/seven"
same repaired && reported repaired meshes_described 2
for file in "${kept[0]}" "${kept[1]}" "$tiles"; do
    grep -q "warning: $file: is damaged.*set aside as $state/damaged/" "$work/err" || { cat "$work/err" >&2; fail "$file is not named"; }
done
grep -q "warning: $state/cuts/.*: is damaged.*and the cut is made anew" "$work/err" || { cat "$work/err" >&2; fail "the cut is not named"; }
rm -f "${cuts[@]}"
ranks 2 "$COSEG" state verify "$state" >"$work/out" || fail "verify after the repair"
echo "ok: damaged files are named, set aside and made anew"

"$COSEG" state list "$state" >"$work/out"
grep -q 'mesh table' "$work/out" || fail "list does not name a mesh"
if command -v h5dump >/dev/null; then
    h5dump -A "${kept[2]}" >"$work/out" || fail "h5dump cannot read a description"
    grep -q '"coseg mesh description"' "$work/out" || fail "h5dump cannot read a description"
fi
if python3 -c 'import h5py' 2>/dev/null; then
    python3 - "${kept[2]}" <<'END' || fail "h5py cannot read a description"
import h5py, sys
with h5py.File(sys.argv[1]) as file:
    faces = len(file["faces/area"])
    assert abs(sum(file["faces/area"]) - 1) < 1e-9 and file["descriptors/shape_context"].shape[0] == faces
    assert file.attrs["patches"] == 20 and file["patches/0"].shape == (faces,)
END
fi
echo "ok: list, h5dump and h5py read what is kept"

# A lock: somebody else has the folder.
flock --no-fork --exclusive "$state/lock" sleep 60 &
holder=$!
until ! flock --nonblock "$state/lock" true; do sleep 0.05; done
refuses "two runs at once" 4 "the state folder is in use" \
    ranks 2 "$COSEG" run "${options[@]}" --parts 2 --state "$state" --out "$work/refused" "$work/seven"
kill "$holder"
wait "$holder" 2>/dev/null || true
refuses "a folder of other things" 4 "is no state folder" \
    ranks 2 "$COSEG" run "${options[@]}" --parts 2 --state "$work/set" --out "$work/refused" "$work/seven"

# ends_on SIGNAL CODE : a run that is sent SIGNAL as soon as the first description is kept ends with CODE, and its state is used.
slow=(--quiet --no-sheet --no-html --parts 2 --patches 20 --geodesic-samples 400 --oversegmentations 3)
"$COSEG" run --ranks 1 "${slow[@]}" --out "$work/slow" "$work/seven"
ends_on() {
    local signal=$1 code=$2 status=0 folder=$work/state.$1
    mpirun --oversubscribe -n 2 "$COSEG" run "${slow[@]}" --state "$folder" --out "$work/ended" "$work/seven" 2>"$work/err" &
    local run=$!
    until compgen -G "$folder/meshes/*/*.h5" >/dev/null; do
        kill -0 "$run" 2>/dev/null || { cat "$work/err" >&2; fail "$signal: the run ended by itself"; }
        sleep 0.02
    done
    if [[ $signal == RANK ]]; then
        pkill -KILL --parent "$run" --oldest coseg
    else
        kill "-$signal" "$run"
    fi
    wait "$run" || status=$?
    [[ $code == any && $status -ne 0 || $status -eq $code ]] || { cat "$work/err" >&2; fail "$signal: exit code $status, not $code"; }
    if [[ $code == 75 ]]; then grep -q "the same command continues" "$work/err" || fail "$signal: does not say how to go on"; fi
    [[ ! -e $work/ended ]] || fail "$signal: half a result"
    timeout --signal=KILL 100 mpirun --oversubscribe -n 3 "$COSEG" run "${slow[@]}" --state "$folder" --out "$work/resumed.$signal" "$work/seven"
    diff -r "$work/slow/labels" "$work/resumed.$signal/labels" >/dev/null || fail "$signal: other labels after the restart"
    python3 -c 'import json, sys; sys.exit(json.load(open(sys.argv[1]))["state"]["meshes_reused"] == 0)' \
        "$work/resumed.$signal/report.json" || fail "$signal: nothing was kept"
    same_history "$work"/{slow,"resumed.$signal"}/report.json
    echo "ok: $signal"
}
ends_on USR1 75
# A run that has started its ranks by itself asks them likewise, as mpirun would only end them.
"$COSEG" run --ranks 2 "${slow[@]}" --state "$work/state.own" --out "$work/ended" "$work/seven" 2>"$work/err" &
own=$!
until compgen -G "$work/state.own/meshes/*/*.h5" >/dev/null; do
    kill -0 "$own" 2>/dev/null || { cat "$work/err" >&2; fail "the run ended by itself"; }
    sleep 0.02
done
kill -TERM "$own"
status=0
wait "$own" || status=$?
[[ $status -eq 75 ]] || { cat "$work/err" >&2; fail "TERM to a run that has started its ranks: exit code $status, not 75"; }
grep -q "the same command continues" "$work/err" || fail "TERM: does not say how to go on"
refuses "a state in the folder of results" 2 "lies in the output folder" "$COSEG" run "${slow[@]}" --state "$work/new/state" --out "$work/new" "$work/seven"
ends_on RANK any
rm -rf "$work"/ended.partial-* # a killed run's: the next one into the same folder would have removed it

"$COSEG" state prune "$state" --unused-days 30 >"$work/out"
"$COSEG" state list "$state" >"$work/listed"
grep -q "set aside or left behind" "$work/listed" && fail "prune leaves what was set aside"
[[ $(grep -c 'mesh table' "$work/listed") -eq 15 ]] || { cat "$work/listed" >&2; fail "prune removes what is young"; }
"$COSEG" state prune "$state" --unused-days 0 >"$work/out"
[[ -z $(find "$state" -name '*.h5') ]] || fail "prune leaves files"
echo "ok: prune"

# A full disk and a read-only one, where this machine lets us mount them.
small=$work/small
mkdir "$small"
if mount -t tmpfs -o size=400k tmpfs "$small" 2>/dev/null; then
    trap 'umount --lazy "$small" 2>/dev/null || true; rm -rf "$work"' EXIT
    refuses "a full disk" 4 "No space left on device" \
        ranks 2 "$COSEG" run "${options[@]}" --parts 2 --state "$small/state" --out "$work/refused" "$work/seven"
    "$COSEG" state verify "$small/state" >"$work/out" || fail "a full disk leaves a damaged file"
    mount -o remount,ro "$small"
    refuses "a read-only folder" 4 "cannot be written (Read-only file system)" \
        ranks 2 "$COSEG" run "${options[@]}" --parts 2 --state "$small/state" --out "$work/refused" "$work/seven"
    # Room for the descriptions, none for what comes after them: the optimiser's progress, in both forms.
    for scope in meshes rows; do
        mount -o remount,rw,size=100m "$small"
        rm -rf "$small/state"
        ranks 1 "$COSEG" describe --quiet --geodesic-samples 100 --oversegmentations 3 --patches 20 --state "$small/state" "$work/seven"
        mount -o "remount,size=$(($(du --block-size=1k --summarize "$small" | cut -f1) + 4))k" "$small"
        refuses "a disk full after the descriptions, scope $scope" 4 "No space left on device" ranks 2 "$COSEG" run "${options[@]}" --parts 2 \
            --patches 20 --scope "$scope" --checkpoint-seconds 0 --state "$small/state" --out "$work/refused" "$work/seven"
        ranks 2 "$COSEG" state verify "$small/state" >"$work/out" || fail "a full disk leaves a damaged file"
        mount -o remount,size=100m "$small"
        ranks 2 "$COSEG" run "${options[@]}" --parts 2 --patches 20 --scope "$scope" --state "$small/state" --out "$work/room.$scope" "$work/seven"
        ranks 1 "$COSEG" run "${options[@]}" --parts 2 --patches 20 --scope "$scope" --out "$work/plain.$scope" "$work/seven"
        diff -r "$work/plain.$scope/labels" "$work/room.$scope/labels" >/dev/null || fail "other labels after a full disk, scope $scope"
    done
    echo "ok: with room again the same command continues"
else
    echo "note: no right to mount a tmpfs here: full and read-only disks are not tried"
fi
