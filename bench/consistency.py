#!/usr/bin/env python3
"""Consistency of labels over shapes that have landmarks, and agreement of runs with different seeds.

usage: bench/consistency.py FOLDER [--coseg build/bin/coseg] [--parts 3 4 5 6 8] [--seeds 1 2 3] [--ranks 2]
                            [--state DIR] [--table FILE] [--landmarks] [-- OPTION ...]

FOLDER holds meshes (OFF, triangles) and may hold NAME.landmarks for each: lines "NUMBER X Y Z", where a number means the
same point in every shape; lines with # are comments. A landmark has the label of the nearest face. A pair of a shape and a
landmark agrees if its label is the one that most shapes have at this landmark. For each number of parts and seed a row
has, in percent:

    agree           pairs that agree: the mean over landmarks, and the least of a landmark
    within 2, 5 %   pairs that agree, or that have a face with the landmark's label so near: along the surface, of the
                    diagonal of the shape's bounding box
    one label       what would agree if all shapes had the parts' shares at random: sum of the squared shares of the labels
                    over all pairs. Few parts agree more easily

With several seeds a second table has the agreement of each two runs with the same number of parts, over the area of all
shapes together: one to one (parts renamed by the best assignment) and adjusted Rand index, as means and least over the
pairs of runs. It needs no landmarks. --landmarks also prints the landmarks and the shapes that agree least. Words behind
-- are options of `coseg run`. With --state, or a second call with the same --state, descriptions are made once a seed.
"""
import argparse
import collections
import itertools
import os
import statistics
import sys
import tempfile

import numpy
import scipy.optimize
import scipy.sparse
import scipy.spatial

from program import PROGRAM, markdown, parsed_with_options, read_labels, read_off, run_labels, write_whole

NEAR = (0.02, 0.05)
NEAREST_CENTROIDS = 60


class Shape:
    """A mesh with what is asked of it. `faces` are triangles, 3 ids each."""

    def __init__(self, folder, name):
        self.name = name
        self.points, self.faces = read_triangles(os.path.join(folder, name + ".off"))
        corners = self.points[self.faces]
        self.centroids = corners.mean(axis=1)
        self.areas = 0.5 * numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        self.diagonal = numpy.linalg.norm(self.points.max(axis=0) - self.points.min(axis=0))
        self.face_of = {}
        path = os.path.join(folder, name + ".landmarks")
        if os.path.exists(path):
            marks = read_landmarks(path)
            tree = scipy.spatial.cKDTree(self.centroids)
            for number, point in marks.items():
                near = tree.query(point, min(NEAREST_CENTROIDS, len(self.faces)))[1]
                self.face_of[number] = near[numpy.argmin(distances_to_triangles(point, corners[near]))]

    def dual_graph(self):
        """Faces that share an edge, weighted by the distance of their centroids."""
        same_point = numpy.unique(self.points, axis=0, return_inverse=True)[1].reshape(-1)
        edges = numpy.sort(same_point[self.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)], axis=1)
        face = numpy.repeat(numpy.arange(len(self.faces)), 3)
        order = numpy.lexsort((edges[:, 1], edges[:, 0]))
        same = numpy.all(edges[order[1:]] == edges[order[:-1]], axis=1)
        a, b = face[order[:-1]][same], face[order[1:]][same]
        weight = numpy.linalg.norm(self.centroids[a] - self.centroids[b], axis=1) + 1e-12
        return scipy.sparse.coo_matrix((weight, (a, b)), shape=(len(self.faces),) * 2).tocsr()

    def distances(self, face):
        """From the face to all others along the surface, as shares of the diagonal."""
        return scipy.sparse.csgraph.dijkstra(self.dual_graph(), directed=False, indices=face) / self.diagonal


def read_triangles(path):
    points, faces = read_off(path)
    if any(len(face) != 3 for face in faces):
        sys.exit(f"consistency: {path} has faces that are no triangles")
    return numpy.array(points), numpy.array(faces)


def read_landmarks(path):
    marks = {}
    with open(path) as file:
        for line in file:
            words = line.split()
            if words and not words[0].startswith("#"):
                marks[int(words[0])] = numpy.array([float(x) for x in words[1:4]])
    return marks


def distances_to_triangles(point, triangles):
    """From a point to each of n x 3 x 3 corners: to the plane where the foot is inside, else to the nearest edge."""
    best = numpy.full(len(triangles), numpy.inf)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        start, along = triangles[:, a], triangles[:, b] - triangles[:, a]
        length = numpy.maximum((along ** 2).sum(axis=1), 1e-300)
        share = numpy.clip(((point - start) * along).sum(axis=1) / length, 0.0, 1.0)
        best = numpy.minimum(best, numpy.linalg.norm(start + share[:, None] * along - point, axis=1))
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sides = [(numpy.cross(triangles[:, b] - triangles[:, a], point - triangles[:, a]) * normals).sum(axis=1)
             for a, b in ((0, 1), (1, 2), (2, 0))]
    inside = numpy.all(numpy.array(sides) >= 0.0, axis=0)
    heights = numpy.abs(((point - triangles[:, 0]) * normals).sum(axis=1)) / numpy.maximum(
        numpy.linalg.norm(normals, axis=1), 1e-300)
    return numpy.where(inside, heights, best)


def segment(arguments, parts, seed, out, words):
    """The labels of every shape, by name, of a run with these further options and meshes."""
    run_labels(arguments, parts, out, ["--seed", seed, *words])
    folder = os.path.join(out, "labels")
    return {file[:-4]: numpy.array(read_labels(os.path.join(folder, file))) for file in os.listdir(folder) if file.endswith(".seg")}


