#!/usr/bin/env python3
"""Reads the results of `coseg run --keep-features` with numpy and h5py and prints how large each part of each shape is.

usage: read_results.py RESULT
"""
import json
import sys

import h5py
import numpy

if len(sys.argv) != 2:
    sys.exit("usage: read_results.py RESULT")
result = sys.argv[1]
report = json.load(open(f"{result}/report.json"))
for mesh in report["meshes"]:
    part = numpy.loadtxt(f"{result}/labels/{mesh['name']}.seg", dtype=int)
    faces = numpy.bincount(part, minlength=report["options"]["parts"])
    print(mesh["name"], " ".join(f"part {p}: {n} faces" for p, n in enumerate(faces)))
with h5py.File(f"{result}/features.h5") as file:
    for name, matrix in file["features"].items():
        print(name, matrix.shape, f"mean {numpy.mean(matrix):.4f}")
