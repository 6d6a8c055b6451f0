#!/usr/bin/env bash
# Meshes of any name that a file system takes, and meshes that vanish while the run is at work: nothing is lost.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

longest=$(printf 'x%.0s' {1..251})
names=("$longest" $'caf\xe9' $'new\nline' 'quotes"and\backslash' ' blank ' 'größe' "${longest:0:232}")
mkdir "$work/set"
for k in "${!names[@]}"; do peanut "$work/set/${names[k]}.off" "0.$((50 + k))"; done
quick=(--quiet --parts 2 --patches 10 --geodesic-samples 40 --oversegmentations 3)

ranks 2 "$COSEG" run "${quick[@]}" --out "$work/run" "$work/set"
ranks 2 "$COSEG" assign --quiet --to "$work/run" --out "$work/assigned" "$work/set"
for folder in run assigned; do
    for name in "${names[@]}"; do
        [[ $(wc -l <"$work/$folder/labels/$name.seg") -eq 1104 ]] || fail "$folder: no labels of '$name'"
        [[ -s "$work/$folder/ply/$name.ply" ]] || fail "$folder: no coloured mesh of '$name'"
    done
    python3 - "$work/$folder/report.json" "${names[@]}" <<'END' || fail "$folder: report.json"
import json, os, sys
meshes = json.load(open(sys.argv[1], encoding="utf-8"))["meshes"]
names = [bytes.fromhex(m["name_bytes"]) if "name_bytes" in m else m["name"].encode() for m in meshes]
assert sorted(names) == sorted(os.fsencode(name) for name in sys.argv[2:]), names
END
done
[[ -s $work/run/report.html ]] || echo "no page: this coseg was built without its libraries"
"$COSEG" render "$work/run" --out "$work/sheet" >"$work/out"
cmp "$work/run/contact_sheet.png" "$work/sheet/contact_sheet.png" || fail "render draws another sheet"
"$COSEG" export "$work/run" --to obj --out "$work/obj" >"$work/out"
[[ -s "$work/obj/obj/$longest.obj" && -s "$work/obj/obj/"$'caf\xe9.obj' ]] || fail "export leaves a mesh out"
echo "ok: names of any bytes"

# The features are written when all meshes have been read: then the files go.
rm -r "$work/run"
mkdir "$work/going"
for k in 1 2 3; do peanut "$work/going/m$k.off" "0.$k"; done
ranks 2 "$COSEG" run "${quick[@]}" --keep-features --out "$work/kept" "$work/going"
ranks 2 "$COSEG" run "${quick[@]}" --keep-features --out "$work/run" "$work/going" &
pid=$!
for ((k = 0; k < 1000; ++k)); do
    compgen -G "$work/run.partial-*/features.h5*" >"$work/out" && break
    sleep 0.01
done
rm "$work/going/m1.off"
echo "OFF" >"$work/going/m2.off"
wait "$pid" || fail "a mesh that vanished or changed ended the run"
for file in labels/m1.seg labels/m2.seg ply/m1.ply; do
    cmp "$work/kept/$file" "$work/run/$file" || fail "$file is another where meshes vanished"
done
[[ ! -e $work/kept/report.html || -s $work/run/report.html ]] || fail "the page is lost"
echo "ok: meshes that vanish"

# The shares of report.json are those of the label files, also where a part of the refined mesh has no face of the file.
mkdir "$work/shares"
for k in 4 5 6; do peanut "$work/shares/p$k.off" "0.$k"; done
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >"$work/shares/t.off"
ranks 2 "$COSEG" run --quiet --parts 3 --patches 10 --geodesic-samples 40 --oversegmentations 3 --out "$work/shared" "$work/shares" 2>"$work/err"
python3 - "$work/shared" <<'END' || fail "shares of parts without a face"
import json, sys
meshes = json.load(open(sys.argv[1] + "/report.json"))["meshes"]
assert len(meshes) == 4
for mesh in meshes:
    labels = {int(line) for line in open(f"{sys.argv[1]}/labels/{mesh['name']}.seg")}
    assert {part for part, share in enumerate(mesh["part_area"]) if share > 0} == labels, mesh["name"]
    assert abs(sum(mesh["part_area"]) - 1) < 1e-9
END
echo "ok: shares"

# What cannot be written is found before the meshes are read, here a mesh that could never be.
mkdir -p "$work/blocked/labels/m3.seg"
mkfifo "$work/going/m4.off"
refuses "a folder in the way" 4 "labels/m3.seg: is a folder where a result" \
    ranks 2 "$COSEG" run "${quick[@]}" --force --out "$work/blocked" "$work/going"
