#!/usr/bin/env python3
"""Measures what a process of Python takes beside `coseg run`, and whether many calls keep memory.

usage: python_overhead.py COSEG FOLDER PARTS [--repeat N]     whole processes on one rank, in pairs; ratios of the pairs
       python_overhead.py --memory CALLS                      resident memory over calls on small shapes, in MiB

PYTHONPATH must lead to the module. Both are given the mesh files of FOLDER, and both write a folder of results; Python
reads the files into arrays first. The order within a pair changes from pair to pair. Labels must be equal.
"""
import argparse
import os
import statistics
import sys
import tempfile

from program import timed

SCRIPT = """
import sys, time
import coseg, os
start = time.process_time()
files = coseg.mesh_files(sys.argv[1])
meshes = [coseg.load_mesh(path) for path in files]
names = [os.path.splitext(os.path.basename(path))[0] for path in files]
read = time.process_time()
coseg.segment(meshes, int(sys.argv[2]), names=names, out=sys.argv[3], replace=True, sheet=False, html=False)
print(start, read - start)
"""


def summary(values):
    return f"{statistics.median(values):8.3f} ({min(values):.3f} to {max(values):.3f})"


def overhead(arguments):
    environment = {**os.environ, "COSEG_RANKS": "1"}
    rows = {key: [] for key in ("clock", "processor", "program", "python", "import", "read")}
    with tempfile.TemporaryDirectory() as work:
        program = [arguments.coseg, "run", "--quiet", "--force", "--no-sheet", "--no-html", "--parts", arguments.parts, "--out",
                   work + "/run", arguments.folder]
        python = [sys.executable, "-c", SCRIPT, arguments.folder, arguments.parts, work + "/python"]
        for pair in range(arguments.repeat):
            taken = {}
            for words in (program, python) if pair % 2 == 0 else (python, program):
                taken[words[0]] = timed(words, environment)
            own, other = taken[program[0]], taken[python[0]]
            rows["clock"].append(other[0] / own[0])
            rows["processor"].append(other[1] / own[1])
            rows["program"].append(own[1])
            rows["python"].append(other[1])
            for key, value in zip(("import", "read"), other[2].split()):
                rows[key].append(float(value))
            print(f"pair {pair + 1}: coseg run {own[0]:.2f} s of the clock, {own[1]:.2f} s of the processor; "
                  f"Python {other[0]:.2f} and {other[1]:.2f} s", flush=True)
        for name in sorted(os.listdir(work + "/run/labels")):
            with open(f"{work}/run/labels/{name}", "rb") as own, open(f"{work}/python/labels/{name}", "rb") as other:
                if own.read() != other.read():
                    sys.exit(f"labels of {name} differ")
    print(f"Python over the program, median (and range) of the pairs: by the processor{summary(rows['processor'])}, "
          f"by the clock{summary(rows['clock'])}")
    print(f"  of the processor: starting and importing {statistics.median(rows['import']):.2f} s, reading files into arrays "
          f"{statistics.median(rows['read']):.2f} s")
    print("labels are equal")


def memory(calls):
    import coseg
    shapes = coseg.generate("table", 3, faces=600)

    def resident():
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2 ** 20
    for k in range(calls + 1):
        if k % max(calls // 10, 1) == 0:
            print(f"{k:6d} calls {resident():8.1f} MiB", flush=True)
        coseg.segment(shapes, 2, patches=6, geodesic_samples=20, oversegmentations=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("coseg", nargs="?")
    parser.add_argument("folder", nargs="?")
    parser.add_argument("parts", nargs="?")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--memory", type=int, metavar="CALLS")
    arguments = parser.parse_args()
    if arguments.memory:
        memory(arguments.memory)
    elif arguments.parts:
        overhead(arguments)
    else:
        parser.error("give COSEG FOLDER PARTS, or --memory CALLS")


if __name__ == "__main__":
    main()
