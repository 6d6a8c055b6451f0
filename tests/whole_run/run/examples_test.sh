#!/usr/bin/env bash
# --examples: the labels of one shape become those of all, and what is wrong with an example is said in a sentence.
# --levels: one nested tree of parts. --parts auto: the number of parts is found, the rest is as if it had been given.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 5 "$work/set"
mkdir "$work/one" "$work/some" "$work/none" "$work/bad" "$work/others"
# The labels of one table, numbered the other way round; then the same for a third of its faces alone.
python3 - "$work" <<'END'
import glob, os, sys
work = sys.argv[1]
for path in sorted(glob.glob(work + "/set/truth/*.seg")):
    labels = [1 - int(line) for line in open(path) if line.strip()]
    name = os.path.basename(path)
    if name == "table_0002.seg":
        open(work + "/one/" + name, "w").write("".join(f"{label}\n" for label in labels))
        open(work + "/some/" + name, "w").write("".join(f"{label if f % 3 == 0 else -1}\n" for f, label in enumerate(labels)))
    open(work + "/others/" + name, "w").write("".join(f"{label}\n" for label in labels))
END
run=("$COSEG" run --quiet --no-html --no-sheet --patches 20 --geodesic-samples 100 --oversegmentations 3 --state "$work/state")
# Area with exactly the label of the example, in percent; no assignment of labels.
agreement() {
    python3 - "$work" "$1" <<'END'
import os, sys
work, run = sys.argv[1:]
same = total = 0
for name in os.listdir(work + "/others"):
    truth, labels = (open(f"{folder}/{name}").read().split() for folder in (work + "/others", f"{work}/{run}/labels"))
    assert len(truth) == len(labels), name
    same += sum(a == b for a, b in zip(truth, labels))
    total += len(truth)
print(100 * same / total)
END
}
above() { python3 -c 'import sys; sys.exit(not float(sys.argv[1]) > float(sys.argv[2]))' "$1" "$2"; }

"${run[@]}" --examples "$work/one" --out "$work/by_one" "$work/set/meshes"
cmp "$work/one/table_0002.seg" "$work/by_one/labels/table_0002.seg" || fail "the example does not keep its labels"
ranks 2 "${run[@]}" --examples "$work/some" --out "$work/by_some" "$work/set/meshes"
echo "faces with the label of the example: $(agreement by_one) %, of a third of its faces: $(agreement by_some) %"
above "$(agreement by_one)" 97 || fail "the others do not have the labels of the example"
above "$(agreement by_some)" 97 || fail "the others do not have the labels of some faces of the example"
python3 - "$work" <<'END' || fail "faces of which something is said lose it"
import sys
said, found = (open(f"{sys.argv[1]}/{path}/table_0002.seg").read().split() for path in ("some", "by_some/labels"))
assert all(a in ("-1", b) for a, b in zip(said, found))
END
ranks 2 "$COSEG" run --quiet --no-html --no-sheet --patches 20 --geodesic-samples 100 --oversegmentations 3 --examples "$work/one" \
    --out "$work/ranks2" "$work/set/meshes"
diff -r "$work/by_one/labels" "$work/ranks2/labels" || fail "labels with and without a state folder, on 1 and on 2 ranks"
# The confidence of a face whose label is given is 1, and the report has the mean of each shape.
python3 - "$work" <<'END' || fail "confidence in the PLY and in the report"
import json, sys
run = sys.argv[1] + "/by_one"
ply = open(run + "/ply/table_0002.ply", "rb").read()
assert b"property float confidence" in ply and ply.endswith(b"\0\0\x80\x3f")
means = {mesh["name"]: mesh["confidence"] for mesh in json.load(open(run + "/report.json"))["meshes"]}
assert abs(means["table_0002"] - 1) < 1e-6 and all(0.5 < mean < 1 + 1e-9 for mean in means.values()), means
END
# A label that no example shows is a part of its own, and is said. Names of the labels become those of the parts.
printf '1 top\n2 drawer\n' >"$work/one/names.txt"
"${run[@]}" --examples "$work/one" --parts 3 --out "$work/three" "$work/set/meshes" 2>"$work/log"
grep -q "no example shows label 2" "$work/log" || fail "a label without an example: $(cat "$work/log")"
grep -q "area ()" "$work/log" && fail "parts without a name: $(cat "$work/log")"
cmp "$work/one/names.txt" "$work/three/names.txt" || fail "the names of the labels"
rm "$work/one/names.txt"
# One label alone says nothing of how it differs from others: those come from the partition.
mkdir "$work/alone"
awk '{ print ($1 == 1 ? 1 : -1) }' "$work/one/table_0002.seg" >"$work/alone/table_0002.seg"
"${run[@]}" --examples "$work/alone" --parts 2 --out "$work/by_alone" "$work/set/meshes" 2>"$work/log"
above "$(agreement by_alone)" 97 || fail "an example of one label: $(agreement by_alone) %"

