#!/usr/bin/env python3
"""Accuracy of coseg over sets, presets and seeds, as JSON and as a Markdown table.

usage: bench/accuracy.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--presets default paper]
                         [--seeds 1 2 3] [--ranks 2] [--out accuracy.json] [--table docs/accuracy.md]
                         [--generated SHAPES [FAMILY ...]] [--turned]

The data folder is either a folder of sets, each with meshes, a NAME.seg of truth for every mesh and labels.txt, or the
Princeton Segmentation Benchmark: off/N.off and "human seg"/Benchmark/N/N_ANNOTATOR.seg (or seg/Benchmark/...); its
categories are then the sets. A preset may be followed by options, in quotes: "default --refine none".

--generated measures on collections of so many shapes of each family of `coseg generate` (seed 1) instead of a data folder.
--turned turns every shape (OFF) about its own axis by its own angle first: figures that owe nothing to how shapes stand in their files.

K is the number of truth labels. Every figure is what `coseg score` prints for the labels of one `coseg run`: area
rightly labelled in percent, mean over the shapes of a set; means and sample deviations over seeds. For the Princeton
benchmark the labels are taken apart into connected pieces and compared with all annotators.

Each run's figures go into the JSON file as soon as they are known, with the hash of the program; a second call with the
same program goes on where the first one ended. Runs that fail are listed, and repeated by the next call.
"""
import argparse
import hashlib
import json
import math
import os
import random
import re
import shlex
import statistics
import sys
import tempfile
import textwrap
import time

from program import PROGRAM, PROJECT, RunFailed, command_output, markdown, read_labels, write_whole

# Categories of the Princeton benchmark, twenty meshes each in the order of their numbers, with the number of labels of
# Kalogerakis, Hertzmann, Singh 2010 (which leave the springs out).
PRINCETON = [("human", 8), ("cup", 2), ("glasses", 3), ("airplane", 5), ("ant", 5), ("chair", 4), ("octopus", 2),
             ("table", 2), ("teddy", 5), ("hand", 6), ("plier", 3), ("fish", 3), ("bird", 5), ("spring", 1),
             ("armadillo", 11), ("bust", 8), ("mech", 5), ("bearing", 6), ("vase", 5), ("fourleg", 6)]

MEASURES = [("rand_index_error", "Rand index error"), ("cut_discrepancy", "cut discrepancy"),
            ("hamming_distance", "Hamming distance"), ("global_consistency_error", "global consistency error"),
            ("local_consistency_error", "local consistency error")]


def truth_labels(folder):
    labels = set()
    for name in os.listdir(folder):
        if name.endswith(".seg"):
            labels.update(read_labels(os.path.join(folder, name)))
    return len({label for label in labels if label >= 0})


def annotators_folder(data):
    for names in (("human seg", "Benchmark"), ("seg", "Benchmark"), ("human seg",), ("seg",)):
        folder = os.path.join(data, *names)
        if os.path.isdir(folder):
            return folder
    return None


