#!/usr/bin/env python3
"""How far aligned shapes are from the orientations that they are known to have, and what the alignment does for the labels.

usage: bench/alignment.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--generated FAMILY ...] [--shapes 12]
                          [--seed 1] [--ranks 2] [--labels] [--table FILE]

Every shape of a set is turned at random (a hash of its name), and the set is run with `--align auto`. Taken together, the
rotation of alignment.json and the known turn are one rotation of the file as it was; where the files stand alike, it is the
same for all shapes. The error of a shape is the angle between its own and that of the shape for which the median is smallest.
A shape that is symmetric has several right answers: the error is the smallest over the rotations of the shape onto itself.
A rotation about an axis of the file, by a multiple of 5 degrees, is one if turned points lie, on the mean, within 3 % of the
size from the shape, and its points from turned ones.

With --labels the accuracies of the set as it is, turned, and turned with `--align off` follow, in percent.
"""
import argparse
import json
import math
import os
import statistics
import sys
import tempfile

from accuracy import find_sets, generated_sets, random_rotation, turned_sets
from program import PROGRAM, markdown, one_to_one, read_off, run_labels


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def angle(a, b):
    """In degrees, between two rotations."""
    trace = sum(a[i][j] * b[i][j] for i in range(3) for j in range(3))
    return math.degrees(math.acos(max(-1.0, min(1.0, 0.5 * (trace - 1.0)))))


def about_axis(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = [[1.0 if a == b else 0.0 for b in range(3)] for a in range(3)]
    turn[i][i], turn[i][j], turn[j][i], turn[j][j] = c, -s, s, c
    return turn


def read_points(path, most):
    """Vertices of an OFF file, every so many, centred at the middle of the bounding box, with its diagonal as the unit."""
    points, _ = read_off(path)
    low, high = [min(p[a] for p in points) for a in range(3)], [max(p[a] for p in points) for a in range(3)]
    size = math.dist(low, high)
    step = max(1, len(points) // most)
    return [tuple((p[a] - 0.5 * (low[a] + high[a])) / size for a in range(3)) for p in points[::step]]


class Cells:
    """Points in cubes, for nearest distances up to the side of one."""

    def __init__(self, points, side):
        self.side, self.cells = side, {}
        for p in points:
            self.cells.setdefault(self.cell(p), []).append(p)

    def cell(self, p):
        return tuple(int(math.floor(x / self.side)) for x in p)

    def distance(self, p):
        x, y, z = self.cell(p)
        near = [math.dist(p, q) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)
                for q in self.cells.get((x + i, y + j, z + k), ())]
        return min(near, default=self.side)


def symmetries(path):
    """Rotations of the shape onto itself, the identity among them."""
    few, many = read_points(path, 150), read_points(path, 1500)
    whole = Cells(many, 0.1)
    found = [about_axis(0, 0)]
    for axis in range(3):
        for degrees in range(5, 360, 5):
            turn = about_axis(axis, degrees)
            turned = [tuple(sum(turn[a][b] * p[b] for b in range(3)) for a in range(3)) for p in few]
            if sum(map(whole.distance, turned)) < 0.03 * len(few):
                found.append(turn)
    return found


def least_angle(own, other, turns):
    return min(angle(product(own, turn), other) for turn in turns)


def errors(alignment, meshes):
    """Of each shape, in degrees."""
    together = [product(shape["rotation"], random_rotation(shape["name"] + ".off")) for shape in alignment["shapes"]]
    turns = [symmetries(os.path.join(meshes, shape["name"] + ".off")) for shape in alignment["shapes"]]
    best = min(together, key=lambda other: statistics.median(least_angle(own, other, t) for own, t in zip(together, turns)))
    return [least_angle(own, best, t) for own, t in zip(together, turns)]


def run(args, one_set, out, align):
    run_labels(args, one_set["parts"], out, ["--align", align, "--seed", args.seed, *one_set["meshes"]])


def measure(args, name, one_set, scratch):
    turned = next(iter(turned_sets({name: one_set}, scratch).values()))
    out = os.path.join(scratch, name)
    run(args, turned, out, "auto")
    with open(os.path.join(out, "alignment.json")) as file:
        alignment = json.load(file)
    found = errors(alignment, one_set["meshes"][0])
    row = [name, str(len(found)), "yes" if alignment["aligned"] else "no", f"{statistics.median(found):.1f}",
           f"{100.0 * sum(e < 10.0 for e in found) / len(found):.0f} %"]
    if args.labels:
        figures = []
        for given, mode in ((one_set, "auto"), (turned, "auto"), (turned, "off")):
            labels = out + "_labels_" + str(len(figures))
            run(args, given, labels, mode)
            figures.append(f"{one_to_one(args, given['truth'], os.path.join(labels, 'labels'), given['meshes']):.1f}")
        row += figures
    print(" | ".join(row), flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA"))
    parser.add_argument("--sets", nargs="+", default=[])
    parser.add_argument("--generated", nargs="+", default=[], metavar="FAMILY")
    parser.add_argument("--shapes", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--labels", action="store_true")
    parser.add_argument("--table")
    args = parser.parse_args()
    if not args.sets and not args.generated:
        sys.exit("alignment: name sets with --sets, or families with --generated")
    if args.sets and not args.data:
        sys.exit("alignment: give the folder of sets with --data or COSEG_DATA")
    head = ["set", "shapes", "aligned", "median error, degrees", "below 10 degrees"]
    rows = [head + (["accuracy", "turned", "turned, --align off"] if args.labels else [])]
    with tempfile.TemporaryDirectory() as scratch:
        sets = find_sets(args.data, args.sets) if args.sets else {}
        if args.generated:
            sets.update(generated_sets(args.coseg, args.shapes, args.generated, scratch))
        for name, one_set in sets.items():
            rows.append(measure(args, name, one_set, scratch))
    table = markdown(rows)
    print("\n" + table, end="")
    if args.table:
        with open(args.table, "w") as file:
            file.write(table)


if __name__ == "__main__":
    main()
