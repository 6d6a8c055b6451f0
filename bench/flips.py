#!/usr/bin/env python3
"""Flips single bits in the files that runs keep and read again, and sees that each flip is detected or harmless.

    bench/flips.py --coseg build/bin/coseg [--flips 1000] [--seed 1] [--kinds KIND ...] [--shapes 4] [--faces 2000 | --meshes DIR]
                   [--module DIR] [--out flips.json] [--scratch DIR]

The files are those of a small run with a state folder, --keep-features and a model. One bit of one file is flipped; of every two flips one is among the first 2,048 bytes, where the headers are. Then the command that
reads the file is given it:

    describe, solver, cut   `coseg run --state`, with all that comes after the file removed from the state folder, so that it is read
    model                   `coseg assign`
    features                `coseg cluster`
    report, labels          `coseg export --to obj` of the finished run, or, one time in eight, `coseg render`

With --module DIR (the folder that holds the Python module `coseg`, such as build/python) one process reads one file after another,
which saves the start of the program: `coseg.segment(state=...)` in place of `coseg run`, `coseg.assign`, and for report and
labels `coseg.Result.load`; there are no features then. A process that ends, or does not answer, is a failure, and another one goes on.

A flip is harmless if the command ends with code 0 and gives the same bytes as with the healthy file (labels, patches, clusters,
coefficients, drawn meshes); detected if it ends with one of the documented codes and a sentence of its own, or if it says in a
warning that the file is damaged and gives those bytes; of reports and label files, which people may edit, the warning is enough.
Anything else, a signal, a hang or other bytes, is a failure, and the
damaged file is kept in the scratch folder. The same seed makes the same flips. The exit code is 1 if there is a failure.
"""
import argparse
import json
import os
import pathlib
import random
import re
import select
import shutil
import subprocess
import sys
import tempfile

LIMIT_SECONDS = 60
HEAD = 2048
CODES = {1, 2, 3, 4, 5}


def seg_text(labels):
    return "".join(f"{label}\n" for label in labels)


def answer(task):
    """What the module makes of the files of a task: a code, sentences, and bytes by name."""
    import coseg
    quick = {"patches": 10, "geodesic_samples": 50}
    if task["does"] == "segment":
        result = coseg.segment(task["meshes"], 2, state=task["state"], **quick)
    elif task["does"] == "assign":
        result = coseg.assign(task["meshes"], task["run"])
    else:
        result = coseg.Result.load(task["run"])
    given = {f"{kind}/{name}": seg_text(row) for kind in ("labels", "patches") for name, row in zip(result.names, getattr(result, kind))}
    given["rest"] = json.dumps([result.parts, result.part_areas.tolist()])
    if task["does"] == "load":
        given["rest"] += json.dumps([result.report, result.certificate])
    return {"code": 0, "says": result.warnings, "given": given}


def work():
    """One task a line of the input, one answer a line of the output."""
    import coseg
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for line in sys.stdin:
        try:
            reply = answer(json.loads(line))
        except coseg.Error as error:
            reply = {"code": error.code, "says": [f"coseg: {error}"], "given": {}}
        print(json.dumps(reply), file=answers, flush=True)


class Worker:
    """The process that reads with the Python module."""

    def __init__(self, options, environment):
        self.words = [options.python, os.path.abspath(__file__), "--work"]
        self.environment = dict(environment, PYTHONPATH=str(options.module.resolve()), OMPI_MCA_ess_singleton_isolated="1")
        self.process = None

    def ask(self, task):
        if self.process is None:
            self.process = subprocess.Popen(self.words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                            env=self.environment)
            os.set_blocking(self.process.stderr.fileno(), False)
        self.process.stdin.write(json.dumps(task, default=str).encode() + b"\n")
        self.process.stdin.flush()
        ready, _, _ = select.select([self.process.stdout], [], [], LIMIT_SECONDS)
        line = self.process.stdout.readline() if ready else b""
        said = (self.process.stderr.read() or b"").decode(errors="replace")
        if not line:
            self.process.kill()
            code = self.process.wait()
            self.process = None
            if not ready:
                raise subprocess.TimeoutExpired("coseg", LIMIT_SECONDS)
            return subprocess.CompletedProcess([], code, said), {}
        reply = json.loads(line)
        lines = said.splitlines() + [f"warning: {sentence}" if reply["code"] == 0 else sentence for sentence in reply["says"]]
        return subprocess.CompletedProcess([], reply["code"], "\n".join(lines)), reply["given"]


