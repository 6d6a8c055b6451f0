#!/usr/bin/env python3
"""How often `coseg run --parts auto` finds the published number of parts, as a Markdown table.

usage: bench/parts_auto.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--generated SHAPES]
                           [--ranks 2] [--seed 1] [--state DIR] [--table FILE]

The sets are those of bench/accuracy.py in the data folder; --generated N adds every family of `coseg generate` with N
shapes of seed 1, 0 none. --state keeps what is computed of each set in DIR/SET. "Clear" is what the report says.
"""
import argparse
import json
import os
import sys
import tempfile

from accuracy import find_sets
from program import PROGRAM, command_output, run_labels

FAMILIES = {"cup": 2, "goblet": 3, "table": 2, "chair": 3, "lamp": 3, "airplane": 5, "pliers": 3, "quadruped": 4,
            "human": 4, "ant": 5, "octopus": 2}


def part_count(arguments, meshes, name, work):
    state = os.path.join(arguments.state or work, name)
    out = os.path.join(work, "run")
    run_labels(arguments, "auto", out, ["--seed", arguments.seed, "--state", state, *meshes])
    with open(os.path.join(out, "report.json")) as file:
        return json.load(file)["partition"]["part_count"]


def generated(arguments, family, work):
    folder = os.path.join(work, family)
    command_output([arguments.coseg, "generate", family, "--count", arguments.generated, "--seed", 1, "--out", folder])
    return [os.path.join(folder, "meshes")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA", ""))
    parser.add_argument("--sets", nargs="*")
    parser.add_argument("--generated", type=int, default=16)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--state", default="")
    parser.add_argument("--table", default="")
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as work:
        sets = find_sets(arguments.data, arguments.sets) if arguments.data else {}
        jobs = [(name, sample["parts"], sample["meshes"]) for name, sample in sets.items()]
        if arguments.generated > 0:
            jobs += [("generated_" + f, k, generated(arguments, f, work)) for f, k in FAMILIES.items()]
        for name, published, meshes in jobs:
            count = part_count(arguments, meshes, name, work)
            rows.append((name, published, [n["parts"] for n in count["numbers"][:3]], count["clear"]))
            print(name, *rows[-1][1:], file=sys.stderr, flush=True)
    lines = ["| set | published | auto | next | clear |", "| --- | --- | --- | --- | --- |"]
    for name, published, numbers, clear in rows:
        lines.append(f"| {name} | {published} | {numbers[0]} | {', '.join(map(str, numbers[1:]))} | {'yes' if clear else 'no'} |")
    exact = sum(numbers[0] == published for _, published, numbers, _ in rows)
    near = sum(abs(numbers[0] - published) <= 1 for _, published, numbers, _ in rows)
    lines += ["", f"Exact: {exact} of {len(rows)}. Within 1: {near}."]
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write(text)


main()
