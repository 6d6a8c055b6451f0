#!/usr/bin/env python3
"""Accuracy with labels by example: some shapes of a labelled set are given with their truth, and the others are scored.

usage: bench/examples.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--examples 1] [--choices 0]
                         [--seed 1] [--ranks 2] [--out examples.json] [--table FILE]

--examples N gives N shapes. --choices C makes C choices of them: drawn at random, the same by each call; 0 takes every
shape once as the only example. K is that of the truth. Every figure is what `coseg score` prints for the shapes that
were not given: one-to-one accuracy by area in percent, mean over the choices, with the smallest and the largest.
"without" is the same run without examples, over all shapes. Descriptions and coefficients are kept in a state folder, so
that only the cut is made for each choice.
"""
import argparse
import json
import os
import random
import statistics
import tempfile

from accuracy import find_sets
from program import PROGRAM, PROJECT, one_to_one, run_labels


def run_with_state(arguments, sample, state, out, options):
    """A run into `sample["parts"]` parts, with further options of coseg run."""
    run_labels(arguments, sample["parts"], out, ["--seed", arguments.seed, "--state", state, *options, *sample["meshes"]])


def links(folder, source, names):
    """A folder with links to the truth of these shapes alone."""
    os.makedirs(folder)
    for name in names:
        os.symlink(os.path.join(os.path.abspath(source), name + ".seg"), os.path.join(folder, name + ".seg"))
    return folder


def choices_of(names, arguments):
    if arguments.choices == 0:
        return [[name] for name in names]
    rng = random.Random("examples")
    return [rng.sample(names, arguments.examples) for _ in range(arguments.choices)]


def measure(arguments, sample, work):
    names = sorted(file[:-4] for file in os.listdir(sample["truth"]) if file.endswith(".seg"))
    state, out = os.path.join(work, "state"), os.path.join(work, "out")
    run_with_state(arguments, sample, state, out, [])
    without = one_to_one(arguments, sample["truth"], os.path.join(out, "labels"), sample["meshes"])
    figures = []
    for number, given in enumerate(choices_of(names, arguments)):
        folder = links(os.path.join(work, f"given_{number}"), sample["truth"], given)
        others = links(os.path.join(work, f"others_{number}"), sample["truth"], [n for n in names if n not in given])
        run_with_state(arguments, sample, state, out, ["--examples", folder])
        figures.append(one_to_one(arguments, others, os.path.join(out, "labels"), sample["meshes"]))
    return {"parts": sample["parts"], "shapes": len(names), "without": without, "choices": figures}


def table(results, examples):
    lines = [f"| set (K) | shapes | without | {examples} given: mean | least | most | choices |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, row in results.items():
        figures = row["choices"]
        lines.append(f"| {name} ({row['parts']}) | {row['shapes']} | {row['without']:.1f} | {statistics.mean(figures):.1f} | "
                     f"{min(figures):.1f} | {max(figures):.1f} | {len(figures)} |")
    mean = statistics.mean(statistics.mean(row["choices"]) for row in results.values())
    lines.append(f"| mean | | {statistics.mean(row['without'] for row in results.values()):.1f} | {mean:.1f} | | | |")
    return "\n".join(lines)


def add_set_arguments(parser):
    """What a measurement over labelled sets with one seed needs to know."""
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA", os.path.join(PROJECT, "..", "shared", "data")))
    parser.add_argument("--sets", nargs="*")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--table")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_set_arguments(parser)
    parser.add_argument("--examples", type=int, default=1)
    parser.add_argument("--choices", type=int, default=0)
    parser.add_argument("--out", default="examples.json")
    arguments = parser.parse_args()
    if arguments.choices == 0 and arguments.examples != 1:
        parser.error("--examples above 1 needs a number of --choices")
    results = {}
    for name, sample in find_sets(arguments.data, arguments.sets).items():
        with tempfile.TemporaryDirectory() as work:
            results[name] = measure(arguments, sample, work)
        print(table({name: results[name]}, arguments.examples).splitlines()[2], flush=True)
        with open(arguments.out, "w") as file:
            json.dump({"examples": arguments.examples, "seed": arguments.seed, "sets": results}, file, indent=1)
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write(table(results, arguments.examples) + "\n")
    print(table(results, arguments.examples))


if __name__ == "__main__":
    main()
