#!/usr/bin/env python3
"""How long `coseg run` takes, side by side with the segmentation that CGAL offers for single shapes.

    bench/speed.py --coseg build/bin/coseg --peer build/bin/cgal_sdf --parts 5 --rounds 5 --json out.json MESHES

Every round runs coseg on --ranks ranks over the folder and then the peer over the same files, split over as many
processes; so both see the same machine, and ratios are taken within a round. Wall seconds are from the start of the
command to its end, from files to written labels (no pictures, no page), CPU seconds what its processes used (ranks
that wait are busy). Each run begins with no results of the one before. Options after `--` go to `coseg run`. Without --peer only coseg is measured.
"""

import argparse
import json
import os
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time


def processor_name():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def build_flags(program):
    """What the CMakeCache.txt beside bin/ says of how a program was compiled; empty if it is elsewhere."""
    cache = program.resolve().parent.parent / "CMakeCache.txt"
    wanted = ("CMAKE_BUILD_TYPE", "CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_RELEASE", "COSEG_NATIVE")
    if not cache.is_file():
        return {}
    flags = {}
    for line in cache.read_text(encoding="utf-8").splitlines():
        name, _, value = line.partition("=")
        name = name.partition(":")[0]
        if name in wanted:
            flags[name] = value
    return flags


def environment():
    """One thread a process, and ranks that may run anywhere and give way when they wait."""
    return os.environ | {
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_hwloc_base_binding_policy": "none",
        "OMPI_MCA_mpi_yield_when_idle": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
    }


