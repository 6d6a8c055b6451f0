#!/usr/bin/env python3
"""Stability of labels: halves of a collection, faces in another order, shapes turned at random.

usage: bench/stability.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--generated SHAPES [FAMILY ...]]
                          [--seed 1] [--ranks 2] [--cases halves shuffled turned] [--table FILE]

Every labelled set is segmented whole, and then once more for each case:

    halves      every second shape alone, and the others alone
    shuffled    all shapes with their faces in a random order
    turned      all shapes, each turned about its own axis by its own angle

The table has the one-to-one accuracy in percent (mean over the shapes, what `coseg score` prints) of the whole set and of
each case, and how far the labels of the case agree with those of the whole set: share of the area in percent, shapes
alike, with the parts of each run renamed by the best assignment. Halves count together, each renamed by itself. K is the
number of truth labels. Meshes are OFF files of triangles.
"""
import argparse
import os
import random
import statistics
import sys
import tempfile

import numpy

from accuracy import chosen_sets, turn_meshes
from consistency import Shape, agreement, segment
from examples import add_set_arguments
from program import markdown, one_to_one, write_whole

CASES = ("halves", "shuffled", "turned")


def shuffle_off(source, target, order):
    """Writes face order[k] of the source as face k."""
    with open(source) as file:
        lines = [line for line in file.read().split("\n") if line.strip() and not line.lstrip().startswith("#")]
    first = 2 + int(lines[1].split()[0])
    faces = lines[first:first + len(order)]
    with open(target, "w") as file:
        file.write("\n".join(lines[:first] + [faces[k] for k in order]) + "\n")


def face_order(name, count):
    order = list(range(count))
    random.Random("faces of " + name).shuffle(order)
    return order


def run_halves(arguments, folder, shapes, parts, work):
    """Runs of the two halves, each as labels by shape."""
    return [segment(arguments, parts, arguments.seed, os.path.join(work, "out"),
                    [os.path.join(folder, shape.name + ".off") for shape in shapes[first::2]]) for first in (0, 1)]


def run_shuffled(arguments, folder, shapes, parts, work):
    made = os.path.join(work, "shuffled")
    os.makedirs(made)
    for shape in shapes:
        shuffle_off(os.path.join(folder, shape.name + ".off"), os.path.join(made, shape.name + ".off"),
                    face_order(shape.name, len(shape.faces)))
    run = segment(arguments, parts, arguments.seed, os.path.join(work, "out"), [made])
    for name, labels in run.items():
        carried = numpy.empty_like(labels)
        carried[face_order(name, len(labels))] = labels
        run[name] = carried
    return [run]


def run_turned(arguments, folder, shapes, parts, work):
    made = os.path.join(work, "turned")
    turn_meshes(folder, [shape.name + ".off" for shape in shapes], made)
    return [segment(arguments, parts, arguments.seed, os.path.join(work, "out"), [made])]


RUNS = {"halves": run_halves, "shuffled": run_shuffled, "turned": run_turned}


def accuracy_of(arguments, folder, truth, run, work):
    """The accuracy of a run, from its labels in the order of the faces of the set."""
    with tempfile.TemporaryDirectory(dir=work) as labels:
        for name, of_shape in run.items():
            with open(os.path.join(labels, name + ".seg"), "w") as file:
                file.write("\n".join(map(str, of_shape)) + "\n")
        meshes = [os.path.join(folder, name + ".off") for name in sorted(run)]
        return one_to_one(arguments, truth, labels, meshes)


def measure(arguments, sample):
    folder, parts = sample["meshes"][0], sample["parts"]
    shapes = [Shape(folder, file[:-4]) for file in sorted(os.listdir(folder)) if file.endswith(".off")]
    with tempfile.TemporaryDirectory() as work:
        whole = segment(arguments, parts, arguments.seed, os.path.join(work, "out"), [folder])
        row = [f"{accuracy_of(arguments, folder, sample['truth'], whole, work):.1f}"]
        for case in arguments.cases:
            runs = RUNS[case](arguments, folder, shapes, parts, work)
            weights = [len(run) for run in runs]
            scores = [accuracy_of(arguments, folder, sample["truth"], run, work) for run in runs]
            agreements = [agreement([shape for shape in shapes if shape.name in run], whole, run)[0] for run in runs]
            row += [f"{statistics.fmean(values, weights):.1f}" for values in (scores, agreements)]
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_set_arguments(parser)
    parser.add_argument("--generated", nargs="+", metavar=("SHAPES", "FAMILY"))
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        sets = chosen_sets(arguments, scratch)
        rows = [["set", "K", "whole"] + [word for case in arguments.cases for word in (case, "agree")]]
        for name, sample in sets.items():
            rows.append([name, str(sample["parts"])] + measure(arguments, sample))
            print("| " + " | ".join(rows[-1]) + " |", flush=True)
    if arguments.table:
        write_whole(arguments.table, markdown(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
