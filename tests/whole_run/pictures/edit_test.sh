#!/usr/bin/env bash
# coseg edit: a person's acts by HTTP and in a browser; the labels of its corrections come again without it.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

here=$(dirname "${BASH_SOURCE[0]}")
tables 4 "$work/set"
options=(--parts 2 --patches 20 --geodesic-samples 100 --oversegmentations 3)
"$COSEG" run --quiet --no-html --no-sheet --levels "${options[@]}" --state "$work/state" --out "$work/run" "$work/set/meshes"
"$COSEG" report "$work/run" >/dev/null 2>&1 || { echo "skipped: built without three.js and Chart.js"; exit 77; }

cp -r "$work/run" "$work/run2"
cp -r "$work/run" "$work/run3"
python3 "$here/edit_client.py" "$COSEG" "$work/run"
python3 "$here/edit_client.py" "$COSEG" "$work/run2" 2
cmp "$work/run/corrections.json" "$work/run2/corrections.json" || fail "the same acts on 1 and on 2 ranks"
ranks 3 "$COSEG" run --quiet --no-html --no-sheet "${options[@]}" --corrections "$work/run/corrections.json" --out "$work/again" "$work/set/meshes"
diff -r "$work/run/corrected" "$work/again/labels" || fail "coseg run --corrections does not give the labels of the session"

# Another mesh in the place of one is named, whichever shapes have other labels for it.
cp -r "$work/set/meshes" "$work/kept_meshes"
cp "$work/set/meshes/table_0003.off" "$work/set/meshes/table_0001.off"
refuses "another mesh" 3 "table_0001.off: is not the mesh that the run was made of" "$COSEG" edit --quiet "$work/run3"
cp "$work/kept_meshes/table_0001.off" "$work/set/meshes/"
refuses "an option that nobody asks for" 2 "unused PETSc option: -ksp_rtol" "$COSEG" edit --quiet "$work/run3" -- -ksp_rtol 1e-5

status=0
python3 "$here/edit_in_browser.py" "$COSEG" "$work/run3" || status=$?
[[ $status == 0 || $status == 77 ]] || fail "the page in a browser"

# A disk that fills up during a session and one that is read-only, where this machine lets us mount one.
disk=$work/disk
mkdir "$disk"
if mount -t tmpfs -o size=100m tmpfs "$disk" 2>/dev/null; then
    trap 'umount --lazy "$disk" 2>/dev/null || true; rm -rf "$work"' EXIT
    cp -r "$work/run3" "$disk/run"
    rm -f "$disk/run/corrections.json" "$disk/run/.corrections.lock"
    python3 "$here/edit_full_disk.py" "$COSEG" "$disk/run" || fail "a disk that fills up"
    rm -f "$disk/run/.corrections.lock"
    mount -o remount,ro "$disk"
    refuses "a read-only run" 4 "cannot be written (Read-only file system), so nothing that you say could be kept" "$COSEG" edit --quiet "$disk/run"
    umount "$disk"
    echo "ok: a full disk and a read-only one"
else
    echo "note: no right to mount a tmpfs here: full and read-only disks are not tried"
fi

# What is no run, what has changed, what cannot be written.
"$COSEG" run --quiet --no-html --no-sheet --parts 1 --patches 20 --geodesic-samples 40 --out "$work/whole" "$work/set/meshes"
refuses "a run without parts to correct" 3 "which corrections do not follow" "$COSEG" edit --quiet "$work/whole"
"$COSEG" assign --quiet --no-html --no-sheet --to "$work/whole" --out "$work/assigned" "$work/set/meshes"
refuses "assigned shapes" 3 "was made by coseg assign" "$COSEG" edit --quiet "$work/assigned"
refuses "no run" 3 "holds no report.json" "$COSEG" edit "$work/set"
cp "$work/again/corrections.json" "$work/kept.json"
sed -i 's/"run": "./"run": "x/' "$work/run/corrections.json"
refuses "corrections of another run" 3 "is about another run" "$COSEG" edit --quiet "$work/run"
rm "$work/run/corrections.json"
sed -i '1s/.*/9/' "$work/run/labels/table_0001.seg"
refuses "labels of another program" 3 "run coseg run again" "$COSEG" edit --quiet "$work/run"
rm -r "$work/set/meshes"
refuses "meshes that are gone" 3 "the mesh is no longer there" "$COSEG" edit --quiet "$work/run2"