def run_together(commands, log):
    """Runs commands at the same time; wall and CPU seconds of all of them."""
    start = time.monotonic()
    running = {}
    for command in commands:
        # wait4 below reaps the process, so Popen is never asked how it ended.
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=environment())
        running[process.pid] = (process, command)
    cpu = 0.0
    for pid, (process, command) in running.items():
        _, status, usage = os.wait4(pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        cpu += usage.ru_utime + usage.ru_stime
        if process.returncode != 0:
            log.seek(0)
            sys.stderr.write(log.read())
            raise SystemExit(f"speed.py: {' '.join(command)} ended with code {process.returncode}")
    return {"wall": time.monotonic() - start, "cpu": cpu}


def split(files, count):
    """Files dealt largest first, each to the process with the fewest bytes so far."""
    shares = [[] for _ in range(count)]
    loads = [0] * count
    for file in sorted(files, key=lambda f: (-f.stat().st_size, f.name)):
        least = loads.index(min(loads))
        shares[least].append(file)
        loads[least] += file.stat().st_size
    return [share for share in shares if share]


class Bench:
    def __init__(self, options, files, scratch):
        self.options = options
        self.files = files
        self.scratch = scratch

    def in_empty_folder(self, name, commands):
        shutil.rmtree(self.scratch / name, ignore_errors=True)
        with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as log:
            return run_together(commands, log)

    def run_coseg(self):
        o = self.options
        command = [o.mpirun, "-n", str(o.ranks), "--oversubscribe", str(o.coseg), "run", "--quiet"]
        command += ["--no-sheet", "--no-html"]  # the peer makes no pictures either
        command += ["--parts", str(o.parts), "--out", str(self.scratch / "coseg"), *o.extra, *map(str, self.files)]
        measured = self.in_empty_folder("coseg", [command])
        with open(self.scratch / "coseg" / "report.json", encoding="utf-8") as file:
            self.report = json.load(file)
        measured["stages"] = {row["stage"]: row["seconds_wall"] for row in self.report["stages"]}
        measured["steps"] = {
            f"{row['stage']}/{step['step']}": step["seconds"]
            for row in self.report["stages"]
            for step in row.get("steps", [])
        }
        return measured

    def run_peer(self):
        commands = []
        for k, share in enumerate(split(self.files, self.options.ranks)):
            commands.append([str(self.options.peer), str(self.scratch / "peer" / str(k)), *map(str, share)])
        return self.in_empty_folder("peer", commands)


def spread(values):
    return {"min": min(values), "median": statistics.median(values), "max": max(values)}


def spread_of(runs, key):
    return spread([run[key] for run in runs])


def table(runs, key):
    names = list(runs[0][key])
    return {name: spread([run[key][name] for run in runs]) for name in names}


def measure(bench):
    o = bench.options
    rounds = []
    for k in range(o.rounds):
        one = {"coseg": bench.run_coseg()}
        if o.peer:
            one["peer"] = bench.run_peer()
            one["wall_ratio"] = one["coseg"]["wall"] / one["peer"]["wall"]
            one["cpu_ratio"] = one["coseg"]["cpu"] / one["peer"]["cpu"]
        rounds.append(one)
        print_round(k, one)
    coseg = [r["coseg"] for r in rounds]
    report = bench.report
    result = {
        "format": "coseg speed 1",
        "processor": processor_name(),
        "cores": os.cpu_count(),
        "load_before": bench.load_before,
        "versions": report["versions"],
        "build": build_flags(o.coseg),
        "ranks": o.ranks,
        "parts": o.parts,
        "options": o.extra,
        "meshes": len(report["meshes"]),
        "faces": sum(mesh["faces"] for mesh in report["meshes"]),
        "rounds": rounds,
        "coseg": {"wall": spread_of(coseg, "wall"), "cpu": spread_of(coseg, "cpu")},
        "stages": table(coseg, "stages"),
        "steps": table(coseg, "steps"),
    }
    if o.peer:
        peer = [r["peer"] for r in rounds]
        result["peer"] = {"wall": spread_of(peer, "wall"), "cpu": spread_of(peer, "cpu")}
        result["peer_build"] = build_flags(o.peer)
        result["wall_ratio"] = spread_of(rounds, "wall_ratio")
        result["cpu_ratio"] = spread_of(rounds, "cpu_ratio")
    return result


def print_round(k, one):
    text = f"round {k + 1}: coseg {one['coseg']['wall']:.2f} s, CPU {one['coseg']['cpu']:.2f} s"
    if "peer" in one:
        text += f"; peer {one['peer']['wall']:.2f} s, CPU {one['peer']['cpu']:.2f} s"
        text += f"; ratio {one['wall_ratio']:.3f}, CPU {one['cpu_ratio']:.3f}"
    print(text, flush=True)


def print_rows(title, rows, digits=2):
    print(f"\n{title:<28} {'min':>8} {'median':>8} {'max':>8}")
    for name, s in rows.items():
        print(f"{name:<28} {s['min']:8.{digits}f} {s['median']:8.{digits}f} {s['max']:8.{digits}f}")


def print_summary(result):
    print(f"\n{result['meshes']} meshes, {result['faces']} faces, {result['ranks']} ranks on {result['processor']}")
    rows = {"coseg, wall": result["coseg"]["wall"], "coseg, CPU": result["coseg"]["cpu"]}
    if "peer" in result:
        rows |= {"peer, wall": result["peer"]["wall"], "peer, CPU": result["peer"]["cpu"]}
    print_rows("seconds", rows)
    if "peer" in result:
        print_rows("coseg / peer", {"wall": result["wall_ratio"], "CPU": result["cpu_ratio"]}, 3)
    print_rows("stage, wall seconds", result["stages"])
    if result["steps"]:
        print_rows("step, seconds of all ranks", result["steps"])


def parse(arguments):
    extra = []
    if "--" in arguments:
        cut = arguments.index("--")
        arguments, extra = arguments[:cut], arguments[cut + 1 :]
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--coseg", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--peer", type=pathlib.Path, help="cgal_sdf of bench/peers; left out if not given")
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--ranks", type=int, default=2, help="ranks of coseg and processes of the peer")
    parser.add_argument("--parts", type=int, required=True)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", type=pathlib.Path, help="where the figures go")
    parser.add_argument("folder", type=pathlib.Path, help="OFF files")
    options = parser.parse_args(arguments)
    options.extra = extra
    if options.ranks < 1 or options.rounds < 1:
        parser.error("--ranks and --rounds must be at least 1")
    for program in (options.coseg, options.peer):
        if program and not os.access(program, os.X_OK):
            parser.error(f"{program} cannot be run")
    files = sorted(options.folder.glob("*.off"))
    if not files:
        parser.error(f"{options.folder} has no OFF files")
    return options, files


def main():
    options, files = parse(sys.argv[1:])
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options, files, pathlib.Path(scratch))
        bench.load_before = os.getloadavg()
        result = measure(bench)
    print_summary(result)
    if options.json:
        options.json.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