def landmark_pairs(shapes, labels):
    """The label of each (landmark, shape), and the label that most shapes have at each landmark."""
    found = {(number, shape.name): labels[shape.name][face] for shape in shapes for number, face in shape.face_of.items()}
    by_landmark = collections.defaultdict(list)
    for (number, _), label in found.items():
        by_landmark[number].append(label)
    # Of labels that are equally frequent the lowest.
    usual = {number: min(set(of), key=lambda label: (-of.count(label), label)) for number, of in by_landmark.items()}
    return found, usual


def landmark_figures(shapes, labels):
    found, usual = landmark_pairs(shapes, labels)
    shape_of = {shape.name: shape for shape in shapes}
    agree, distance = collections.defaultdict(list), {}
    for (number, name), label in found.items():
        agree[number].append(label == usual[number])
        if label != usual[number]:
            shape = shape_of[name]
            there = shape.distances(shape.face_of[number])[labels[name] == usual[number]]
            distance[number, name] = there.min() if there.size else numpy.inf
    shares = numpy.array(list(collections.Counter(found.values()).values())) / len(found)
    return {"agree": 100.0 * (1.0 - len(distance) / len(found)),
            "least": 100.0 * min(statistics.fmean(of) for of in agree.values()),
            "near": [100.0 * (1.0 - sum(d > near for d in distance.values()) / len(found)) for near in NEAR],
            "chance": 100.0 * float((shares ** 2).sum()), "found": found, "usual": usual, "distance": distance}


def print_least(figures):
    """The landmarks and the shapes with the most pairs that do not agree, with the farthest distance to the label."""
    for which, title in ((0, "landmark"), (1, "shape")):
        missed = collections.defaultdict(list)
        for pair, distance in figures["distance"].items():
            missed[pair[which]].append((distance, pair[1 - which], figures["found"][pair], figures["usual"][pair[0]]))
        for key, of in sorted(missed.items(), key=lambda item: (-len(item[1]), str(item[0])))[:12]:
            words = ", ".join(f"{other} {label} for {usual} at {100.0 * distance:.0f} %"
                              for distance, other, label, usual in sorted(of, reverse=True, key=lambda m: m[0])[:6])
            print(f"    {title} {key}: {len(of)} do not agree: {words}")


def agreement(shapes, first, second):
    """One-to-one agreement in percent and adjusted Rand index of two runs, by area; shapes count alike."""
    size = 1 + max(max(of.max() for of in run.values()) for run in (first, second))
    table = numpy.zeros((size, size))
    for shape in shapes:
        weights = shape.areas / shape.areas.sum() / len(shapes)
        numpy.add.at(table, (first[shape.name], second[shape.name]), weights)
    rows, columns = scipy.optimize.linear_sum_assignment(-table)
    joint, a, b = (table ** 2).sum(), (table.sum(axis=1) ** 2).sum(), (table.sum(axis=0) ** 2).sum()
    most = 0.5 * (a + b)
    return 100.0 * table[rows, columns].sum(), (joint - a * b) / (most - a * b) if most > a * b else 1.0


def measure(arguments, shapes, work):
    landmark_rows = [["parts", "seed", "agree", "least landmark"] + [f"within {100 * near:.0f} %" for near in NEAR] + ["one label"]]
    agreement_rows = [["parts", "pairs of runs", "one to one, mean", "least", "adjusted Rand, mean", "least"]]
    for parts in arguments.parts:
        runs = []
        for seed in arguments.seeds:
            words = ["--state", arguments.state, *arguments.options, arguments.folder]
            runs.append(segment(arguments, parts, seed, os.path.join(work, "out"), words))
            if not shapes[0].face_of:
                continue
            figures = landmark_figures(shapes, runs[-1])
            landmark_rows.append([str(parts), str(seed)] + [f"{figures[key]:.1f}" for key in ("agree", "least")] +
                                 [f"{near:.1f}" for near in figures["near"]] + [f"{figures['chance']:.1f}"])
            print("| " + " | ".join(landmark_rows[-1]) + " |", flush=True)
            if arguments.landmarks:
                print_least(figures)
        pairs = [agreement(shapes, a, b) for a, b in itertools.combinations(runs, 2)]
        if pairs:
            agreement_rows.append([str(parts), str(len(pairs))] + [f"{pick(p[0] for p in pairs):.1f}" for pick in (statistics.fmean, min)] +
                                  [f"{pick(p[1] for p in pairs):.3f}" for pick in (statistics.fmean, min)])
            print("runs: | " + " | ".join(agreement_rows[-1]) + " |", flush=True)
    return [rows for rows in (landmark_rows, agreement_rows) if len(rows) > 1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--parts", nargs="+", type=int, default=[3, 4, 5, 6, 8])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--state", help="state folder of the runs, kept; else one that is removed at the end")
    parser.add_argument("--landmarks", action="store_true")
    parser.add_argument("--table")
    arguments, arguments.options = parsed_with_options(parser)
    names = sorted(file[:-4] for file in os.listdir(arguments.folder) if file.endswith(".off"))
    if len(names) < 2:
        sys.exit(f"consistency: fewer than two OFF files in {arguments.folder}")
    shapes = [Shape(arguments.folder, name) for name in names]
    with tempfile.TemporaryDirectory() as work:
        arguments.state = arguments.state or os.path.join(work, "state")
        tables = measure(arguments, shapes, work)
    if arguments.table:
        write_whole(arguments.table, "\n".join(markdown(rows) for rows in tables))
    return 0


if __name__ == "__main__":
    sys.exit(main())
