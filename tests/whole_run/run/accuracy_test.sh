#!/usr/bin/env bash
# bench/accuracy.py: tables of labelled sets and of the Princeton layout, figures checked, resumed where it was ended.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

tables 6 "$work/made"
for set in 1 2; do
    mkdir -p "$work/data/tables_$set"
    for k in 1 2 3; do cp "$work/made"/*/table_000$((3 * set - 4 + k)).* "$work/data/tables_$set"; done
    cp "$work/made/truth/labels.txt" "$work/data/tables_$set"
done
quick="--patches 10 --geodesic-samples 40 --oversegmentations 1"
bench() {
    timeout 300 python3 "$COSEG_SOURCE/bench/accuracy.py" --coseg "$COSEG" --ranks 1 \
        --data "$work/data" --out "$work/figures.json" --table "$work/table.md" "$@"
}
both=(--presets "default $quick" "default $quick --refine none")
bench "${both[@]}" --seeds 1 >"$work/first"
[[ $(wc -l <"$work/first") -eq 4 ]] || fail "2 sets x 2 presets: $(cat "$work/first")"
grep -q "2 presets are compared" "$work/table.md" || fail "leaving a set out: $(cat "$work/table.md")"
bench "${both[@]:0:2}" --sets tables_1 --seeds 1 2 >"$work/second"
[[ $(wc -l <"$work/second") -eq 1 ]] || fail "runs are repeated: $(cat "$work/second")"
python3 - "$work" "$quick" <<'END' || fail "figures and table"
import json, statistics, sys
work, quick = sys.argv[1:]
figures = json.load(open(work + "/figures.json"))
table = open(work + "/table.md").read()
runs = figures["tables_1"]["runs"]["default " + quick]
assert figures["tables_1"]["parts"] == 2 and set(runs) == {"1", "2"}
for run in runs.values():
    s = run["score"]
    assert s["patch_bound"] >= s["one_to_one"] - 3 and s["many_to_one"] >= s["one_to_one"] and 0 < s["one_label"] < 100, s
one = [run["score"]["one_to_one"] for run in runs.values()]
assert f"{statistics.fmean(one):.1f} ± {statistics.stdev(one):.1f}" in table, table
END
# a figure of another program is measured again
python3 - "$work/figures.json" <<'END'
import json, sys
figures = json.load(open(sys.argv[1]))
runs = next(iter(figures["tables_1"]["runs"].values()))
runs["1"]["program"] = "another"
json.dump(figures, open(sys.argv[1], "w"))
END
bench "${both[@]:0:2}" --sets tables_1 --seeds 1 2 >"$work/third"
[[ $(wc -l <"$work/third") -eq 1 ]] || fail "resumed: $(cat "$work/third")"

# generated collections
bench --generated 2 table goblet --seeds 1 --presets "default $quick" --out "$work/made.json" --table "$work/made.md" >"$work/log"
grep -q "^| generated_goblet | 3 |" "$work/made.md" || fail "generated collections: $(cat "$work/made.md")"
bench --generated 2 table --turned --seeds 1 --presets "default $quick" --out "$work/turned.json" --table "$work/turned.md" >"$work/log"
grep -q "^| generated_table (turned) | 2 |" "$work/turned.md" || fail "turned collections: $(cat "$work/turned.md")"
refuses "an unknown family" 1 "no family spoon" bench --generated 2 spoon

# the Princeton layout: cups (21..40) whose annotators are the truth, and one who saw a single segment
"$COSEG" generate cup --count 2 --seed 1 --faces 2000 --out "$work/cups" >"$work/log"
mkdir -p "$work/princeton/off"
number=21
for mesh in "$work"/cups/meshes/*.off; do
    name=$(basename "$mesh" .off)
    cp "$mesh" "$work/princeton/off/$number.off"
    mkdir -p "$work/princeton/human seg/Benchmark/$number"
    cp "$work/cups/truth/$name.seg" "$work/princeton/human seg/Benchmark/$number/${number}_0.seg"
    sed 's/.*/0/' "$work/cups/truth/$name.seg" >"$work/princeton/human seg/Benchmark/$number/${number}_1.seg"
    number=$((number + 1))
done
timeout 300 python3 "$COSEG_SOURCE/bench/accuracy.py" --coseg "$COSEG" --ranks 1 --seeds 1 --presets "default $quick" \
    --out "$work/princeton.json" --table "$work/princeton.md" --data "$work/princeton" >"$work/log"
grep -q "^| princeton_cup | 2 |" "$work/princeton.md" || fail "the Princeton table: $(cat "$work/princeton.md")"

# the truth against itself and against the single segment
mkdir "$work/truth"
for number in 21 22; do cp "$work/princeton/human seg/Benchmark/$number/${number}_0.seg" "$work/truth/$number.seg"; done
"$COSEG" score --annotators "$work/princeton/human seg/Benchmark" --labels "$work/truth" "$work/princeton/off" >"$work/score.json"
python3 - "$work/score.json" <<'END' || fail "measures of the truth: $(cat "$work/score.json")"
import json, sys
s = json.load(open(sys.argv[1]))
assert s["shapes"] == 2 and s["annotations"] == 4 and s["cut_discrepancy"] == 0, s
assert 0 < s["missing_rate"] < 0.5 and s["false_alarm_rate"] == 0 and s["local_consistency_error"] < 1e-6, s
END
refuses "no annotators" 3 "no mesh has an annotator" "$COSEG" score --annotators "$work/data" --labels "$work/truth" "$work/princeton/off"
refuses "truth and annotators" 2 "Exactly 1 option" "$COSEG" score --annotators "$work/data" --truth "$work/truth" --labels "$work/truth" "$work/princeton/off"
echo "ok: accuracy"
