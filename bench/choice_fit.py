#!/usr/bin/env python3
"""Fits the weights of the choice among partitions to labelled sets and generated families.

usage: bench/choice_fit.py pools --data FOLDER --out POOLS [--bench build/bin/choice_bench] [--coseg build/bin/coseg] [--sets NAME ...]
                           [--seeds 1 2] [--halves 2] [--generated 12] [--largest 60] [--searches 8] [--spread 0.5]
                           [--weights FILE] [--unweighted] [--round NAME] [--processes 2]
       bench/choice_fit.py fit --pools POOLS [--ridge 0.3] [--hold TERM ...] [--terms TERM ...] [--out WEIGHTS] [--table FILE]
       bench/choice_fit.py confirm --data FOLDER --weights FILE ... [--sizes 0 4 6 8 12] [--seeds 1 2 3] [--table FILE]

`pools` runs bench/choice_bench.cpp on every labelled set (see bench/accuracy.py) with each seed, on random halves of them, and on
the generated families with so many shapes each. Every run leaves a file of partitions that searches with several weights
found, with their terms and their accuracy. --round names the files, so that those of searches with other --weights come
beside them.

`fit` finds the weights with the largest expected accuracy, where a partition is taken with a probability of exp(score) out of
all that were found for the same run, less `ridge` points times the squared distance of the logarithms of the weights to
those in the program. A family counts once, whatever the number of its runs. Terms of --hold keep their weight. The table has,
for each family, the accuracy of the partition with the highest score: by the program's weights, by weights fitted with the
family, and by weights fitted without it; and the most that any partition has.

`confirm` searches with each file of weights, after the program's own, in whole sets (size 0) and in random samples of so many shapes,
and prints the mean accuracy of what is taken. Accuracy is that of patches, before boundaries are refined. Sets of more than --largest
shapes are represented by samples everywhere. Needs NumPy and SciPy.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import tempfile

import numpy as np
from accuracy import find_sets, generated_sets, labelled_meshes
from program import PROGRAM, PROJECT, command_output, markdown, write_whole
from scipy.optimize import minimize

# Sets of shapes of one kind stand for one family, whoever made them. The others are families of their own.
KINDS = {"humans_adobe": "people", "humans_scape": "people", "generated_human": "people",
         "coseg_chairs": "chairs", "generated_chair": "chairs", "psb_airplane": "aeroplanes", "generated_airplane": "aeroplanes",
         "psb_ant": "ants", "generated_ant": "ants", "psb_cup": "cups", "generated_cup": "cups",
         "psb_plier": "pliers", "generated_pliers": "pliers", "psb_fourleg": "quadrupeds", "generated_quadruped": "quadrupeds",
         "psb_vase": "vases", "coseg_large_vases": "vases", "generated_goblet": "vases"}


def runs_of(arguments, folder):
    """(name of the file, set, seed, meshes) of every run, the largest first."""
    runs = []
    sets = find_sets(arguments.data, arguments.sets)
    if arguments.generated:
        sets.update(generated_sets(arguments.coseg, arguments.generated, [], folder, ["--faces", "3000"]))
    for name, one_set in sets.items():
        meshes = labelled_meshes(one_set)
        is_whole = len(meshes) <= arguments.largest
        is_generated = name.startswith("generated_")
        for seed in arguments.seeds[:1] if is_generated or not is_whole else arguments.seeds:
            sample = meshes if is_whole else random.Random(seed).sample(meshes, arguments.largest)
            runs.append((f"{name}.whole{seed}", one_set, seed, sample))
        for half in range(0 if is_generated else arguments.halves):
            chosen = random.Random(f"{name} {half}").sample(meshes, min(len(meshes) // 2, arguments.largest // 2))
            runs.append((f"{name}.half{half}", one_set, half + 1, chosen))
    return sorted(runs, key=lambda run: -len(run[3]))


def searched(arguments, one_set, seed, meshes, options):
    """What bench/choice_bench.cpp says of these meshes, as text."""
    with tempfile.TemporaryDirectory() as truth:
        for mesh in meshes:
            label = os.path.splitext(os.path.basename(mesh))[0] + ".seg"
            os.symlink(os.path.abspath(os.path.join(one_set["truth"], label)), os.path.join(truth, label))
        return command_output([arguments.bench, "--truth", truth, "--parts", str(one_set["parts"]), "--seed", str(seed)] +
                              options + ["--"] + meshes)


def make_pool(arguments, run):
    name, one_set, seed, meshes = run
    path = os.path.join(arguments.out, f"{name}.{arguments.round}.json")
    if os.path.exists(path):
        return
    options = ["--searches", str(arguments.searches), "--spread", str(arguments.spread)]
    options += ["--unweighted"] * arguments.unweighted + (["--weights", arguments.weights] if arguments.weights else [])
    write_whole(path, searched(arguments, one_set, seed, meshes, options))
    print(name, flush=True)


def make_pools(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(arguments.processes) as pool:
        list(pool.map(lambda run: make_pool(arguments, run), runs_of(arguments, folder)))


def read_pools(folder):
    """Of each run: the names of terms, the program's weights, and the accuracy of partitions by their values."""
    found = {}
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        pool = json.loads(path.read_text())
        name = ".".join(path.name.split(".")[:2])
        of_run = found.setdefault(name, {"terms": pool["terms"], "weights": pool["weights"], "partitions": {}})
        for partition in pool["partitions"]:
            if not partition["degenerate"]:
                of_run["partitions"][tuple(partition["values"])] = partition["accuracy"]
    return found


