#!/usr/bin/env python3
"""The minutes of a simulated person who corrects a run, and how right the labels of all shapes are meanwhile.

usage: bench/effort.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--rules active random] [--ranks 2]
                       [--generated SHAPES [FAMILY ...]] [--minutes 30] [--target 98] [--measure 1] [--seed 1]
                       [--out effort.json] [--table FILE] [--scratch DIR]

The person looks at one shape after the other and leaves it as the truth says, part by part, through `coseg edit` (the
requests of its page; docs/editing.md). Time is counted as in HAL3D (Yu et al., ICCV 2023, section 4.3), with L labels in the set:

    a part that is right            .31 + .03 L seconds, to check it
    a part that is wrong           5.28 + .23 L seconds, to correct it
    a shape with any wrong part    1.47 + .05 L seconds more, to reject it

A part of a shape, of the labels shown or of the truth, is right if both differ on at most --tolerance of the shape's area;
what a right part lacks stays wrong. Then the shape is confirmed. In the beginning the person says which label each part of
the run is, which takes as long as checking L parts; this is the one-to-one assignment of the largest area.

    active   the shape that coseg edit asks for
    doubt    the least sure one
    random   any, the same order by each call

--generated measures on collections of so many shapes of each family of `coseg generate` (seed 1) instead of a data folder.

Accuracy is the share of the area with the right label, mean over all shapes, corrected ones among them. K is that of the
truth. Times of acts are wall clock, from the request to the new state of all shapes, on this machine.
"""
import argparse
import json
import os
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

import numpy

from accuracy import chosen_sets
from examples import add_set_arguments
from program import read_off, run_labels


def check_seconds(labels):
    return 0.31 + 0.03 * labels


def correct_seconds(labels):
    return 5.28 + 0.23 * labels


def reject_seconds(labels):
    return 1.47 + 0.05 * labels


