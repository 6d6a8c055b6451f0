#!/usr/bin/env python3
"""Accuracy and cost against the links of a mesh: what `coseg run --links L` loses and saves.

usage: links.py --coseg build/bin/coseg FOLDER ... [--links all 4 8 16 32] [--seeds 1 2 3] [--ranks 2] [--out links.json]

A FOLDER holds meshes, a NAME.seg of truth for each (beside them, or in truth/ with the meshes in meshes/, as `coseg
generate` writes them); K is the number of truth labels. Prints a table: accuracy as `coseg score` has it, in percent,
mean and standard deviation over the seeds, and the mean seconds of the optimiser and of the cut.
"""
import argparse
import json
import os
import statistics
import tempfile

from accuracy import mean_and_deviation, truth_labels
from program import command_output


def meshes_and_truth(folder):
    generated = os.path.join(folder, "meshes")
    return (generated, os.path.join(folder, "truth")) if os.path.isdir(generated) else (folder, folder)


def measure(args, folder, links, seed):
    meshes, truth = meshes_and_truth(folder)
    with tempfile.TemporaryDirectory() as scratch:
        out = os.path.join(scratch, "result")
        command_output(["mpirun", "--oversubscribe", "-n", str(args.ranks), args.coseg, "run", "--links", links, "--seed",
                        str(seed), "--parts", str(truth_labels(truth)), "--quiet", "--out", out, meshes])
        with open(os.path.join(out, "report.json")) as text:
            report = json.load(text)
        score = json.loads(command_output([args.coseg, "score", "--json", "--truth", truth, "--labels",
                                           os.path.join(out, "labels"), meshes]))
    seconds = {stage["stage"]: stage["seconds_wall"] for stage in report["stages"]}
    return {"one_to_one": score["one_to_one"], "many_to_one": score["many_to_one"],
            "optimise": seconds["optimise"], "cut": seconds["cut"], "shapes": len(report["meshes"]),
            "allowed_pairs": report["optimisation"]["allowed_pairs"],
            "pairs": report["optimisation"]["nonzero_groups"]}


def row(folder, links, runs):
    def mean(key):
        return statistics.fmean(run[key] for run in runs)
    one = mean_and_deviation([run["one_to_one"] for run in runs])
    many = mean_and_deviation([run["many_to_one"] for run in runs])
    return (f"| {os.path.basename(folder.rstrip('/'))} | {runs[0]['shapes']} | {links} | {one} | {many} | "
            f"{mean('optimise'):.1f} | {mean('cut'):.1f} | {mean('pairs'):.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--links", nargs="+", default=["all", "4", "8", "16", "32"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--out", default="links.json")
    args = parser.parse_args()
    figures = {}
    print("| set | shapes | links | one-to-one | many-to-one | optimise s | cut s | pairs |\n" + "|" + " --- |" * 8)
    for folder in args.folders:
        for links in args.links:
            runs = [measure(args, folder, links, seed) for seed in args.seeds]
            figures.setdefault(folder, {})[links] = runs
            print(row(folder, links, runs), flush=True)
            with open(args.out, "w") as text:
                json.dump(figures, text, indent=1)


if __name__ == "__main__":
    main()
