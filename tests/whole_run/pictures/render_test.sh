#!/usr/bin/env bash
# Contact sheets: written by a run, the same bytes on any number of ranks and by `coseg render`, of every kind, in pages.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 5 "$work/set"
quick=(--quiet --patches 20 --oversegmentations 1 --geodesic-samples 40 --no-choose --parts 2)
for count in 1 3; do
    ranks "$count" "$COSEG" run "${quick[@]}" --out "$work/r$count" "$work/set/meshes"
done
cmp "$work/r1/contact_sheet.png" "$work/r3/contact_sheet.png" || fail "the sheet depends on the ranks"
cmp "$work/r1/affinity.png" "$work/r3/affinity.png" || fail "the affinity's picture depends on the ranks"
echo "ok: the same sheet on 1 and 3 ranks"

kinds=parts,patches,truth,errors,gaussian_curvature,shape_diameter,average_geodesic,shape_context,conformal_factor
ranks 2 "$COSEG" render "$work/r1" --what "$kinds" --truth "$work/set/truth" --out "$work/sheets" >"$work/out"
[[ $(wc -l <"$work/out") -eq 9 ]] || fail "render names $(wc -l <"$work/out") files, not 9"
"$COSEG" render "$work/r1" --out "$work/plain" >"$work/out"
cmp "$work/r1/contact_sheet.png" "$work/plain/contact_sheet.png" || fail "render draws another sheet than the run"
python3 - "$work/sheets" <<'END' || fail "kinds of sheets"
import glob, struct, sys, zlib
pictures = {}
for path in glob.glob(sys.argv[1] + "/*.png"):
    data = open(path, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    width, height = struct.unpack(">II", data[16:24])
    assert width > 1000 and height > 700, (path, width, height)
    pictures[path] = zlib.crc32(data)
assert len(set(pictures.values())) == 9, "two kinds give the same picture"
END
echo "ok: nine kinds"

# Names change the legend and nothing below it: those beside the truth are taken, the same given by --names give the same bytes.
sheets_of() { # sheets_of OUT ARGUMENT... : the sheets of parts and truth
    ranks 2 "$COSEG" render "$work/r1" --what parts,truth --out "$work/$1" "${@:2}" >"$work/out"
}
cp -r "$work/set/truth" "$work/unnamed" && rm "$work/unnamed/labels.txt"
awk '{ $1 = ""; print }' "$work/set/truth/labels.txt" >"$work/names.txt"
sheets_of nameless --truth "$work/unnamed"
sheets_of named --truth "$work/unnamed" --names "$work/names.txt"
for file in contact_sheet.png contact_sheet_truth.png; do
    cmp "$work/named/$file" "$work/sheets/$file" || fail "--names draws another $file than labels.txt beside the truth"
    cmp --quiet "$work/named/$file" "$work/nameless/$file" && fail "$file has no names"
done
cmp "$work/nameless/contact_sheet.png" "$work/r1/contact_sheet.png" || fail "the truth changes a sheet of parts without names"
"$COSEG" render "$work/r1" --names "$work/names.txt" --out "$work/named" >"$work/out"
cmp --quiet "$work/named/contact_sheet.png" "$work/r1/contact_sheet.png" && fail "names of parts without truth are not drawn"
echo "ok: names"
printf '0 top\n0 leg\n' >"$work/twice.txt"
refuses "a label named twice" 3 "twice.txt:2: label 0 has a name already" ranks 2 "$COSEG" render "$work/r1" --names "$work/twice.txt"
refuses "names that are gone" 3 "gone.txt" "$COSEG" render "$work/r1" --names "$work/gone.txt"

for number in $(seq 10 72); do cp "$work/set/meshes/table_0000.off" "$work/set/meshes/t_$number.off"; done
python3 - "$work" <<'END'
import json, os, shutil, sys
work = sys.argv[1]
report = json.load(open(f"{work}/r1/report.json"))
report["meshes"] = []
os.makedirs(f"{work}/many/labels"), os.makedirs(f"{work}/many/patches")
for number in range(10, 73):
    name = f"t_{number}"
    report["meshes"].append({"name": name, "path": f"{work}/gone/{name}.off", "part_area": [0.5, 0.5]})
    for kind in ("labels", "patches"):
        shutil.copy(f"{work}/r1/{kind}/table_0000.seg", f"{work}/many/{kind}/{name}.seg")
json.dump(report, open(f"{work}/many/report.json", "w"))
END
refuses "meshes that are gone" 3 "say where with --meshes" "$COSEG" render "$work/many"
ranks 2 "$COSEG" render "$work/many" --meshes "$work/set/meshes" --view front --up z >"$work/out"
[[ $(cd "$work/many" && ls -- *.png sheets) == $'contact_sheet.png\n\nsheets:\nparts_1.png\nparts_2.png' ]] ||
    fail "pages: $(cd "$work/many" && ls -- *.png sheets)"
echo "ok: two pages and an index"

refuses "unknown view" 2 "'above' is not a view" "$COSEG" render "$work/r1" --view above
refuses "unknown kind" 2 "patchs" "$COSEG" render "$work/r1" --what patchs
refuses "truth without its folder" 2 "--truth" "$COSEG" render "$work/r1" --what truth
refuses "a folder without a run" 3 "report.json" "$COSEG" render "$work/set"
"$COSEG" run "${quick[@]}" --no-sheet --force --out "$work/r1" "$work/set/meshes/table_0001.off"
[[ ! -e $work/r1/contact_sheet.png && ! -e $work/r1/affinity.png ]] || fail "an earlier run's sheet stays"
echo "ok: --no-sheet"
