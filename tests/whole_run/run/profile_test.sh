#!/usr/bin/env bash
# --profile: the table, PETSc's log, and a trace in which every rank, stage, mesh and step stands where it belongs.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
for k in 1 2 3 4; do peanut "$work/set/p$k.off" "0.$((k + 3))"; done
common=(--patches 10 --geodesic-samples 40 --oversegmentations 3 --parts 2 --no-sheet --no-html)

"$COSEG" run "${common[@]}" --quiet --out "$work/plain" "$work/set"
[[ ! -e $work/plain/trace.json && ! -e $work/plain/profile.txt ]] || fail "a trace that nobody asked for"

for count in 1 2; do
    out=$work/on_$count
    ranks "$count" "$COSEG" run "${common[@]}" --profile --out "$out" "$work/set" 2>"$work/err"
    diff -r "$work/plain/labels" "$out/labels" || fail "--profile changes labels"
    for words in "describe" "  geodesics" "PETSc Performance Summary"; do
        grep -q -F -- "$words" "$work/err" || fail "$count ranks: '$words' is not printed"
        grep -q -F -- "$words" "$out/profile.txt" || fail "$count ranks: '$words' is not in profile.txt"
    done
    python3 - "$out" "$count" <<'END' || fail "the trace of $count ranks"
import json, sys

out, ranks = sys.argv[1], int(sys.argv[2])
report = json.load(open(out + "/report.json"))
events = json.load(open(out + "/trace.json"))["traceEvents"]
names = {e["pid"]: e["args"]["name"] for e in events if e["ph"] == "M"}
assert names == {r: f"rank {r}" for r in range(ranks)}, names
spans = [e for e in events if e["ph"] == "X"]
assert len(spans) + len(names) == len(events)
steps = {step["step"] for stage in report["stages"] for step in stage.get("steps", [])}
assert len(steps) > 5, steps
encloses = {"stage": None, "mesh": "stage", "step": "mesh", "wait": "stage"}
for rank in range(ranks):
    mine = [e for e in spans if e["pid"] == rank]
    stages = [e["name"] for e in mine if e["cat"] == "stage"]
    assert stages == [stage["stage"] for stage in report["stages"]], stages
    open_spans = []
    last = 0.0
    for event in mine:
        assert event["ts"] >= last and event["dur"] >= 0, event
        last = event["ts"]
        while open_spans and open_spans[-1]["ts"] + open_spans[-1]["dur"] <= event["ts"] + 0.01:
            open_spans.pop()
        if open_spans:
            outer = open_spans[-1]
            assert event["ts"] + event["dur"] <= outer["ts"] + outer["dur"] + 0.01, (outer, event)
        assert (open_spans[-1]["cat"] if open_spans else None) == encloses[event["cat"]], (open_spans, event)
        open_spans.append(event)
meshes = [e["name"] for e in spans if e["cat"] == "mesh"]
assert sorted(meshes) == [mesh["name"] for mesh in report["meshes"]], meshes
for mesh in report["meshes"]:
    assert [e["pid"] for e in spans if e["cat"] == "mesh" and e["name"] == mesh["name"]] == [mesh["rank"]]
assert {e["name"] for e in spans if e["cat"] == "step"} == steps
traced = sum(e["dur"] for e in spans if e["cat"] == "step") * 1e-6
told = sum(step["seconds"] for stage in report["stages"] for step in stage.get("steps", []))
assert abs(traced - told) < 1e-3 + 1e-3 * told, (traced, told)
END
    echo "ok: $count ranks"
done

"$COSEG" run "${common[@]}" --profile --quiet --out "$work/quiet" "$work/set" 2>"$work/err"
[[ ! -s $work/err && -s $work/quiet/profile.txt ]] || fail "--quiet prints a profile, or writes none"
"$COSEG" run "${common[@]}" --force --quiet --out "$work/quiet" "$work/set"
[[ ! -e $work/quiet/trace.json ]] || fail "an earlier run's trace stays"
echo "ok: profile"
