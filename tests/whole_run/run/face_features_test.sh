#!/usr/bin/env bash
# --face-features: what users give for every face is one more feature, and what is wrong with it is said in a sentence.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 5 "$work/set"
mkdir "$work/truth" "$work/noise" "$work/vectors" "$work/new"
# NumPy files as numpy.save writes them: the parts of the truth, noise, and both of them as vectors.
python3 - "$work" <<'END'
import glob, os, random, struct, sys
work = sys.argv[1]
def save(path, rows):
    shape = "(%d,)" % len(rows) if len(rows[0]) == 1 else "(%d, %d)" % (len(rows), len(rows[0]))
    header = "{'descr': '<f4', 'fortran_order': False, 'shape': %s, }" % shape
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        for row in rows:
            file.write(struct.pack("<%df" % len(row), *row))
for path in glob.glob(work + "/set/truth/*.seg"):
    name = os.path.basename(path)[:-4]
    noise = random.Random(name)
    parts = [int(line) for line in open(path) if line.strip()]
    save(work + "/truth/" + name + ".npy", [(p,) for p in parts])
    save(work + "/noise/" + name + ".npy", [(noise.random(),) for _ in parts])
    save(work + "/vectors/" + name + ".npy", [(p == 0, p == 1, p == 2) for p in parts])
END
common=(--quiet --no-html --no-sheet --parts 2 --patches 20 --geodesic-samples 100 --oversegmentations 3)
run=("$COSEG" run "${common[@]}")
accuracy() {
    "$COSEG" score --json --truth "$work/set/truth" --labels "$work/$1/labels" "$work/set/meshes" |
        python3 -c 'import json, sys; print(json.load(sys.stdin)["one_to_one"])'
}
above() { python3 -c 'import sys; sys.exit(not float(sys.argv[1]) > float(sys.argv[2]))' "$1" "$2"; }

"${run[@]}" --out "$work/plain" "$work/set/meshes"
"${run[@]}" --face-features "$work/noise" --face-feature-weight 0.2 --out "$work/noisy" "$work/set/meshes"
only=(--feature-weights "0,0,0,0,0")
"${run[@]}" "${only[@]}" --face-features "$work/truth" --out "$work/told" "$work/set/meshes"
"${run[@]}" "${only[@]}" --face-features "$work/vectors" --state "$work/state" --out "$work/words" "$work/set/meshes"
plain=$(accuracy plain) noisy=$(accuracy noisy) told=$(accuracy told) words=$(accuracy words)
echo "accuracy: without $plain, noise beside the five $noisy, the truth alone as numbers $told, as vectors $words"
above "$noisy" "$(python3 -c 'import sys; print(float(sys.argv[1]) - 3)' "$plain")" || fail "noise changes the labels much"
if ! above "$told" 97 || ! above "$words" 97; then fail "the truth as a feature does not give its labels"; fi
python3 - "$work" <<'END' || fail "the report of face features"
import json, sys
told, noisy = (json.load(open(sys.argv[1] + "/" + run + "/report.json")) for run in ("told", "noisy"))
assert [row["feature"] for row in told["features"]["strengths"]] == ["face_features"], told["features"]
assert len(noisy["features"]["strengths"]) == 6
assert told["options"]["face-features"].endswith("/truth") and told["options"]["face-feature-weight"] in (1, "1")
END

# Other numbers for the same meshes: descriptions are kept, but nothing that depends on the numbers.
"${run[@]}" "${only[@]}" --face-features "$work/truth" --state "$work/state" --out "$work/again" "$work/set/meshes"
diff -r "$work/again/labels" "$work/told/labels" || fail "labels with a state folder that other features made"
ranks 2 "${run[@]}" "${only[@]}" --face-features "$work/vectors" --out "$work/ranks2" "$work/set/meshes"
diff -r "$work/words/labels" "$work/ranks2/labels" || fail "labels on 1 and on 2 ranks"

cp "$work"/set/meshes/table_0000.off "$work/new"
assign=("$COSEG" assign --quiet --no-html --no-sheet)
"${assign[@]}" --to "$work/words" --face-features "$work/vectors" --out "$work/assigned" "$work/new"
[[ -f $work/assigned/labels/table_0000.seg ]] || fail "coseg assign with face features"
refuses "assign without them" 2 "the run was made with it" "${assign[@]}" --to "$work/words" --out "$work/x" "$work/new"
refuses "assign with them only" 2 "the run was made without it" \
    "${assign[@]}" --to "$work/plain" --face-features "$work/vectors" --out "$work/x" "$work/new"
refuses "assign with others" 3 " a face, but the run was made with" \
    "${assign[@]}" --to "$work/words" --face-features "$work/truth" --out "$work/x" "$work/new"

refuses "describe" 2 "give it to coseg run" "$COSEG" describe --state "$work/state" --face-features "$work/truth" "$work/set/meshes"
refuses "seven weights" 2 "there are only 6 descriptors" "${run[@]}" --feature-weights 1,1,1,1,1,1,1 --out "$work/x" "$work/set/meshes"
mkdir "$work/bad"
bad=("${run[@]}" --face-features "$work/bad" --out "$work/x" "$work/set/meshes")
refuses "no file" 3 "every mesh needs one of them" "${bad[@]}"
cp "$work"/truth/* "$work/bad"
cp "$work/vectors/table_0003.npy" "$work/bad"
refuses "other dimensions" 3 "3 numbers a face for table_0003 but 1 for table_0000" "${bad[@]}"
head -c 200 "$work/truth/table_0003.npy" >"$work/bad/table_0003.npy"
refuses "a file cut short" 3 "bad/table_0003.npy: holds" ranks 2 "${bad[@]}"
echo nothing >"$work/bad/table_0003.npy"
refuses "no NumPy file" 3 "is no NumPy file" "${bad[@]}"

# The sixth descriptor is computed where it has a weight, and not otherwise.
"${run[@]}" --feature-weights 1,0.5,1,2,1,1 --state "$work/waves" --out "$work/wave" "$work/set/meshes"
ranks 2 "${run[@]}" --feature-weights 1,0.5,1,2,1,1 --out "$work/wave2" "$work/set/meshes"
diff -r "$work/wave/labels" "$work/wave2/labels" || fail "labels with wave kernel signatures on 1 and on 2 ranks"
"${run[@]}" --feature-weights 1,0.5,1,2,1 --out "$work/five" "$work/set/meshes"
diff -r "$work/five/labels" "$work/plain/labels" || fail "five weights are not what they were"
"$COSEG" render "$work/wave" --what wave_kernel_signature --out "$work/picture" >/dev/null
[[ -s $work/picture/contact_sheet_wave_kernel_signature.png ]] || fail "picture of the sixth descriptor"
echo "ok: face features"
