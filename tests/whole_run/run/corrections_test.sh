#!/usr/bin/env bash
# --corrections and --constraints: what is said holds to the face, the same bytes come on any number of ranks, and what
# cannot be meant is said in a sentence.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 4 "$work/set"
run=("$COSEG" run --quiet --no-html --no-sheet --parts 2 --patches 20 --geodesic-samples 100 --oversegmentations 3 --state "$work/state")
"${run[@]}" --levels --out "$work/base" "$work/set/meshes"

# A file with no act gives the labels of the run, and tells by its hash which run that is.
echo '{"format": "coseg corrections", "version": 1, "run": "0", "acts": []}' >"$work/none.json"
refuses "another run" 3 "is about another run" "${run[@]}" --corrections "$work/none.json" --out "$work/no" "$work/set/meshes"
hash_of() {
    "${run[@]}" --constraints "$1" --out "$work/hash" --force "$work/set/meshes"
    python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["run"])' "$work/hash/corrections.json"
}
echo "name,0,legs" >"$work/name.csv"
hash=$(hash_of "$work/name.csv")
diff -r "$work/base/labels" "$work/hash/labels" || fail "a name changes labels"

# write NAME ACT... : a file of corrections with these acts.
write() {
    local name=$1 acts
    shift
    acts=$(printf ',%s' "$@")
    echo "{\"format\": \"coseg corrections\", \"version\": 1, \"run\": \"$hash\", \"acts\": [${acts:1}]}" >"$work/$name.json"
}
corrected() { "${run[@]}" --corrections "$work/$1.json" --out "$work/$1" --force "$work/set/meshes"; }

