#!/usr/bin/env python3
"""Stability of small collections: accuracy over seeds of each generated family, with 4, 6 and 8 shapes.

usage: bench/small_sets.py [--coseg build/bin/coseg] [--families NAME ...] [--sizes 4 6 8] [--seeds 20] [--faces 5000] [--ranks 2]
                           [--table FILE] [--details FILE]

For every seed, `coseg generate FAMILY --count SIZE --faces FACES --seed 1` is segmented with --seed SEED, and `coseg score` gives the
one-to-one accuracy. The table has the median over the seeds, the lowest, and how many lie more than 5 points below the
median. --details has each accuracy, one line a run. Exit code 1 if any seed lies so low.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from accuracy import generated_sets
from examples import score

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MOST_BELOW = 5.0


def accuracy(arguments, sample, seed, out):
    run = [arguments.coseg, "run", "--quiet", "--no-sheet", "--no-html", "--force", "--no-keep-model", "--parts", str(sample["parts"]),
           "--seed", str(seed), "--out", out] + sample["meshes"]
    subprocess.run(run, check=True, capture_output=True)
    return score(arguments, sample, sample["truth"], out + "/labels")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=os.path.join(PROJECT, "build", "bin", "coseg"))
    parser.add_argument("--families", nargs="*", default=[])
    parser.add_argument("--sizes", nargs="*", type=int, default=[4, 6, 8])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--faces", type=int, default=5000)
    parser.add_argument("--table")
    parser.add_argument("--details")
    arguments = parser.parse_args()
    os.environ["COSEG_RANKS"] = str(arguments.ranks)
    lines, unstable = ["| family (K) | shapes | median | lowest | seeds 5 below | seeds |", "| --- | --- | --- | --- | --- | --- |"], 0
    details = []
    for size in arguments.sizes:
        with tempfile.TemporaryDirectory() as work:
            made = generated_sets(arguments.coseg, size, arguments.families, work, ["--faces", str(arguments.faces)])
            for name, sample in made.items():
                figures = [accuracy(arguments, sample, seed, work + "/out") for seed in range(1, arguments.seeds + 1)]
                median = statistics.median(figures)
                below = sum(figure < median - MOST_BELOW for figure in figures)
                unstable += below
                lines.append(f"| {name[len('generated_'):]} ({sample['parts']}) | {size} | {median:.1f} | {min(figures):.1f} | "
                             f"{below} | {len(figures)} |")
                print(lines[-1], flush=True)
                details += [f"{name} {size} {seed} {figure:.2f}\n" for seed, figure in enumerate(figures, 1)]
                if arguments.details:
                    pathlib.Path(arguments.details).write_text("".join(details))
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write("\n".join(lines) + "\n")
    return 1 if unstable else 0


if __name__ == "__main__":
    sys.exit(main())
