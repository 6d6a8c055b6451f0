#!/usr/bin/env python3
"""What `coseg assign` loses and saves against solving the whole collection again.

usage: assign.py --coseg build/bin/coseg FOLDER ... [--leave 4] [--turned] [--seeds 1] [--ranks 2] [--out assign.json]

A FOLDER holds meshes and a NAME.seg of truth for each (or meshes/ and truth/, as `coseg generate` writes them); K is the
number of truth labels. Every (M / leave)-th shape is left out, the rest is run, the ones left out are assigned to that run;
with --turned (OFF files alone) they are turned at random before they are assigned.
Prints a table: one-to-one accuracy, in percent, of the shapes left out, as `coseg score` has it over all shapes (labels of
the rest and of those assigned together, against labels of a full run), and the seconds of the assignment beside those of
the full run (wall time of both, descriptions included; CPU seconds of all ranks in brackets).
"""
import argparse
import json
import os
import shutil
import tempfile

from accuracy import mean_and_deviation, truth_labels, turn_meshes
from links import meshes_and_truth
from program import command_output, timed


def mesh_names(folder):
    return sorted(name for name in os.listdir(folder) if name.lower().endswith((".off", ".obj", ".ply", ".stl", ".glb", ".gltf", ".vtp")))


def accuracies(args, truth, labels, meshes):
    score = json.loads(command_output([args.coseg, "score", "--json", "--truth", truth, "--labels", labels, meshes]))
    return score["per_shape"]


def measure(args, folder, seed):
    meshes, truth = meshes_and_truth(folder)
    names = mesh_names(meshes)
    step = max(len(names) // args.leave, 1)
    left = names[step // 2::step][:args.leave]
    start = ["mpirun", "--oversubscribe", "-n", str(args.ranks), args.coseg]
    quiet = ["--quiet", "--no-sheet", "--no-html"]
    with tempfile.TemporaryDirectory() as scratch:
        def listed(name, chosen, folder=meshes):
            path = os.path.join(scratch, name)
            with open(path, "w") as text:
                text.writelines(os.path.abspath(os.path.join(folder, mesh)) + "\n" for mesh in chosen)
            return "@" + path
        def out(name):
            return os.path.join(scratch, name)
        run = ["run", "--seed", str(seed), "--parts", str(truth_labels(truth))] + quiet
        full = timed(start + run + ["--out", out("full"), meshes])
        command_output(start + run + ["--out", out("rest"), listed("rest.txt", [n for n in names if n not in left])])
        added = meshes
        if args.turned:
            added = out("turned")
            turn_meshes(meshes, left, added)
        new = timed(start + ["assign", "--to", out("rest"), "--out", out("new"), listed("left.txt", left, added)] + quiet)
        for label in os.listdir(out("new") + "/labels"):
            shutil.copy(out("new") + "/labels/" + label, out("rest") + "/labels/" + label)
        of_full = accuracies(args, truth, out("full") + "/labels", meshes)
        of_rest = accuracies(args, truth, out("rest") + "/labels", meshes)
        model = os.path.getsize(out("rest") + "/model.h5")
    stems = [os.path.splitext(name)[0] for name in left]
    others = [name for name in of_full if name not in stems]
    def mean(values, chosen):
        return sum(values[name] for name in chosen) / len(chosen)
    return {"full": mean(of_full, stems), "assigned": mean(of_rest, stems), "rest_in_full": mean(of_full, others),
            "rest": mean(of_rest, others), "full_seconds": dict(zip(("wall", "cpu"), full)), "assign_seconds": dict(zip(("wall", "cpu"), new)), "model_bytes": model,
            "left": stems, "per_shape_full": [of_full[name] for name in stems],
            "per_shape_assigned": [of_rest[name] for name in stems]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--leave", type=int, default=4)
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--out", default="assign.json")
    args = parser.parse_args()
    figures = {}
    print("| set | left out | accuracy of these, full run | assigned | of the rest, full run | run without them | full run s "
          "(CPU) | assign s (CPU) | model MB |\n" + "|" + " --- |" * 9)
    for folder in args.folders:
        runs = [measure(args, folder, seed) for seed in args.seeds]
        figures[folder] = runs
        def of(key):
            return mean_and_deviation([run[key] for run in runs])
        def seconds(key):
            return " (".join(f"{sum(run[key][kind] for run in runs) / len(runs):.1f}" for kind in ("wall", "cpu")) + ")"
        print(f"| {os.path.basename(folder.rstrip('/'))} | {len(runs[0]['left'])} | {of('full')} | {of('assigned')} | "
              f"{of('rest_in_full')} | {of('rest')} | {seconds('full_seconds')} | {seconds('assign_seconds')} | "
              f"{runs[0]['model_bytes'] / 1e6:.1f} |", flush=True)
        with open(args.out, "w") as text:
            json.dump(figures, text, indent=1)


if __name__ == "__main__":
    main()