def expand(pools, terms):
    """Runs as arrays over the same terms; a term that a run has not is 0 there."""
    runs = []
    for name, pool in pools.items():
        if len(pool["partitions"]) < 2:
            continue
        values = np.zeros((len(pool["partitions"]), len(terms)))
        given = np.array(list(pool["partitions"]))
        for k, term in enumerate(pool["terms"]):
            if term in terms:
                values[:, terms.index(term)] = given[:, k]
        set_name = name.split(".")[0]
        runs.append({"name": name, "family": KINDS.get(set_name, set_name), "values": values,
                     "accuracy": 100.0 * np.array(list(pool["partitions"].values()))})
    return runs


def shares(runs):
    """The weight of each run, so that every family counts once."""
    count = {}
    for run in runs:
        count[run["family"]] = count.get(run["family"], 0) + 1
    return [1.0 / count[run["family"]] / len(count) for run in runs]


def fit(runs, start, ridge, free):
    """The weights; those that are not `free` keep the value they start with."""
    weight_of_run = shares(runs)

    def loss(logs):
        weights = np.exp(logs)
        total, gradient = 0.0, np.zeros_like(logs)
        for run, share in zip(runs, weight_of_run):
            score = run["values"] @ weights
            chance = np.exp(score - score.max())
            chance /= chance.sum()
            expected = chance @ run["accuracy"]
            total -= share * expected
            gradient -= share * ((chance * (run["accuracy"] - expected)) @ run["values"]) * weights
        distance = logs - np.log(start)
        return total + ridge * distance @ distance, (gradient + 2.0 * ridge * distance) * free

    return np.exp(minimize(loss, np.log(start), jac=True, method="L-BFGS-B").x)


def taken(run, weights):
    return run["accuracy"][np.argmax(run["values"] @ weights)]


def terms_of(pools, wanted, least):
    """The terms that have a weight in the program, or are wanted, and the weights with which a fit of them starts."""
    start = {}
    for pool in pools.values():
        for term, weight in zip(pool["terms"], pool["weights"]):
            if weight > 0.0 or term in wanted:
                start.setdefault(term, weight if weight > 0.0 else least)
    return list(start), np.array(list(start.values()))


def fit_weights(arguments):
    pools = read_pools(arguments.pools)
    terms, start = terms_of(pools, arguments.terms, arguments.least)
    free = np.array([term not in arguments.hold for term in terms])
    runs = expand(pools, terms)
    weights = fit(runs, start, arguments.ridge, free)
    families = sorted({run["family"] for run in runs})
    columns = []
    for family in families:
        own = [run for run in runs if run["family"] == family]
        held_out = fit([run for run in runs if run["family"] != family], start, arguments.ridge, free)
        columns.append([np.mean([taken(run, w) for run in own]) for w in (start, weights, held_out)] +
                       [np.mean([run["accuracy"].max() for run in own])])
    rows = [["family", "program", "fitted", "fitted without it", "best found"]]
    rows += [[family] + [f"{figure:.1f}" for figure in column] for family, column in zip(families, columns)]
    rows.append(["**mean**"] + [f"{figure:.2f}" for figure in np.mean(columns, axis=0)])
    text = markdown(rows) + "\n" + markdown([["term", "program", "fitted"]] + [
        [term, f"{before:g}", f"{after:.3g}"] for term, before, after in zip(terms, start, weights)])
    finish(arguments, text)
    if arguments.out:
        pathlib.Path(arguments.out).write_text(json.dumps(dict(zip(terms, weights)), indent=1) + "\n")


