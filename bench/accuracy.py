#!/usr/bin/env python3
"""Accuracy of coseg over sets, presets and seeds, as a table.

usage: accuracy.py --coseg build/bin/coseg [--data $COSEG_DATA] [--sets NAME ...] [--presets default paper]
                   [--seeds 1 2 3] [--ranks 2] [--out accuracy.json] [--table accuracy.md]

A set is a folder of the data folder with meshes, a NAME.seg of truth for each and labels.txt. K is the number of truth
labels. Every figure is what `coseg score --json` prints for the labels of one `coseg run`: area rightly labelled in
percent, mean over the shapes of a set. Runs whose figures are already in the JSON file are not repeated; delete the
file after a change of the program.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time


def truth_labels(folder):
    labels = set()
    for name in os.listdir(folder):
        if name.endswith(".seg"):
            with open(os.path.join(folder, name)) as lines:
                labels.update(int(word) for word in lines.read().split())
    return len({label for label in labels if label >= 0})


def find_sets(data, wanted):
    found = sorted(name for name in os.listdir(data) if os.path.isfile(os.path.join(data, name, "labels.txt")))
    missing = sorted(set(wanted or []) - set(found))
    if missing:
        sys.exit(f"accuracy: no set {missing[0]} in {data}; there are: {', '.join(found)}")
    return [name for name in found if not wanted or name in wanted]


def command_output(words):
    result = subprocess.run(words, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"accuracy: {' '.join(words)} ended with {result.returncode}: {result.stderr.strip()}")
    return result.stdout


def measure(args, folder, preset, seed, parts):
    with tempfile.TemporaryDirectory() as scratch:
        out = os.path.join(scratch, "result")
        start = time.monotonic()
        command_output(["mpirun", "--oversubscribe", "-n", str(args.ranks), args.coseg, "run", "--preset", preset, "--seed",
                        str(seed), "--parts", str(parts), "--quiet", "--out", out, folder])
        seconds = time.monotonic() - start
        score = json.loads(command_output(
            [args.coseg, "score", "--json", "--truth", folder, "--labels", os.path.join(out, "labels"), folder]))
    return {"score": score, "seconds": round(seconds, 1)}


def mean_and_deviation(values):
    deviation = statistics.stdev(values) if len(values) > 1 else 0.0
    return f"{statistics.fmean(values):.1f} ± {deviation:.1f}"


def table(figures, sets, presets):
    head = ["set", "K"] + [f"{p}: one-to-one | {p}: many-to-one | seconds" for p in presets]
    columns = 2 + 3 * len(presets)
    rows = ["| " + " | ".join(head) + " |", "|" + " --- |" * columns]
    means = {preset: [] for preset in presets}
    for name in sets:
        row = [name, str(figures[name]["parts"])]
        for preset in presets:
            runs = list(figures[name].get(preset, {}).values())
            one = [run["score"]["one_to_one"] for run in runs]
            many = [run["score"]["many_to_one"] for run in runs]
            means[preset].append(statistics.fmean(one))
            row += [mean_and_deviation(one), mean_and_deviation(many),
                    f"{statistics.fmean(run['seconds'] for run in runs):.0f}"]
        rows.append("| " + " | ".join(row) + " |")
    last = ["**mean**", ""]
    for preset in presets:
        last += [f"**{statistics.fmean(means[preset]):.1f}**", "", ""]
    rows.append("| " + " | ".join(last) + " |")
    return "\n".join(rows) + "\n"


def read_figures(path):
    if not os.path.exists(path):
        return {}
    with open(path) as text:
        return json.load(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA"))
    parser.add_argument("--sets", nargs="+")
    parser.add_argument("--presets", nargs="+", default=["default", "paper"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--out", default="accuracy.json")
    parser.add_argument("--table", default="accuracy.md")
    args = parser.parse_args()
    if not args.data:
        sys.exit("accuracy: give the folder of sets with --data or COSEG_DATA")
    figures = read_figures(args.out)
    sets = find_sets(args.data, args.sets)
    for preset in args.presets:
        for name in sets:
            folder = os.path.join(args.data, name)
            of_set = figures.setdefault(name, {"parts": truth_labels(folder)})
            runs = of_set.setdefault(preset, {})
            for seed in args.seeds:
                if str(seed) in runs:
                    continue
                runs[str(seed)] = measure(args, folder, preset, seed, of_set["parts"])
                print(f"{name} {preset} seed {seed}: {runs[str(seed)]['score']['one_to_one']:.1f}", flush=True)
                with open(args.out, "w") as text:
                    json.dump(figures, text, indent=1)
    with open(args.table, "w") as text:
        text.write(table(figures, sets, args.presets))


if __name__ == "__main__":
    main()