class Session:
    """coseg edit on a run; requests as its page makes them."""

    def __init__(self, arguments, run):
        self.process = subprocess.Popen(["mpirun", "--oversubscribe", "-n", str(arguments.ranks), arguments.coseg, "edit", "--quiet", run],
                                        stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address.startswith("http"):
            sys.exit(f"effort: coseg edit {run} does not serve")
        self.state = self.ask("state")

    def ask(self, path, body=None):
        data = None if body is None else body.encode()
        try:
            with urllib.request.urlopen(urllib.request.Request(self.address + path, data=data), timeout=600) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            sys.exit(f"effort: {path}: {error.read().decode()}")

    def act(self, act):
        begin = time.perf_counter()
        self.state = self.ask(f"act?revision={self.state['revision']}", json.dumps(act))
        return time.perf_counter() - begin

    def labels(self, shape):
        runs = [run.partition("*") for run in self.ask(f"labels/{shape}")["labels"].split(",")]
        return numpy.repeat([int(label) for label, _, _ in runs], [int(count or 1) for _, _, count in runs])

    def end(self):
        self.ask("end", "")
        self.process.wait(timeout=60)


def runs_of(labels):
    ends = numpy.flatnonzero(numpy.diff(labels)) + 1
    begins = numpy.concatenate(([0], ends))
    counts = numpy.diff(numpy.concatenate((begins, [len(labels)])))
    return ",".join(f"{labels[b]}*{c}" for b, c in zip(begins, counts))


def face_areas(path):
    """Of the polygons of an OFF file, as shares of the whole."""
    points, faces = read_off(path)
    place = numpy.array(points)
    areas = []
    for face in faces:
        corner = place[list(face)]
        areas.append(0.5 * numpy.linalg.norm(sum(numpy.cross(corner[k] - corner[0], corner[k + 1] - corner[0])
                                                 for k in range(1, len(face) - 1))))
    return numpy.array(areas) / sum(areas)


class Truth:
    """The labels of all shapes, as numbers of the run's parts."""

    def __init__(self, sample, session):
        paths = [os.path.join(path, name) for path in sample["meshes"] if os.path.isdir(path) for name in os.listdir(path)]
        by_name = {os.path.splitext(os.path.basename(path))[0]: path
                   for path in paths + sample["meshes"] if path.endswith(".off")}
        self.area, self.label = [], []
        for shape in session.state["shapes"]:
            self.area.append(face_areas(by_name[shape["name"]]))
            self.label.append(numpy.loadtxt(os.path.join(sample["truth"], shape["name"] + ".seg"), dtype=int))
        values = sorted(set(int(v) for labels in self.label for v in numpy.unique(labels)))
        self.label = [numpy.searchsorted(values, labels) for labels in self.label]
        self.count = len(values)

    def rename(self, shown):
        """Numbers the labels as the parts that have most of them."""
        from scipy.optimize import linear_sum_assignment
        common = numpy.zeros((self.count, self.count))
        for area, label, part in zip(self.area, self.label, shown):
            numpy.add.at(common, (label, part), area)
        labels, parts = linear_sum_assignment(-common)
        number = numpy.zeros(self.count, int)
        number[labels] = parts
        self.label = [number[label] for label in self.label]

    def accuracy(self, shown):
        return 100 * statistics.mean(float(a[t == p].sum()) for a, t, p in zip(self.area, self.label, shown))


def looked_at(truth, shape, shown, arguments):
    """The labels that the person leaves, and the seconds that this takes."""
    area, wanted = truth.area[shape], truth.label[shape]
    seconds, wrong = 0.0, []
    for part in numpy.union1d(shown, wanted):
        if area[(shown == part) != (wanted == part)].sum() > arguments.tolerance:
            wrong.append(part)
            seconds += correct_seconds(truth.count)
        else:
            seconds += check_seconds(truth.count)
    if wrong:
        seconds += reject_seconds(truth.count)
    return numpy.where(numpy.isin(wanted, wrong) | numpy.isin(shown, wrong), wanted, shown), seconds


def next_shape(rule, session, order):
    shapes = session.state["shapes"]
    if rule == "active":
        return session.ask("next")["shape"]
    left = [number for number in order if not shapes[number]["confirmed"]]
    if not left:
        return -1
    return left[0] if rule == "random" else min(left, key=lambda number: shapes[number]["confidence"])


def simulate(arguments, sample, run, rule):
    corrections = os.path.join(run, "corrections.json")
    if os.path.exists(corrections):
        os.remove(corrections)
    session = Session(arguments, run)
    shown = [session.labels(number) for number in range(len(session.state["shapes"]))]
    truth = Truth(sample, session)
    if len(session.state["parts"]) != truth.count:
        sys.exit(f"effort: {len(session.state['parts'])} parts, but {truth.count} labels")
    truth.rename(shown)
    order = list(range(len(shown)))
    random.Random("effort").shuffle(order)
    seconds = truth.count * check_seconds(truth.count)
    rows, acts = [{"minutes": 0.0, "shapes": 0, "accuracy": truth.accuracy(shown)}], []
    stale = set()
    while seconds < 60 * arguments.minutes:
        shape = next_shape(rule, session, order)
        if shape < 0:
            break
        if shape in stale:
            shown[shape] = session.labels(shape)
            stale.discard(shape)
        labels, spent = looked_at(truth, shape, shown[shape], arguments)
        seconds += spent
        acts.append(session.act({"act": "confirm", "shape": session.state["shapes"][shape]["name"], "labels": runs_of(labels)}))
        shown[shape] = labels
        stale |= set(session.state["changed"]) - {shape}
        if len(acts) % arguments.measure == 0:
            for number in stale:
                shown[number] = session.labels(number)
            stale.clear()
            rows.append({"minutes": seconds / 60, "shapes": len(acts), "accuracy": truth.accuracy(shown)})
            if rows[-1]["accuracy"] >= arguments.target:
                break
    session.end()
    return {"shapes": len(shown), "labels": truth.count, "rows": rows, "act_seconds": acts}


def minutes_to(rows, accuracy):
    """The first row that has it, "-" if none has."""
    found = next((row for row in rows if row["accuracy"] >= accuracy), None)
    return f"{found['minutes']:.1f} ({found['shapes']})" if found else "-"


def accuracy_at(rows, minutes):
    reached = [row for row in rows if row["minutes"] <= minutes]
    return f"{reached[-1]['accuracy']:.1f}"


def table(results):
    lines = ["| set (L, shapes) | rule | at first | after 2 min | 5 min | 10 min | last (min) | 90 %: min (shapes) | 95 % | 98 % | act: median, most s |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for name, rules in results.items():
        for rule, result in rules.items():
            rows, acts = result["rows"], result["act_seconds"] or [0.0]
            lines.append(f"| {name} ({result['labels']}, {result['shapes']}) | {rule} | {rows[0]['accuracy']:.1f} | {accuracy_at(rows, 2)} | "
                         f"{accuracy_at(rows, 5)} | {accuracy_at(rows, 10)} | {rows[-1]['accuracy']:.1f} ({rows[-1]['minutes']:.1f}) | "
                         f"{minutes_to(rows, 90)} | {minutes_to(rows, 95)} | {minutes_to(rows, 98)} | "
                         f"{statistics.median(acts):.2f}, {max(acts):.2f} |")
    return "\n".join(lines)


def measure(arguments, sample, work):
    run = os.path.join(work, "run")
    run_labels(arguments, sample["parts"], run,
               ["--seed", arguments.seed, "--state", os.path.join(work, "state"), *sample["meshes"]])
    return {rule: simulate(arguments, sample, run, rule) for rule in arguments.rules}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_set_arguments(parser)
    parser.add_argument("--rules", nargs="+", default=["active", "random"], choices=["active", "doubt", "random"])
    parser.add_argument("--generated", nargs="+", metavar=("SHAPES", "FAMILY"))
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--target", type=float, default=98.0)
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--measure", type=int, default=1, help="shapes between two measurements of the accuracy")
    parser.add_argument("--out", default="effort.json")
    parser.add_argument("--scratch", help="folder for the runs and their state, kept; without it they are made in a temporary one")
    arguments = parser.parse_args()
    results = {}
    with tempfile.TemporaryDirectory() as scratch:
        for name, sample in chosen_sets(arguments, scratch).items():
            work = os.path.join(arguments.scratch or scratch, name)
            os.makedirs(work, exist_ok=True)
            results[name] = measure(arguments, sample, work)
            if not arguments.scratch:
                shutil.rmtree(work)
            print("\n".join(table({name: results[name]}).splitlines()[2:]), flush=True)
            with open(arguments.out, "w") as file:
                json.dump(results, file, indent=1)
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write(table(results) + "\n")
    print(table(results))


if __name__ == "__main__":
    main()
