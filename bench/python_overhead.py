#!/usr/bin/env python3
"""Measures what coseg.segment in Python takes beside `coseg run`, and whether many calls keep memory.

usage: python_overhead.py COSEG FOLDER PARTS [--repeat N]     whole processes on one rank, alternately; medians in seconds
       python_overhead.py --memory CALLS                      resident memory over calls on small shapes, in MiB

PYTHONPATH must lead to the module. Both are given the mesh files of FOLDER; Python reads them into arrays first. Labels
must be equal.
"""
import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

SCRIPT = """
import sys, time
import coseg, numpy, os
start = time.process_time()
files = coseg.mesh_files(sys.argv[1])
meshes = [coseg.load_mesh(path) for path in files]
names = [os.path.splitext(os.path.basename(path))[0] for path in files]
read = time.process_time()
result = coseg.segment(meshes, int(sys.argv[2]), names=names)
done = time.process_time()
for name, labels in zip(names, result.labels):
    numpy.savetxt(os.path.join(sys.argv[3], name + ".seg"), labels, fmt="%d")
print(start, read - start, done - read)
"""


def timed(words, **more):
    """Seconds of the wall clock and of the processor, which other work on the machine disturbs less; and what was printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    answer = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True, **more)
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, answer.stdout


def overhead(arguments):
    environment = {**os.environ, "COSEG_RANKS": "1"}
    rows = {key: [] for key in ("program", "program cpu", "python", "python cpu", "import", "read", "call")}
    with tempfile.TemporaryDirectory() as work:
        for _ in range(arguments.repeat):
            seconds, cpu, _ = timed([arguments.coseg, "run", "--quiet", "--force", "--no-sheet", "--no-html", "--parts",
                                     arguments.parts, "--out", work + "/run", arguments.folder], env=environment)
            rows["program"].append(seconds)
            rows["program cpu"].append(cpu)
            os.makedirs(work + "/python", exist_ok=True)
            seconds, cpu, told = timed([sys.executable, "-c", SCRIPT, arguments.folder, arguments.parts,
                                        work + "/python"], env=environment)
            rows["python"].append(seconds)
            rows["python cpu"].append(cpu)
            for key, value in zip(("import", "read", "call"), told.split()):
                rows[key].append(float(value))
        for name in sorted(os.listdir(work + "/run/labels")):
            with open(f"{work}/run/labels/{name}", "rb") as own, open(f"{work}/python/{name}", "rb") as other:
                if own.read() != other.read():
                    sys.exit(f"labels of {name} differ")
    medians = {key: statistics.median(values) for key, values in rows.items()}
    for key, name in (("program", "coseg run"), ("python", "python process")):
        print(f"{name:15s} {medians[key]:8.2f} s of the clock ({min(rows[key]):.2f} to {max(rows[key]):.2f}), "
              f"{medians[key + ' cpu']:8.2f} s of the processor")
    print(f"  of the processor: importing {medians['import']:.2f} s, reading files {medians['read']:.2f} s, "
          f"coseg.segment {medians['call']:.2f} s, the rest is writing labels as text")
    print(f"overhead of reading and coseg.segment over the whole program, by the processor: "
          f"{100 * ((medians['read'] + medians['call']) / medians['program cpu'] - 1):.1f} %")
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
    parser.add_argument("--repeat", type=int, default=3)
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
