#!/usr/bin/env python3
"""What it takes to read one mesh from each kind of file: seconds of CPU, and the memory at its peak.

    bench/reading.py --bench build/bin/mesh_reading_bench [--other OTHER/bin/mesh_reading_bench] [--faces 1000000]
                     [--rounds 5] [--out reading.json] [--table reading.md] [--scratch DIR]

A torus of about --faces triangles is written in every format with 9 digits, then read --rounds times: medians of
seconds, and the largest peak. --other is the same program of another build, which takes turns with the first.
Build with -DCOSEG_BUILD_BENCH=ON. Nothing here is a test.
"""
import argparse
import array
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile


def torus(faces):
    """Points and triangles."""
    around = max(3, round(math.sqrt(faces)))
    across = max(3, round(faces / 2 / around))
    points = []
    for i in range(around):
        u = 2 * math.pi * i / around
        for j in range(across):
            v = 2 * math.pi * j / across
            r = 1 + 0.4 * math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), 0.4 * math.sin(v)))
    triangles = []
    for i in range(around):
        k = (i + 1) % around
        for j in range(across):
            l = (j + 1) % across
            a, b, c, d = i * across + j, k * across + j, k * across + l, i * across + l
            triangles += [(a, b, c), (a, c, d)]
    return points, triangles


def write_off(file, points, triangles):
    file.write(f"OFF\n{len(points)} {len(triangles)} 0\n".encode())
    file.writelines(b"%.9g %.9g %.9g\n" % p for p in points)
    file.writelines(b"3 %d %d %d\n" % t for t in triangles)


def write_obj(file, points, triangles):
    file.writelines(b"v %.9g %.9g %.9g\n" % p for p in points)
    file.writelines(b"f %d %d %d\n" % (a + 1, b + 1, c + 1) for a, b, c in triangles)


def ply_header(kind, points, triangles):
    return (f"ply\nformat {kind} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n").encode()


def write_ply_text(file, points, triangles):
    file.write(ply_header("ascii", points, triangles))
    file.writelines(b"%.9g %.9g %.9g\n" % p for p in points)
    file.writelines(b"3 %d %d %d\n" % t for t in triangles)


def write_ply_binary(file, points, triangles):
    file.write(ply_header(f"binary_{sys.byteorder}_endian", points, triangles))
    for p in points:
        file.write(array.array("f", p).tobytes())
    for t in triangles:
        file.write(b"\3" + array.array("i", t).tobytes())


def write_stl_text(file, points, triangles):
    file.write(b"solid torus\n")
    for t in triangles:
        corners = b"".join(b"vertex %.9g %.9g %.9g\n" % points[k] for k in t)
        file.write(b"facet normal 0 0 0\nouter loop\n" + corners + b"endloop\nendfacet\n")
    file.write(b"endsolid torus\n")


def write_stl_binary(file, points, triangles):
    """The format is little-endian."""
    def little(code, values):
        numbers = array.array(code, values)
        if sys.byteorder == "big":
            numbers.byteswap()
        return numbers.tobytes()

    file.write(bytes(80) + little("I", [len(triangles)]))
    for a, b, c in triangles:
        file.write(little("f", (0, 0, 0) + points[a] + points[b] + points[c]) + b"\0\0")


WRITERS = {
    "text.off": write_off,
    "text.obj": write_obj,
    "text.ply": write_ply_text,
    "binary.ply": write_ply_binary,
    "text.stl": write_stl_text,
    "binary.stl": write_stl_binary,
}


def made_files(folder, faces):
    points, triangles = torus(faces)
    files = []
    for name, write in WRITERS.items():
        files.append(folder / name)
        with open(files[-1], "wb") as file:
            write(file, points, triangles)
    return files


def readings(bench, files):
    result = subprocess.run([str(bench), *map(str, files)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"reading.py: {bench} ended with {result.returncode}: {result.stderr.strip()}")
    return json.loads(result.stdout)


def measured(benches, files, rounds):
    """One record a file; seconds and peaks in the order of the benches."""
    rows = [[readings(bench, files) for bench in benches] for _ in range(rounds)]
    records = []
    for k, file in enumerate(files):
        runs = [[row[b][k] for row in rows] for b in range(len(benches))]
        records.append({
            "file": file.name,
            "mib": file.stat().st_size / 2**20,
            "vertices": runs[0][0]["vertices"],
            "faces": runs[0][0]["faces"],
            "seconds": [statistics.median(run["seconds"] for run in of_bench) for of_bench in runs],
            "peak_mib": [max(run["peak_mib"] for run in of_bench) for of_bench in runs],
        })
    return records


def table(records):
    builds = len(records[0]["seconds"])
    names = [""] if builds == 1 else ["", ", other"]
    yield "| file | MiB |" + "".join(f" seconds{name} |" for name in names) + "".join(f" peak MiB{name} |" for name in names)
    yield "| --- |" + " ---: |" * (1 + 2 * builds)
    for record in records:
        yield (f"| {record['file']} | {record['mib']:.0f} |" + "".join(f" {value:.2f} |" for value in record["seconds"])
               + "".join(f" {value:.0f} |" for value in record["peak_mib"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", type=pathlib.Path, required=True)
    parser.add_argument("--other", type=pathlib.Path)
    parser.add_argument("--faces", type=int, default=1000000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--scratch", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.scratch) as scratch:
        files = made_files(pathlib.Path(scratch), options.faces)
        records = measured([bench for bench in (options.bench, options.other) if bench], files, options.rounds)
    lines = "\n".join(table(records)) + "\n"
    print(lines, end="")
    if options.table:
        options.table.write_text(lines, encoding="utf-8")
    if options.out:
        options.out.write_text(json.dumps(records, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
