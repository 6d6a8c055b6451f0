#!/usr/bin/env python3
"""What `coseg run` costs on a large collection, and how right it is beside a small one of the same family.

    bench/collection.py --coseg build/bin/coseg --shapes 400 [--family quadruped] [--beside 20] [--ranks 2]
                        [--out collection.json] [--table collection.md] [--scratch DIR] [-- OPTIONS OF coseg run]

Makes the shapes (`coseg generate`, about --faces faces each), runs the defaults on them from files to labels, pictures and
pages included, and scores the labels (`coseg score`); then the same for --beside shapes of the family.

    wall       seconds from the start of a stage to its agreed end, and of the whole command
    CPU        seconds of all ranks in the meantime, user and system; a rank that waits for another counts as busy
    memory     MiB in all: the largest sum, over the processes of the run at one moment, of their memory, where a page that
               several share is counted once (PSS); looked at four times a second
    files      most files that one rank had open at a time
Nothing here is a test: times depend on what else the machine does. The exit code is 1 if a run fails.
"""
import argparse
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import threading
import time

from program import command_output, parsed_with_options

TICK = os.sysconf("SC_CLK_TCK")
LOOK_SECONDS = 0.25


def process_tree(root):
    """The process and all that descend from it."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                stat = pathlib.Path("/proc", entry, "stat").read_text()
            except OSError:
                continue
            parents[int(entry)] = int(stat.rpartition(")")[2].split()[1])
    tree = {root}
    grown = True
    while grown:
        children = {pid for pid, parent in parents.items() if parent in tree} - tree
        tree |= children
        grown = bool(children)
    return tree


class Watch:
    """Looks at the memory, the files and the CPU time of a run while it lasts."""

    def __init__(self, root, program):
        self.root = root
        self.program = program
        self.peak_kib = 0
        self.most_files = 0
        self.stage_peak_kib = 0
        self.ranks = []
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.look_on)
        self.thread.start()

    def look_on(self):
        while not self.over.wait(LOOK_SECONDS):
            self.look()

    def look(self):
        kib = 0
        ranks = []
        for pid in process_tree(self.root):
            try:
                if os.readlink(f"/proc/{pid}/exe") == str(self.program):
                    ranks.append(pid)
                    self.most_files = max(self.most_files, len(os.listdir(f"/proc/{pid}/fd")))
                for line in pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
                    if line.startswith("Pss:"):
                        kib += int(line.split()[1])
            except OSError:
                continue  # it has ended meanwhile
        self.ranks = ranks or self.ranks
        self.peak_kib = max(self.peak_kib, kib)
        self.stage_peak_kib = max(self.stage_peak_kib, kib)

    def take_stage_peak(self):
        peak, self.stage_peak_kib = self.stage_peak_kib, 0
        return peak

    def cpu_seconds(self):
        ticks = 0
        for pid in self.ranks:
            try:
                fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            ticks += int(fields[11]) + int(fields[12])
        return ticks / TICK

    def stop(self):
        self.over.set()
        self.thread.join()


def run(options, meshes, parts, out):
    words = [options.coseg, "run", "--ranks", options.ranks, "--json-log", "--parts", parts, "--out", out,
             *options.run_options, meshes]
    before = os.times()
    start = time.monotonic()
    process = subprocess.Popen([str(word) for word in words], stderr=subprocess.PIPE, text=True)
    watch = Watch(process.pid, options.coseg)
    stages = []
    said = []
    cpu = 0.0
    for line in process.stderr:
        said.append(line.rstrip())
        if not line.startswith("{"):
            continue
        event = json.loads(line)
        if event["event"] != "stage":
            continue
        now = watch.cpu_seconds()
        stages.append({"stage": event["stage"], "wall": event["seconds"], "cpu": now - cpu,
                       "peak_mib": watch.take_stage_peak() / 1024,
                       "summary": "" if "/" in event["summary"] else event["summary"]})
        cpu = now
        if options.verbose:
            print(json.dumps(stages[-1]), file=sys.stderr, flush=True)
    code = process.wait()
    seconds = time.monotonic() - start
    watch.stop()
    after = os.times()
    if code != 0:
        sys.exit(f"collection.py: coseg run ended with {code}: " + "\n".join(said[-5:]))
    return {
        "wall": seconds,
        "cpu": after.children_user + after.children_system - before.children_user - before.children_system,
        "peak_mib": watch.peak_kib / 1024,
        "most_open_files": watch.most_files,
        "stages": stages,
    }


def measured(options, shapes, scratch):
    folder = scratch / f"{options.family}_{shapes}"
    if not folder.is_dir():
        command_output([options.coseg, "generate", options.family, "--count", shapes, "--faces", options.faces,
                        "--seed", options.seed, "--out", folder])
    labels = folder / "truth" / "labels.txt"
    parts = len(labels.read_text(encoding="utf-8").splitlines())
    out = scratch / f"result_{options.family}_{shapes}"
    row = {"family": options.family, "shapes": shapes, "parts": parts, **run(options, folder / "meshes", parts, out)}
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    row["faces"] = sum(mesh["faces"] for mesh in report["meshes"])
    row["patches"] = sum(mesh["patches"] for mesh in report["meshes"])
    row["bytes"] = {name: (out / name).stat().st_size for name in ("report.json", "report.html", "contact_sheet.png")
                    if (out / name).exists()}
    score = json.loads(command_output([options.coseg, "score", "--json", "--truth", folder / "truth", "--labels",
                                       out / "labels", folder / "meshes"]))
    row["accuracy"] = score["one_to_one"]
    return row


def markdown(rows):
    lines = ["| shapes | faces | patches | wall s | CPU s | memory in all, MiB | open files of a rank | accuracy, % | "
             "report.html, MB | report.json, MB | contact_sheet.png, MB |",
             "| ---: " * 11 + "|"]
    for row in rows:
        sizes = [f"{row['bytes'].get(name, 0) / 1e6:.1f}" for name in ("report.html", "report.json", "contact_sheet.png")]
        lines.append(f"| {row['shapes']} {row['family']} | {row['faces']} | {row['patches']} | {row['wall']:.1f} | {row['cpu']:.1f} | "
                     f"{row['peak_mib']:.0f} | {row['most_open_files']} | {row['accuracy']:.2f} | " + " | ".join(sizes) + " |")
    for row in rows:
        lines += ["", f"| stage, {row['shapes']} shapes | wall s | CPU s | memory in all, MiB | |", "| --- | ---: | ---: | ---: | --- |"]
        for stage in row["stages"]:
            lines.append(f"| {stage['stage']} | {stage['wall']:.1f} | {stage['cpu']:.1f} | {stage['peak_mib']:.0f} | "
                         f"{stage['summary']} |")
    return "\n".join(lines) + "\n"


def write_result(options, result, table):
    """JSON where --out says; the table where --table says, else on standard output."""
    if options.out:
        options.out.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    if options.table:
        options.table.write_text(table, encoding="utf-8")
    else:
        print(table, end="")


def main():
    parser = argparse.ArgumentParser(description="What coseg run costs on a large collection.")
    parser.add_argument("--coseg", required=True, type=pathlib.Path)
    parser.add_argument("--family", default="quadruped")
    parser.add_argument("--shapes", type=int, default=400)
    parser.add_argument("--beside", type=int, default=20, help="shapes of the small collection; 0: none")
    parser.add_argument("--faces", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--scratch", type=pathlib.Path, help="folder for shapes and results that stays; default: one that goes")
    parser.add_argument("--out", type=pathlib.Path, help="JSON")
    parser.add_argument("--table", type=pathlib.Path, help="Markdown; standard output without it")
    parser.add_argument("--verbose", action="store_true", help="each stage as it ends, on standard error")
    options, options.run_options = parsed_with_options(parser)
    options.coseg = options.coseg.resolve()
    with tempfile.TemporaryDirectory() as gone:
        scratch = options.scratch or pathlib.Path(gone)
        scratch.mkdir(parents=True, exist_ok=True)
        counts = [options.beside, options.shapes] if options.beside > 0 else [options.shapes]
        rows = [measured(options, shapes, scratch) for shapes in counts]
    result = {"format": "coseg collection 1", "machine": f"{platform.machine()}, {os.cpu_count()} cores", "ranks": options.ranks,
              "run_options": options.run_options, "rows": rows}
    write_result(options, result, markdown(rows))


if __name__ == "__main__":
    main()