def princeton_sets(data):
    """Sets of a folder in the benchmark's layout, by name: K, the meshes and where the annotators are."""
    meshes = {}
    for file in os.listdir(os.path.join(data, "off")):
        if re.fullmatch(r"[0-9]+\.off", file):
            number = int(file[:-4])
            if 1 <= number <= 20 * len(PRINCETON):
                meshes.setdefault((number - 1) // 20, []).append(number)
    sets = {}
    for category, numbers in sorted(meshes.items()):
        name, parts = PRINCETON[category]
        paths = [os.path.join(data, "off", f"{number}.off") for number in sorted(numbers)]
        sets[f"princeton_{name}"] = {"parts": parts, "meshes": paths, "annotators": annotators_folder(data)}
    return sets


def find_sets(data, wanted):
    if not os.path.isdir(data):
        sys.exit(f"accuracy: no folder {data}")
    if os.path.isdir(os.path.join(data, "off")) and annotators_folder(data):
        sets = princeton_sets(data)
    else:
        sets = {}
        for name in sorted(os.listdir(data)):
            folder = os.path.join(data, name)
            if os.path.isfile(os.path.join(folder, "labels.txt")):
                sets[name] = {"parts": truth_labels(folder), "meshes": [folder], "truth": folder}
    missing = sorted(set(wanted or []) - set(sets))
    if missing or not sets:
        sys.exit(f"accuracy: no set {missing[0] if missing else ''} in {data}; there are: {', '.join(sets) or 'none'}")
    return {name: sets[name] for name in sets if not wanted or name in wanted}


def generated_sets(coseg, shapes, families, folder, options=()):
    listing = command_output([coseg, "generate", "--list"], 60)
    known = [line.split()[0] for line in listing.splitlines() if line.strip()]
    unknown = sorted(set(families) - set(known))
    if unknown:
        sys.exit(f"accuracy: no family {unknown[0]}; there are: {', '.join(known)}")
    sets = {}
    for family in families or known:
        made = os.path.join(folder, family)
        command_output([coseg, "generate", family, "--count", str(shapes), "--seed", "1", "--out", made, *options], 3600)
        truth = os.path.join(made, "truth")
        sets[f"generated_{family}"] = {"parts": truth_labels(truth), "meshes": [os.path.join(made, "meshes")], "truth": truth}
    return sets


def chosen_sets(arguments, folder):
    """Those of --generated, made in `folder`, or else of the data folder."""
    if not arguments.generated:
        return find_sets(arguments.data, arguments.sets)
    shapes, *families = arguments.generated
    if not shapes.isdigit() or int(shapes) < 2:
        sys.exit(f"accuracy: --generated takes a number of shapes of at least 2, not {shapes}")
    return generated_sets(arguments.coseg, int(shapes), families, folder)


def random_rotation(name):
    """Of the name alone; uniform: a unit quaternion of four normal numbers."""
    numbers = random.Random(name)
    w, x, y, z = (numbers.gauss(0.0, 1.0) for _ in range(4))
    norm = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def turn_off(source, target, rotation):
    with open(source) as file:
        lines = [line for line in file.read().split("\n") if line.strip() and not line.lstrip().startswith("#")]
    vertices = int(lines[1].split()[0])
    for k in range(2, 2 + vertices):
        point = [float(word) for word in lines[k].split()[:3]]
        lines[k] = " ".join(f"{sum(a * b for a, b in zip(row, point)):.9g}" for row in rotation)
    with open(target, "w") as file:
        file.write("\n".join(lines) + "\n")


def turn_meshes(source, names, target):
    """Copies of these OFF files in the new folder `target`, each turned at random, as its name alone says."""
    os.makedirs(target)
    for name in names:
        turn_off(os.path.join(source, name), os.path.join(target, name), random_rotation(name))


def labelled_meshes(one_set):
    """The paths of the meshes of a set that have a truth, sorted."""
    return sorted(os.path.join(folder, name) for folder in one_set["meshes"] for name in os.listdir(folder)
                  if os.path.exists(os.path.join(one_set["truth"], os.path.splitext(name)[0] + ".seg"))
                  and not name.endswith(".seg"))


def turned_sets(sets, folder):
    turned = {}
    for name, one_set in sets.items():
        if "truth" not in one_set:
            sys.exit("accuracy: --turned is for sets with a truth of their own")
        made = os.path.join(folder, "turned", name)
        source = one_set["meshes"][0]
        turn_meshes(source, [mesh for mesh in os.listdir(source) if mesh.endswith(".off")], made)
        turned[f"{name} (turned)"] = {**one_set, "meshes": [made]}
    return turned


def measure(args, one_set, preset, seed):
    with tempfile.TemporaryDirectory() as scratch:
        out = os.path.join(scratch, "result")
        mesh_list = os.path.join(scratch, "meshes.txt")
        with open(mesh_list, "w") as lines:
            lines.writelines(os.path.abspath(mesh) + "\n" for mesh in one_set["meshes"])
        start = time.monotonic()
        command_output(["mpirun", "--oversubscribe", "-n", str(args.ranks), args.coseg, "run", "--preset", *shlex.split(preset),
                        "--seed", str(seed), "--parts", str(one_set["parts"]), "--quiet", "--out", out, "@" + mesh_list],
                       args.timeout)
        seconds = time.monotonic() - start
        labels = ["--labels", os.path.join(out, "labels"), "@" + mesh_list]
        if "truth" in one_set:
            known = ["--json", "--truth", one_set["truth"], "--patches", os.path.join(out, "patches")]
        else:
            known = ["--annotators", one_set["annotators"]]
        score = json.loads(command_output([args.coseg, "score", *known, *labels], args.timeout))
        with open(os.path.join(out, "report.json")) as text:
            memory = json.load(text)["peak_memory_sum_mib"]
    return {"score": score, "seconds": round(seconds, 1), "memory_mib": round(memory)}


def hash_of(path):
    with open(path, "rb") as program:
        return hashlib.sha256(program.read()).hexdigest()[:16]


def read_figures(path):
    if not os.path.exists(path):
        return {}
    with open(path) as text:
        return json.load(text)


def run_all(args, sets, figures):
    program = hash_of(args.coseg)
    failures = []
    for seed in args.seeds:
        for preset in args.presets:
            for name, one_set in sets.items():
                of_set = figures.setdefault(name, {"parts": one_set["parts"], "runs": {}})
                runs = of_set["runs"].setdefault(preset, {})
                done = runs.get(str(seed))
                if done and (args.keep or done["program"] == program):
                    continue
                try:
                    runs[str(seed)] = {**measure(args, one_set, preset, seed), "program": program, "ranks": args.ranks}
                except RunFailed as failure:
                    failures.append(str(failure))
                    print(f"{name} {preset} seed {seed}: failed: {failure}", file=sys.stderr, flush=True)
                    continue
                print(f"{name} {preset} seed {seed}: {headline(runs[str(seed)]['score'])}", flush=True)
                write_whole(args.out, json.dumps(figures, indent=1) + "\n")
    return failures


def headline(score):
    if "one_to_one" in score:
        return f"one-to-one {score['one_to_one']:.1f}"
    return f"Rand index error {score['rand_index_error']:.3f}"


def runs_of(figures, name, preset, seeds):
    runs = figures.get(name, {}).get("runs", {}).get(preset, {})
    return [runs[str(seed)] for seed in seeds if str(seed) in runs]


def mean_and_deviation(values, digits=1):
    deviation = f" ± {statistics.stdev(values):.{digits}f}" if len(values) > 1 else ""
    return f"{statistics.fmean(values):.{digits}f}{deviation}"


def mean_of(runs, key):
    return statistics.fmean(run["score"][key] for run in runs)


def accuracy_table(figures, sets, presets, seeds):
    rows = [["set", "K", "one label"] + presets]
    for name in sets:
        all_runs = [run for preset in presets for run in runs_of(figures, name, preset, seeds)]
        if not all_runs:
            continue
        row = [name, str(figures[name]["parts"]), f"{mean_of(all_runs, 'one_label'):.1f}"]
        for preset in presets:
            runs = runs_of(figures, name, preset, seeds)
            row.append(mean_and_deviation([run["score"]["one_to_one"] for run in runs]) if runs else "-")
        rows.append(row)
    last = ["**mean**", "", ""]
    for preset in presets:
        means = [mean_of(runs, "one_to_one") for name in sets if (runs := runs_of(figures, name, preset, seeds))]
        last.append(f"**{statistics.fmean(means):.1f}**" if len(means) == len(sets) else "-")
    return markdown(rows + [last])


def detail_table(figures, sets, preset, seeds):
    rows = [["set", "one-to-one", "many-to-one", "Rand index", "patch bound", "least shape", "seconds", "MiB"]]
    for name in sets:
        runs = runs_of(figures, name, preset, seeds)
        if not runs:
            continue
        shapes = [statistics.fmean(run["score"]["per_shape"][shape] for run in runs) for shape in runs[0]["score"]["per_shape"]]
        rows.append([name] + [mean_and_deviation([run["score"][key] for run in runs]) for key in ("one_to_one", "many_to_one")] +
                    [f"{mean_of(runs, 'rand_index'):.3f}", f"{mean_of(runs, 'patch_bound'):.1f}", f"{min(shapes):.1f}",
                     f"{statistics.fmean(run['seconds'] for run in runs):.0f}",
                     f"{statistics.fmean(run['memory_mib'] for run in runs):.0f}"])
    return markdown(rows)


def leave_one_out(figures, sets, presets, seeds):
    """The preset that is best on the other sets, measured on each set in turn; none where it cannot be told."""
    means = {}
    for preset in presets:
        for name in sets:
            runs = runs_of(figures, name, preset, seeds)
            if not runs:
                return ""
            means[preset, name] = mean_of(runs, "one_to_one")
    if len(presets) < 2 or len(sets) < 2:
        return ""
    chosen = {name: max(presets, key=lambda preset: sum(means[preset, other] for other in sets if other != name))
              for name in sets}
    figure = statistics.fmean(means[chosen[name], name] for name in sets)
    picks = ", ".join(f"`{preset}` {sum(1 for name in sets if chosen[name] == preset)} times"
                      for preset in presets if preset in chosen.values())
    return "\n" + paragraph(
        f"{len(presets)} presets are compared here. If for each set the preset is taken that is best on the mean of the other "
        f"sets ({picks}), the mean is {figure:.1f}.")


def annotator_table(figures, sets, presets, seeds):
    rows = [["set", "K", "preset"] + [title for _, title in MEASURES] + ["seconds"]]
    for name in sets:
        for preset in presets:
            runs = runs_of(figures, name, preset, seeds)
            if not runs:
                continue
            row = [name, str(figures[name]["parts"]), preset]
            for key, _ in MEASURES:
                values = [run["score"][key] for run in runs if run["score"][key] is not None]
                row.append(mean_and_deviation(values, 3) if values else "-")
            rows.append(row + [f"{statistics.fmean(run['seconds'] for run in runs):.0f}"])
    return markdown(rows)


def paragraph(text):
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


def document(args, sets, figures):
    seeds = ", ".join(str(seed) for seed in args.seeds)
    command = "bench/accuracy.py" + (" --presets " + shlex.join(args.presets) if args.presets != ["default", "paper"] else "")
    if args.generated:
        command += " --generated " + shlex.join(args.generated)
    if args.turned:
        command += " --turned"
    text = "# Accuracy\n\n" + paragraph(
        f"This page is written by `{command}`, with seeds {seeds} and {args.ranks} ranks. Each preset is one set of parameters. "
        "The first table has the one-to-one accuracy by area in percent: the mean over the shapes of a set, ± the sample "
        "deviation over seeds. \"One label\" is what a single part for everything would score. A difference below the "
        "deviation is not a result.") + "\n"
    labelled = [name for name in sets if "truth" in sets[name]]
    if labelled:
        text += accuracy_table(figures, labelled, args.presets, args.seeds)
        text += leave_one_out(figures, labelled, args.presets, args.seeds)
        for preset in args.presets:
            text += f"\n## `{preset}`\n\n" + paragraph(
                "\"Patch bound\" is the accuracy if every patch of the first over-segmentation took its majority label. \"Least "
                "shape\" is the accuracy of the shape with the lowest mean over seeds.") + "\n"
            text += detail_table(figures, labelled, preset, args.seeds)
    annotated = [name for name in sets if "annotators" in sets[name]]
    if annotated:
        text += "\n" if labelled else ""
        text += paragraph("These are the measures of the Princeton Segmentation Benchmark against all annotators; all are errors. "
                          "Parts are split into connected pieces.")
        text += "\n" + annotator_table(figures, annotated, args.presets, args.seeds)
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA"))
    parser.add_argument("--sets", nargs="+")
    parser.add_argument("--generated", nargs="+", metavar=("SHAPES", "FAMILY"))
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--presets", nargs="+", default=["default", "paper"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=7200.0, help="seconds after which a run counts as failed")
    parser.add_argument("--keep", action="store_true", help="keep figures that another build of the program gave")
    parser.add_argument("--out", default="accuracy.json")
    parser.add_argument("--table", default=os.path.join(PROJECT, "docs", "accuracy.md"))
    args = parser.parse_args()
    if not args.data and not args.generated:
        sys.exit("accuracy: give the folder of sets with --data or COSEG_DATA, or --generated")
    if not os.path.isfile(args.coseg):
        sys.exit(f"accuracy: no program {args.coseg}; build it, or give its path with --coseg")
    with tempfile.TemporaryDirectory() as scratch:
        sets = chosen_sets(args, scratch)
        if args.turned:
            sets = turned_sets(sets, scratch)
        figures = read_figures(args.out)
        failures = run_all(args, sets, figures)
        write_whole(args.table, document(args, sets, figures))
    if failures:
        sys.exit(f"accuracy: {len(failures)} of the runs failed; call again to repeat them")


if __name__ == "__main__":
    main()
