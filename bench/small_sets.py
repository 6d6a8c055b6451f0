#!/usr/bin/env python3
"""Small collections: accuracy over seeds of each generated family, or of random samples of labelled sets.

usage: bench/small_sets.py [--coseg build/bin/coseg] [--families NAME ...] [--sizes 4 6 8] [--seeds 20] [--faces 5000] [--ranks 2]
                           [--data FOLDER] [--sets NAME ...] [--table FILE] [--details FILE] [-- OPTIONS of coseg run]

For every seed, `coseg generate FAMILY --count SIZE --faces FACES --seed 1` is segmented with --seed SEED, and `coseg score` gives the
one-to-one accuracy. The table has the median over the seeds, the lowest, and how many lie more than 5 points below the
median. --details has each accuracy, one line a run. Exit code 1 if any seed lies so low.

With --data, each seed takes a random sample of SIZE shapes of each labelled set in FOLDER (see bench/accuracy.py) instead; the
table then has the mean over the samples and the lowest, and the mean of all sets.
"""
import argparse
import pathlib
import random
import statistics
import sys
import tempfile

from accuracy import find_sets, generated_sets, labelled_meshes
from program import PROGRAM, one_to_one, parsed_with_options, run_labels

MOST_BELOW = 5.0


def accuracy(arguments, sample, seed, out):
    run_labels(arguments, sample["parts"], out, ["--seed", seed, *arguments.options, *sample["meshes"]])
    return one_to_one(arguments, sample["truth"], out + "/labels", sample["meshes"])


def sample_of(one_set, size, seed):
    """So many shapes of a labelled set, drawn by the seed."""
    return {**one_set, "meshes": random.Random(f"{size} {seed}").sample(labelled_meshes(one_set), size)}


def measure_samples(arguments):
    """Prints a row of each set and size; returns all rows."""
    rows = ["| set (K) | shapes | mean | lowest | samples |", "| --- | --- | --- | --- | --- |"]
    print("\n".join(rows), flush=True)
    sets = find_sets(arguments.data, arguments.sets)
    for size in arguments.sizes:
        means = []
        for name, one_set in sets.items():
            with tempfile.TemporaryDirectory() as work:
                figures = [accuracy(arguments, sample_of(one_set, size, seed), seed, work + "/out") for seed in range(1, arguments.seeds + 1)]
            means.append(statistics.mean(figures))
            rows.append(f"| {name} ({one_set['parts']}) | {size} | {means[-1]:.1f} | {min(figures):.1f} | {len(figures)} |")
            print(rows[-1], flush=True)
        rows.append(f"| **mean** | {size} | {statistics.mean(means):.2f} |  |  |")
        print(rows[-1], flush=True)
    return rows


def measure_families(arguments):
    """Prints a row of each family and size; returns all rows, and how many seeds lie low."""
    rows, unstable = ["| family (K) | shapes | median | lowest | seeds 5 below | seeds |", "| --- | --- | --- | --- | --- | --- |"], 0
    details = []
    for size in arguments.sizes:
        with tempfile.TemporaryDirectory() as work:
            made = generated_sets(arguments.coseg, size, arguments.families, work, ["--faces", str(arguments.faces)])
            for name, sample in made.items():
                figures = [accuracy(arguments, sample, seed, work + "/out") for seed in range(1, arguments.seeds + 1)]
                median = statistics.median(figures)
                below = sum(figure < median - MOST_BELOW for figure in figures)
                unstable += below
                rows.append(f"| {name[len('generated_'):]} ({sample['parts']}) | {size} | {median:.1f} | {min(figures):.1f} | "
                            f"{below} | {len(figures)} |")
                print(rows[-1], flush=True)
                details += [f"{name} {size} {seed} {figure:.2f}\n" for seed, figure in enumerate(figures, 1)]
                if arguments.details:
                    pathlib.Path(arguments.details).write_text("".join(details))
    return rows, unstable


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--families", nargs="*", default=[])
    parser.add_argument("--data")
    parser.add_argument("--sets", nargs="*", default=[])
    parser.add_argument("--sizes", nargs="*", type=int, default=[4, 6, 8])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--faces", type=int, default=5000)
    parser.add_argument("--table")
    parser.add_argument("--details")
    arguments, arguments.options = parsed_with_options(parser)
    rows, unstable = (measure_samples(arguments), 0) if arguments.data else measure_families(arguments)
    if arguments.table:
        pathlib.Path(arguments.table).write_text("\n".join(rows) + "\n")
    return 1 if unstable else 0


if __name__ == "__main__":
    sys.exit(main())