# Merges, splits and levels.
write merged '{"act": "merge", "part": 1, "into": 0}'
corrected merged
[[ $(sort -u "$work"/merged/labels/*.seg) == 0 ]] || fail "a merge leaves the part"
write level '{"act": "level", "parts": 3}'
corrected level
[[ $(sort -u "$work"/level/labels/*.seg | tr '\n' ' ') == "0 1 2 " ]] || fail "a level of three parts"
write split '{"act": "split", "part": 1}'
corrected split
python3 - "$work" <<'END' || fail "a split moves faces of other parts"
import os, sys
work, moved = sys.argv[1], 0
for name in os.listdir(work + "/base/labels"):
    before, after = (open(f"{work}/{run}/labels/{name}").read().split() for run in ("base", "split"))
    assert len(before) == len(after)
    moved += sum(a == "2" for a in after)
    other = sum(a != b and not (a == "1" and b == "2") for a, b in zip(before, after))
    assert other < 0.03 * len(before), (name, other)
assert moved > 0
END

# What is said of faces holds to the face; a part that is absent has none; links hold.
write said '{"act": "new-part"}' '{"act": "label", "part": 2, "shape": "table_0001", "faces": "0-40,60"}' \
    '{"act": "absent", "part": 1, "shape": "table_0002"}' \
    '{"act": "must-link", "first": {"shape": "table_0001", "face": 3}, "second": {"shape": "table_0003", "face": 7}}' \
    '{"act": "cannot-link", "first": {"shape": "table_0001", "patch": 19}, "second": {"shape": "table_0000", "face": 7}}'
corrected said
python3 - "$work" <<'END' || fail "what is said does not hold"
import os, sys
work = sys.argv[1]
labels = {n[:-4]: open(f"{work}/said/labels/{n}").read().split() for n in os.listdir(work + "/said/labels")}
patches = {n[:-4]: open(f"{work}/said/patches/{n}").read().split() for n in os.listdir(work + "/said/labels")}
assert all(labels["table_0001"][f] == "2" for f in list(range(41)) + [60])
assert "1" not in labels["table_0002"], "an absent part"
assert labels["table_0001"][3] == labels["table_0003"][7], "must-link"
other = labels["table_0000"][7]
of_patch = [l for f, (l, p) in enumerate(zip(labels["table_0001"], patches["table_0001"])) if p == "19" and not (f <= 40 or f == 60)]
assert of_patch and other not in of_patch, ("cannot-link", other, set(of_patch))
END
ranks 3 "$COSEG" run --quiet --no-html --no-sheet --parts 2 --patches 20 --geodesic-samples 100 --oversegmentations 3 --corrections "$work/said.json" \
    --out "$work/ranks3" "$work/set/meshes"
diff -r "$work/said/labels" "$work/ranks3/labels" || fail "labels on 1 and on 3 ranks"
# The folder of results carries the corrections on.
cmp "$work/said/corrections.json" "$work/ranks3/corrections.json" || fail "corrections in the results"
"${run[@]}" --corrections "$work/said/corrections.json" --out "$work/again" "$work/set/meshes"
diff -r "$work/said/labels" "$work/again/labels" || fail "the corrections that the results carry"

# Names of examples and of acts come to the results, and levels that no run writes are named.
mkdir "$work/examples"
cp "$work/said/labels/table_0001.seg" "$work/examples/"
sed -i 's/2/1/' "$work/examples/table_0001.seg"
printf '0 seat\n1 leg\n' >"$work/examples/names.txt"
printf 'name,1,foot\nabsent,0,table_0000\n' >"$work/named.csv"
"${run[@]}" --examples "$work/examples" --levels --constraints "$work/named.csv" --out "$work/named" "$work/set/meshes" 2>"$work/err"
[[ $(cat "$work/named/names.txt") == $'0 seat\n1 foot' ]] || fail "names.txt: $(cat "$work/named/names.txt")"
grep -q "no levels are written" "$work/err" || fail "levels are left out without a word"

# Constraints alone, as CSV and as JSON.
printf '# links\nmust-link, table_0001, 0, table_0002, 5\ncannot-link,table_0001,0,table_0003,9\nabsent,0,table_0000\n' >"$work/c.csv"
# Parts that were not chosen by the features are corrected all the same.
"${run[@]}" --no-choose --constraints "$work/c.csv" --out "$work/unchosen" "$work/set/meshes"
ranks 2 "${run[@]}" --no-choose --corrections "$work/unchosen/corrections.json" --out "$work/unchosen2" "$work/set/meshes"
diff -r "$work/unchosen/labels" "$work/unchosen2/labels" || fail "corrections of parts that were not chosen"
cat >"$work/c.json" <<'END'
{"format": "coseg constraints", "version": 1, "constraints": [
 {"act": "must-link", "first": {"shape": "table_0001", "face": 0}, "second": {"shape": "table_0002", "face": 5}},
 {"act": "cannot-link", "first": {"shape": "table_0001", "face": 0}, "second": {"shape": "table_0003", "face": 9}},
 {"act": "absent", "part": 0, "shape": "table_0000"}]}
END
"${run[@]}" --constraints "$work/c.csv" --out "$work/csv" "$work/set/meshes"
"${run[@]}" --constraints "$work/c.json" --out "$work/json" "$work/set/meshes"
diff -r "$work/csv/labels" "$work/json/labels" || fail "CSV and JSON differ"
line() { sed -n "$2p" "$work/csv/labels/$1.seg"; }
[[ $(line table_0001 1) == "$(line table_0002 6)" && $(line table_0001 1) != "$(line table_0003 10)" ]] || fail "links of faces"
[[ $(sort -u "$work/csv/labels/table_0000.seg") == 1 ]] || fail "a part is there that is absent"

# What cannot be meant: the code, and a part of the sentence.
refused() {
    refuses "$1" "$2" "$3" "${run[@]}" --corrections "$work/bad.json" --out "$work/no" "$work/set/meshes"
    [[ ! -e $work/no ]] || fail "results are left"
}
bad() {
    local code=$1 sentence=$2
    shift 2
    write bad "$@"
    refused "$sentence" "$code" "$sentence"
}
bad 3 "act 1: there is no part 7; parts are 0 to 1" '{"act": "merge", "part": 7, "into": 0}'
bad 3 "act 2: part 1 was merged into another one" '{"act": "merge", "part": 1, "into": 0}' '{"act": "split", "part": 1}'
bad 3 "no shape 'tabel_0001' is segmented" '{"act": "absent", "part": 0, "shape": "tabel_0001"}'
bad 3 "has no face 999999" '{"act": "label", "part": 0, "shape": "table_0001", "faces": "999999"}'
bad 3 "has 3 labels, but table_0001 has" '{"act": "confirm", "shape": "table_0001", "labels": "0*3"}'
bad 3 "act 1: '4-2' is no number or range" '{"act": "label", "part": 0, "shape": "table_0001", "faces": "4-2"}'
bad 3 "'lable' is no act; did you mean label?" '{"act": "lable"}'
bad 3 "\"part\" is missing" '{"act": "split"}'
bad 3 "\"into\" must be a whole number" '{"act": "merge", "part": 1, "into": "0"}'
bad 3 "\"weight\" is no member" '{"act": "split", "part": 0, "weight": 2}'
bad 3 "part 0 does not fall in two" '{"act": "split", "part": 0}'
bad 3 "the finest level has" '{"act": "level", "parts": 999}'
bad 3 "before anything else is said" '{"act": "name", "part": 0, "name": "legs"}' '{"act": "level", "parts": 3}'
# Contradictions name both acts.
link() { echo "{\"act\": \"$1\", \"first\": {\"shape\": \"table_0001\", \"face\": $2}, \"second\": {\"shape\": \"table_0002\", \"face\": $3}}"; }
bad 3 "act 2 (cannot-link face 0 of table_0001 and face 5 of table_0002) and $work/bad.json, act 1 (must-link face 0 of table_0001 and face 5 of table_0002) contradict each other" \
    "$(link must-link 0 5)" "$(link cannot-link 0 5)"
bad 3 "act 1 (label part 0 in table_0001) and $work/bad.json, act 2 (label part 1 in table_0002) contradict each other" \
    '{"act": "label", "part": 0, "shape": "table_0001", "faces": "0"}' \
    '{"act": "label", "part": 1, "shape": "table_0002", "faces": "5"}' "$(link must-link 0 5)"
bad 3 "act 1 (label part 0 in table_0001) and $work/bad.json, act 2 (part 0 absent in table_0001) contradict each other" \
    '{"act": "label", "part": 0, "shape": "table_0001", "faces": "0"}' '{"act": "absent", "part": 0, "shape": "table_0001"}'
bad 3 "table_0001 has no part left" '{"act": "absent", "part": 0, "shape": "table_0001"}' '{"act": "absent", "part": 1, "shape": "table_0001"}'
bad 3 "too few parts" "$(link cannot-link 0 5)" "$(link cannot-link 9 5)" \
    '{"act": "cannot-link", "first": {"shape": "table_0001", "face": 0}, "second": {"shape": "table_0001", "face": 9}}'
echo '{"format": "coseg corrections", "version": 1' >"$work/bad.json"
refused "cut off" 3 "is no JSON"
echo '{"format": "coseg report", "version": 1}' >"$work/bad.json"
refused "another format" 3 "is no file of corrections"
refuses "no file" 3 "nowhere.json" "${run[@]}" --corrections "$work/nowhere.json" --out "$work/no" "$work/set/meshes"
refuses "with segments" 2 "--corrections and --constraints need" "${run[@]}" --corrections "$work/said.json" --segments --out "$work/no" "$work/set/meshes"
for row in "must-link,table_0001,0,table_0002" "merge,0,1" "absent,x,table_0001" "must-link,table_0001,0,table_0001,0"; do
    echo "$row" >"$work/bad.csv"
    refuses "$row" 3 "bad.csv:1: " "${run[@]}" --constraints "$work/bad.csv" --out "$work/no" "$work/set/meshes"
done