def finish(arguments, text):
    print(text)
    if arguments.table:
        pathlib.Path(arguments.table).write_text(text)


def samples_of(arguments, name, one_set, size):
    """(seed, meshes) of each run of a set."""
    meshes = labelled_meshes(one_set)
    count = size or min(len(meshes), arguments.largest)
    return [(seed, meshes if count == len(meshes) else random.Random(f"{size} {seed}").sample(meshes, count)) for seed in arguments.seeds]


def confirm(arguments):
    sets = find_sets(arguments.data, arguments.sets)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(arguments.processes) as pool:
        own = os.path.join(folder, "program.json")
        pathlib.Path(own).write_text("{}")
        jobs = {(size, name, seed): pool.submit(searched, arguments, one_set, seed, meshes, ["--weights", own] + arguments.weights)
                for size in arguments.sizes for name, one_set in sets.items()
                for seed, meshes in samples_of(arguments, name, one_set, size)}
        taken_of = {job: [100.0 * p["accuracy"] for p in json.loads(done.result())["partitions"] if p["taken"]]
                    for job, done in jobs.items()}
    rows = [["shapes", "set", "program"] + [os.path.basename(path) for path in arguments.weights]]
    for size in arguments.sizes:
        means = [np.mean([figures for job, figures in taken_of.items() if job[:2] == (size, name)], axis=0) for name in sets]
        rows += [[str(size or "all"), name] + [f"{figure:.1f}" for figure in mean] for name, mean in zip(sets, means)]
        rows.append([str(size or "all"), "**mean**"] + [f"{figure:.2f}" for figure in np.mean(means, axis=0)])
    finish(arguments, markdown(rows))


def add_search_options(step, seeds):
    step.add_argument("--data", required=True)
    step.add_argument("--bench", default=os.path.join(PROJECT, "build", "bin", "choice_bench"))
    step.add_argument("--sets", nargs="*", default=[])
    step.add_argument("--seeds", nargs="+", type=int, default=seeds)
    step.add_argument("--largest", type=int, default=60, help="shapes of a run; of larger sets as many are drawn")
    step.add_argument("--processes", type=int, default=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    steps = parser.add_subparsers(required=True)
    pools = steps.add_parser("pools")
    pools.set_defaults(step=make_pools)
    add_search_options(pools, [1, 2])
    pools.add_argument("--out", required=True)
    pools.add_argument("--coseg", default=PROGRAM)
    pools.add_argument("--halves", type=int, default=2)
    pools.add_argument("--generated", type=int, default=12)
    pools.add_argument("--searches", type=int, default=8)
    pools.add_argument("--spread", type=float, default=0.5)
    pools.add_argument("--weights")
    pools.add_argument("--unweighted", action="store_true")
    pools.add_argument("--round", default="first")
    fitting = steps.add_parser("fit")
    fitting.set_defaults(step=fit_weights)
    fitting.add_argument("--pools", required=True)
    fitting.add_argument("--ridge", type=float, default=0.3)
    fitting.add_argument("--hold", nargs="*", default=[], help="terms that keep their weight")
    fitting.add_argument("--terms", nargs="*", default=[], help="terms without a weight in the program that get one")
    fitting.add_argument("--least", type=float, default=1.0, help="the weight that these start with")
    fitting.add_argument("--out")
    fitting.add_argument("--table")
    confirming = steps.add_parser("confirm")
    confirming.set_defaults(step=confirm)
    add_search_options(confirming, [1, 2, 3])
    confirming.add_argument("--weights", nargs="+", required=True)
    confirming.add_argument("--sizes", nargs="+", type=int, default=[0, 4, 6, 8, 12])
    confirming.add_argument("--table")
    arguments = parser.parse_args()
    arguments.step(arguments)


if __name__ == "__main__":
    main()