class Bench:
    def __init__(self, options, scratch):
        self.coseg, self.scratch = str(options.coseg.resolve()), scratch
        self.environment = dict(os.environ, COSEG_RANKS="1", OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1",
                                OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        self.worker = Worker(options, self.environment) if options.module else None
        self.quick = ["--quiet", "--parts", "2", "--patches", "10", "--geodesic-samples", "50", "--no-html", "--no-sheet"]
        self.meshes, self.run_folder, self.state = options.meshes, scratch / "run", scratch / "state"
        if not self.meshes:
            self.must("generate", "table", "--count", str(options.shapes), "--faces", str(options.faces), "--out", str(scratch / "shapes"))
            self.meshes = scratch / "shapes/meshes"
        self.must(*self.run_words(self.run_folder), "--keep-features", "--state", str(self.state))

    def call(self, *words, limit=LIMIT_SECONDS):
        return subprocess.run([self.coseg, *map(str, words)], env=self.environment, timeout=limit, text=True,
                              errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)

    def must(self, *words):
        done = self.call(*words, limit=600)
        if done.returncode != 0:
            sys.exit(f"coseg {' '.join(map(str, words))} ends with {done.returncode}:\n{done.stdout}")

    def run_words(self, out):
        return ["run", *self.quick, "--out", str(out), str(self.meshes)]


def contents(folder, names):
    """Bytes of the files below the folder whose path matches."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and re.search(names, str(path.relative_to(folder)))}


class Kind:
    """Files of one kind, and the command that reads them. `read(place)` returns the finished process and what it gave."""

    def __init__(self, bench):
        self.bench = bench

    def copy(self):
        place = self.bench.scratch / "tried"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        return place


class State(Kind):
    def __init__(self, bench, pattern, removed):
        super().__init__(bench)
        self.pattern, self.removed = pattern, removed

    def files(self, place):
        shutil.copytree(self.bench.state, place / "state", copy_function=os.link)  # the program renames, it does not overwrite
        for name in self.removed:
            shutil.rmtree(place / "state" / name, ignore_errors=True)
        return sorted((place / "state").glob(self.pattern))

    def read(self, place):
        if self.bench.worker:
            return self.bench.worker.ask({"does": "segment", "meshes": self.bench.meshes, "state": place / "state"})
        done = self.bench.call(*self.bench.run_words(place / "out"), "--state", place / "state")
        return done, contents(place / "out", "^(labels|patches)/") if done.returncode == 0 else {}


class OfRun(Kind):
    """A file of the finished run."""

    def __init__(self, bench, name, does, words, results):
        super().__init__(bench)
        self.name, self.does, self.words, self.results = name, does, words, results
        self.calls = 0

    def files(self, place):
        shutil.copytree(self.bench.run_folder, place / "run", copy_function=os.link)
        return sorted((place / "run").glob(self.name))

    def read(self, place):
        if self.bench.worker:
            return self.bench.worker.ask({"does": self.does, "meshes": self.bench.meshes, "run": place / "run"})
        given = {}
        self.calls += 1
        for number, words in enumerate(self.words):
            if self.calls > 1 and number != (self.calls % 8 == 0 and len(self.words) > 1):
                continue
            out = place / f"out{number}"
            replace = {"RUN": place / "run", "FEATURES": place / "run/features.h5", "OUT": out, "MESHES": self.bench.meshes}
            done = self.bench.call(*(replace.get(word, word) for word in words))
            if done.returncode != 0:
                return done, {}
            given[number] = contents(out, self.results) if out.is_dir() else out.read_bytes()
        return done, given


def flip(path, rng):
    size = path.stat().st_size
    place = rng.randrange(min(size, HEAD)) if rng.random() < 0.5 else rng.randrange(size)
    bit = rng.randrange(8)
    shutil.copy2(path, path.with_suffix(".copy"))
    os.replace(path.with_suffix(".copy"), path)  # its other links stay healthy
    with open(path, "r+b") as file:
        file.seek(place)
        byte = file.read(1)[0]
        file.seek(place)
        file.write(bytes([byte ^ (1 << bit)]))
    return place, bit


def verdict(done, given, expected, may_be_edited):
    says = [line for line in done.stdout.splitlines() if line.startswith(("coseg", "error", "warning")) or "warning" in line]
    if done.returncode == 0:
        same = given and all(expected[name] == bytes_given for name, bytes_given in given.items())
        if not same and not (may_be_edited and any("damaged or edited" in line for line in says)):
            return "failed", "other bytes without a word" if not says else "other bytes: " + says[0]
        return ("detected" if any("damaged" in line for line in says) else "harmless"), says[0] if says else ""
    if done.returncode in CODES and says:
        return "detected", says[-1]
    return "failed", f"exit code {done.returncode}: " + " | ".join(done.stdout.splitlines()[-3:])


def try_flip(kind, rng, expected):
    place = kind.copy()
    path = rng.choice(kind.files(place))
    at, bit = flip(path, rng)
    try:
        outcome, says = verdict(*kind.read(place), expected, path.suffix in (".seg", ".json"))
    except subprocess.TimeoutExpired:
        outcome, says = "failed", f"not over after {LIMIT_SECONDS} s"
    return {"file": str(path.relative_to(place)), "byte": at, "bit": bit, "outcome": outcome, "says": says}


def kinds_of(bench):
    drawn = [["export", "RUN", "--to", "obj", "--out", "OUT"], ["render", "RUN", "--out", "OUT"]]
    return {
        "describe": State(bench, "meshes/*/*.h5", ["solver", "cuts"]),
        "solver": State(bench, "solver/*/*.h5", ["cuts"]),
        "cut": State(bench, "cuts/*.h5", []),
        "model": OfRun(bench, "model.h5", "assign", [["assign", "--quiet", "--no-html", "--no-sheet", "--to", "RUN", "--out", "OUT", "MESHES"]],
                       "^(labels|patches)/"),
        "features": OfRun(bench, "features.h5", "", [["cluster", "FEATURES", "--parts", "2", "--out", "OUT"]], "."),
        "report": OfRun(bench, "report.json", "load", drawn, "."),
        "labels": OfRun(bench, "*/*.seg", "load", drawn, "."),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True, type=pathlib.Path)
    parser.add_argument("--flips", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shapes", type=int, default=4)
    parser.add_argument("--faces", type=int, default=2000)
    parser.add_argument("--meshes", type=pathlib.Path, help="a folder of meshes instead of generated shapes")
    parser.add_argument("--kinds", nargs="+")
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--scratch", type=pathlib.Path)
    parser.add_argument("--module", type=pathlib.Path, help="read with the Python module in this folder")
    parser.add_argument("--python", default="/usr/bin/python3", help="the Python that the module is for")
    options = parser.parse_args()
    rng = random.Random(options.seed)
    with tempfile.TemporaryDirectory(dir=options.scratch) as scratch:
        bench = Bench(options, pathlib.Path(scratch))
        kinds = {name: kind for name, kind in kinds_of(bench).items() if not options.kinds or name in options.kinds}
        if options.module:
            kinds.pop("features", None)
        expected = {}
        for name, kind in kinds.items():
            place = kind.copy()
            kind.files(place)
            done, expected[name] = kind.read(place)
            if done.returncode != 0 or not expected[name]:
                sys.exit(f"{name}: the healthy file gives code {done.returncode}:\n{done.stdout}")
        rows = []
        for number in range(options.flips):
            name = list(kinds)[number % len(kinds)]
            row = {"kind": name, **try_flip(kinds[name], rng, expected[name])}
            rows.append(row)
            if row["outcome"] == "failed":
                print(f"{name}: {row['file']} byte {row['byte']} bit {row['bit']}: {row['says']}", file=sys.stderr, flush=True)
    for name in kinds:
        count = lambda outcome: sum(1 for row in rows if row["kind"] == name and row["outcome"] == outcome)
        print(f"{name:>10}: {count('detected')} detected, {count('harmless')} harmless, {count('failed')} failed")
    failed = [row for row in rows if row["outcome"] == "failed"]
    print(f"{len(rows)} flips: {len(rows) - len(failed)} detected or harmless, {len(failed)} failed")
    if options.out:
        options.out.write_text(json.dumps({"format": "coseg flips 1", "seed": options.seed, "flips": rows}, indent=1) + "\n", encoding="utf-8")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    work() if sys.argv[1:] == ["--work"] else main()
