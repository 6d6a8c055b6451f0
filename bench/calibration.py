#!/usr/bin/env python3
"""How far the confidence of faces can be believed: a reliability table over labelled sets.

usage: bench/calibration.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--seed 1] [--ranks 2]
                            [--examples N] [--table FILE]

Every set is segmented once. The confidence of each face is read from DIR/ply/NAME.ply, and a face is right if its part is
mapped to its true label by the assignment that is best over the set. Sets and shapes count alike, faces by area. For ten
bins of confidence the table has the share of the area, the mean confidence and the share that is right; the calibration
error is the mean over the area of the difference of the last two. --examples N gives N shapes of each set, drawn at
random, as examples, and leaves them out of the table.
"""
import argparse
import itertools
import os
import random
import struct
import sys
import tempfile

from accuracy import find_sets
from examples import add_set_arguments, links
from program import read_labels, run_labels

BINS = 10


def read_ply(path):
    """Areas and confidences of the faces of a PLY that coseg has written."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    if "property float confidence" not in header:
        sys.exit(f"calibration: {path} has no confidence")
    kind = "d" if "property double x" in header else "f"
    count = "i" if "property list int" in header else "B"
    counts = [int(line.split()[2]) for line in header.splitlines() if line.startswith("element")]
    size = struct.calcsize("<3" + kind)
    points = [struct.unpack_from("<3" + kind, data, end + k * size) for k in range(counts[0])]
    at = end + counts[0] * size
    areas, confidences = [], []
    for _ in range(counts[1]):
        (corners,) = struct.unpack_from("<" + count, data, at)
        at += struct.calcsize("<" + count)
        ids = struct.unpack_from(f"<{corners}i", data, at)
        at += 4 * corners + 3
        confidences.append(struct.unpack_from("<f", data, at)[0])
        at += 4
        areas.append(polygon_area([points[i] for i in ids]))
    return areas, confidences


def polygon_area(points):
    a, total = points[0], 0.0
    for b, c in zip(points[1:], points[2:]):
        u = [q - p for p, q in zip(a, b)]
        v = [q - p for p, q in zip(a, c)]
        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        total += 0.5 * sum(x * x for x in cross) ** 0.5
    return total


def best_mapping(gain):
    """The label of each part such that the sum of the gains is largest; at most as many parts as labels."""
    parts, labels = len(gain), len(gain[0])
    orders = itertools.permutations(range(labels), parts)
    return max(orders, key=lambda order: sum(gain[p][order[p]] for p in range(parts)))


def faces_of(out, truth, names):
    """(weight, confidence, part, label) of all faces; the weights of a shape sum to 1 / shapes."""
    faces = []
    for name in names:
        areas, confidences = read_ply(os.path.join(out, "ply", name + ".ply"))
        parts = read_labels(os.path.join(out, "labels", name + ".seg"))
        labels = read_labels(os.path.join(truth, name + ".seg"))
        scale = 1.0 / (sum(areas) * len(names))
        faces += [(area * scale, c, p, t) for area, c, p, t in zip(areas, confidences, parts, labels)]
    return faces


def measure(arguments, sample, work):
    names = sorted(file[:-4] for file in os.listdir(sample["truth"]) if file.endswith(".seg"))
    out = os.path.join(work, "out")
    words = ["--seed", arguments.seed]
    given = random.Random("examples").sample(names, arguments.examples)
    if given:
        words += ["--examples", links(os.path.join(work, "given"), sample["truth"], given)]
    run_labels(arguments, sample["parts"], out, words + sample["meshes"])
    faces = faces_of(out, sample["truth"], [name for name in names if name not in given])
    size = sample["parts"]
    gain = [[0.0] * size for _ in range(size)]
    for weight, _, part, label in faces:
        if label >= 0:
            gain[part][label] += weight
    mapping = best_mapping(gain)
    return [(weight, c, mapping[part] == label) for weight, c, part, label in faces]


def table(faces):
    total = sum(weight for weight, _, _ in faces)
    lines, error = ["| confidence | share of the area | mean confidence | right |", "| --- | --- | --- | --- |"], 0.0
    for k in range(BINS):
        inside = [face for face in faces if min(int(face[1] * BINS), BINS - 1) == k]
        weight = sum(face[0] for face in inside)
        if weight <= 0.0:
            continue
        mean = sum(w * c for w, c, _ in inside) / weight
        right = sum(w for w, _, is_right in inside if is_right) / weight
        error += weight / total * abs(mean - right)
        lines.append(f"| {k / BINS:.1f} to {(k + 1) / BINS:.1f} | {100 * weight / total:.1f} % | {mean:.2f} | {right:.2f} |")
    return "\n".join(lines), error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_set_arguments(parser)
    parser.add_argument("--examples", type=int, default=0)
    arguments = parser.parse_args()
    everything, sets = [], []
    for name, sample in find_sets(arguments.data, arguments.sets).items():
        with tempfile.TemporaryDirectory() as work:
            faces = measure(arguments, sample, work)
        mean = sum(w * c for w, c, _ in faces)
        right = sum(w for w, _, is_right in faces if is_right)
        sets.append(f"| {name} | {mean:.3f} | {right:.3f} | {table(faces)[1]:.3f} |")
        print(sets[-1], flush=True)
        everything += faces
    text, error = table(everything)
    text += f"\n\nCalibration error: {error:.3f}\n\n| set | mean confidence | right | calibration error |\n| --- | --- | --- | --- |\n"
    text += "\n".join(sets) + "\n"
    if arguments.table:
        with open(arguments.table, "w") as file:
            file.write(text)
    print(text)


if __name__ == "__main__":
    main()