# Levels: one nested tree, whose level of K parts is the partition; an earlier run's levels go.
"${run[@]}" --parts 2 --levels --out "$work/levels" "$work/set/meshes"
diff -r "$work/levels/levels/2" "$work/levels/labels" || fail "the level of K parts is not that of the labels"
python3 - "$work/levels" <<'END' || fail "levels are not nested"
import json, os, sys
run = sys.argv[1]
unions = json.load(open(run + "/report.json"))["partition"]["unions"]
levels = sorted(map(int, os.listdir(run + "/levels")))
assert levels[0] == 2 and 4 < levels[-1] <= len(unions) + 2, levels
for count, finer in zip(levels, levels[1:]):
    parents, labels = {}, set()
    for name in os.listdir(run + "/labels"):
        coarse, fine = (open(f"{run}/levels/{level}/{name}").read().split() for level in (count, finer))
        for a, b in zip(coarse, fine):
            assert parents.setdefault(b, a) == a, (count, name)
            labels.add(int(a))
    assert labels == set(range(count)), (count, labels)
END
ranks 2 "${run[@]}" --parts 2 --levels --out "$work/levels2" "$work/set/meshes"
diff -r "$work/levels/levels" "$work/levels2/levels" || fail "levels on 1 and on 2 ranks"
"${run[@]}" --parts 2 --force --out "$work/levels2" "$work/set/meshes"
[[ ! -e $work/levels2/levels ]] || fail "levels of an earlier run are left"

# --parts auto: the labels are those of the number that was found, which the report and the log explain.
"$COSEG" run --no-html --no-sheet --patches 20 --geodesic-samples 100 --oversegmentations 3 --parts auto --levels --out "$work/auto" \
    "$work/set/meshes" >"$work/auto.log" 2>&1
found=$(python3 - "$work/auto" <<'END'
import json, sys
report = json.load(open(sys.argv[1] + "/report.json"))
count = report["partition"]["part_count"]
numbers = [row["parts"] for row in count["numbers"]]
merits = [row["merit"] for row in count["numbers"]]
assert sorted(numbers) == list(range(2, 13)) and merits == sorted(merits, reverse=True), count
assert numbers[0] == report["options"]["parts"] == len(report["partition"]["part_area"]), numbers
assert count["sentence"] in open(sys.argv[1] + ".log").read()
print(numbers[0])
END
) || fail "what the report and the log say of the number of parts"
[[ $found == 2 ]] || fail "tables have $found parts"
diff -r "$work/levels/labels" "$work/auto/labels" || fail "labels of a number that was found and of one that was given"
diff -r "$work/levels/levels" "$work/auto/levels" || fail "levels of a number that was found and of one that was given"
ranks 2 "${run[@]}" --parts auto --out "$work/auto2" "$work/set/meshes"
diff -r "$work/auto/labels" "$work/auto2/labels" || fail "--parts auto on 1 and on 2 ranks"
diff <(grep -A3 '"numbers"' "$work/auto/report.json") <(grep -A3 '"numbers"' "$work/auto2/report.json") ||
    fail "figures of the numbers of parts on 1 and on 2 ranks"
for parts in auto "$found"; do
    "${run[@]}" --parts "$parts" --force --out "$work/auto3" "$work/set/meshes"
    grep -q '"cuts_reused": 1' "$work/auto3/report.json" || fail "the cut of --parts auto is not kept for $parts"
done
"${run[@]}" --examples "$work/one" --parts auto --out "$work/auto_by_one" "$work/set/meshes"
diff -r "$work/by_one/labels" "$work/auto_by_one/labels" || fail "with examples the number of parts is that of their labels"

# What is wrong: the code, and a part of the sentence.
refused() {
    local code=$1 sentence=$2
    shift 2
    local got=0
    "${run[@]}" --out "$work/refused" "$@" "$work/set/meshes" 2>"$work/log" || got=$?
    [[ $got == "$code" ]] || fail "exit code $got instead of $code: $(cat "$work/log")"
    grep -q -- "$sentence" "$work/log" || fail "'$sentence' is not in: $(cat "$work/log")"
    [[ $(wc -l <"$work/log") == 1 && ! -e $work/refused ]] || fail "one sentence and nothing left: $(cat "$work/log")"
}
refused 2 "--parts is required"
refused 3 "no label file NAME.seg" --examples "$work/none"
refused 3 "No such file or directory" --examples "$work/nowhere"
refused 2 "--examples cannot be joined" --examples "$work/one" --parts 2 --segments
refused 2 "--levels needs two parts" --parts 1 --levels
refused 2 "--parts auto compares partitions" --parts auto --preset paper
refused 2 "--parts auto compares partitions" --parts auto --segments
refused 3 "which needs --parts 2 or more" --examples "$work/one" --parts 1
echo "2 drawer" >"$work/one/names.txt"
refused 3 "names.txt: label 2 has a name, but there are 2 parts" --examples "$work/one"
rm "$work/one/names.txt"
head -n 10 "$work/one/table_0002.seg" >"$work/bad/table_0002.seg"
refused 3 "table_0002.seg" --examples "$work/bad"
cp "$work/one/table_0002.seg" "$work/bad/table_0099.seg" && rm "$work/bad/table_0002.seg"
refused 3 "no shape of this name is segmented" --examples "$work/bad"
echo "-2" >"$work/bad/table_0099.seg"
refused 3 "has label -2; labels are 0, 1" --examples "$work/bad"
echo "-1" >"$work/bad/table_0099.seg"
refused 3 "no face has a label" --examples "$work/bad"
