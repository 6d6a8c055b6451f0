#!/usr/bin/env python3
"""Kills runs with a state folder at random moments and sees whether they still end with the bytes of a run left alone.

    bench/kills.py --coseg build/bin/coseg [--kills 50] [--seed 1] [--shapes 12] [--kinds default paper subsets]
                   [--out kills.json] [--scratch DIR]

A round: a run on 1 to 4 ranks with an empty state folder is ended in one of its stages, chosen at random, after a random share
of the time that the stage took in the run left alone; by SIGKILL to one rank, SIGKILL to the launcher and all ranks at
once, SIGTERM to the launcher, which hands it on and kills what is there a second later, SIGUSR1 to the launcher, which hands it on, or
SIGTERM to one rank. In some rounds the run that continues is ended as well. Then
the same command continues on another random number of ranks until it ends by itself. The kills take the kinds of runs, the stages and
the ways to die in turn, so that each has its share; the moments are random. The same seed makes the same choices; the moments
they meet depend on the machine.

Afterwards everything in the folder of results must have the bytes of the run left alone, but for what tells of the run itself
(times, ranks, memory, state and what was reused in report.json, and the copy of that in report.html); all files of the state folder must be
whole; no process may be left, no partial folder, no lock that is held. A run that is ended must be gone within 30 s, with
code 75 or 0 after SIGUSR1 and after SIGTERM to a rank, once all processes are loaded. The exit code is 1 if a round fails.
"""
import argparse
import fcntl
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

KINDS = {
    "default": ["--checkpoint-seconds", "0"],
    "paper": ["--preset", "paper", "--checkpoint-seconds", "0"],
    "subsets": ["--subsets", "5", "--checkpoint-seconds", "0.2"],
}
WAYS = ("KILL rank", "KILL all", "TERM", "USR1", "TERM rank")
END_SECONDS = 30
LIMIT_SECONDS = 300
OF_THE_RUN = ("text_xxh3", "options", "ranks", "seconds", "peak_memory_max_mib", "peak_memory_sum_mib", "stages", "state")
OF_A_MESH = ("rank", "seconds", "reused")


class Failed(Exception):
    pass


def ranks_of(launcher, program):
    """The processes of `program` below the launcher."""
    parents, programs = {}, {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            stat = pathlib.Path("/proc", entry, "stat").read_text()
            programs[int(entry)] = os.readlink(f"/proc/{entry}/exe")
        except OSError:
            continue
        parents[int(entry)] = int(stat.rpartition(")")[2].split()[1])
    tree = {launcher}
    for _ in range(4):
        tree |= {pid for pid, parent in parents.items() if parent in tree}
    return sorted(pid for pid in tree if programs.get(pid) == str(program))


def left_alone(folder):
    """Processes whose command line names the folder."""
    found = []
    for entry in os.listdir("/proc"):
        if not entry.isdigit() or int(entry) == os.getpid():
            continue
        try:
            words = pathlib.Path("/proc", entry, "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if any(str(folder).encode() in word for word in words) and b"run" in words:
            found.append(int(entry))
    return found


class Run:
    """One start of the program, whose stages are followed as they end."""

    def __init__(self, options, kind, ranks, state, out):
        words = ["mpirun", "--oversubscribe", "-n", str(ranks), options.coseg, "run", "--json-log", "--parts", "2",
                 *options.run_options, *KINDS[kind], *(["--state", state] if state else []), "--out", out, options.meshes]
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        self.options = options
        self.said = []
        self.ended = [("start", time.monotonic())]
        self.news = threading.Condition()
        self.process = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True, env=environment)
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.process.stderr:
            with self.news:
                self.said.append(line.rstrip())
                if line.startswith("{"):
                    event = json.loads(line)
                    if event["event"] == "stage":
                        self.ended.append((event["stage"], time.monotonic()))
                self.news.notify_all()
        with self.news:
            self.ended.append(("end", time.monotonic()))
            self.news.notify_all()

    def wait_for(self, stage):
        """Until the stage has ended; False if the run ends before."""
        with self.news:
            while True:
                names = [name for name, _ in self.ended]
                if stage in names:
                    return True
                if "end" in names:
                    return False
                self.news.wait()

    def kill(self, way, rng):
        ranks = ranks_of(self.process.pid, self.options.coseg)
        while not ranks and way.endswith(" rank") and self.process.poll() is None:  # none is loaded yet
            time.sleep(0.005)
            ranks = ranks_of(self.process.pid, self.options.coseg)
        if way.endswith(" rank"):
            victims = [(pid, getattr(signal, "SIG" + way.split()[0])) for pid in rng.sample(ranks, min(1, len(ranks)))]
        elif way == "KILL all":
            victims = [(pid, signal.SIGKILL) for pid in [*ranks, self.process.pid]]
        else:
            victims = [(self.process.pid, getattr(signal, "SIG" + way))]
        for pid, number in victims:
            try:
                os.kill(pid, number)
            except ProcessLookupError:
                pass

    def finish(self, seconds):
        try:
            code = self.process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            self.kill("KILL all", random)
            self.process.wait()
            raise Failed(f"the run was not over after {seconds} s") from None
        self.reader.join()
        return code


def without_run(report):
    for key in OF_THE_RUN:
        report.pop(key, None)
    for mesh in report["meshes"]:
        for key in OF_A_MESH:
            mesh.pop(key, None)
    return json.dumps(report, sort_keys=True).encode()


def contents(folder):
    """The results' bytes by name, without what tells of the run."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if not path.is_file():
            continue
        data = path.read_bytes()
        if path.name == "report.json":
            data = without_run(json.loads(data))
        elif path.name == "report.html":
            lines = [line for line in data.decode("utf-8").split("\n") if '"peak_memory_max_mib"' not in line]
            data = re.sub(r'"seconds":[0-9.e+-]+', "", "\n".join(lines)).encode()
        found[str(path.relative_to(folder))] = data
    return found


def compare(expected, folder):
    found = contents(folder)
    if sorted(found) != sorted(expected):
        raise Failed(f"other files: {sorted(set(found) ^ set(expected))[:5]}")
    different = [name for name in found if found[name] != expected[name]]
    if different:
        raise Failed(f"other bytes: {', '.join(different[:5])}" + (" and more" if len(different) > 5 else ""))


def check_leftovers(options, folder, state):
    if left_alone(folder):
        raise Failed(f"processes are left: {left_alone(folder)}")
    partial = [str(path) for path in folder.rglob("*.partial-*")] + [str(path) for path in folder.rglob(".partial-*")]
    # What a killed rank was writing stays in the state folder until `coseg state prune`.
    partial = [path for path in partial if not path.startswith(str(state))]
    if partial:
        raise Failed(f"partial folders are left: {partial}")
    with open(state / "lock", "rb") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failed("the state folder is still locked") from None
    verified = subprocess.run([options.coseg, "state", "verify", state], capture_output=True, text=True,
                              env=dict(os.environ, COSEG_RANKS="1"))
    if verified.returncode != 0:
        raise Failed(f"the state is damaged: {verified.stdout} {verified.stderr}")


def stages_of(run):
    """Name, the stage before it and seconds of each stage of a run left alone."""
    return [(name, before, end - begin) for (before, begin), (name, end) in zip(run.ended, run.ended[1:])]


def end_somewhere(run, stages, target, way, rng):
    """Ends the run in the target stage, or where it is when it is over before. Returns the stage that was at work, or None."""
    name, before, seconds = stages[target]
    share = rng.random()
    if run.wait_for(before):
        time.sleep(share * seconds)
    with run.news:
        last = run.ended[-1][0]
    if last == "end":
        return None
    names = [stage for stage, _, _ in stages]
    run.kill(way, rng)
    return names[names.index(last) + 1] if last in names else names[0]


def described(state):
    return sum(1 for _ in (state / "meshes").rglob("*.h5"))


def check_end(run, way, code, at_start):
    if way in ("USR1", "TERM rank") and code not in (0, 75) and not at_start:
        raise Failed(f"{way} gives code {code}: " + " | ".join(run.said[-3:]))


def one_round(options, number, kind, rng, expected, stages, deck, record):
    folder = options.scratch / f"round_{number}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    state, out = folder / "state", folder / "result"
    kills = 1 if rng.random() < 0.7 else 2
    for _ in range(kills):
        if not deck or out.exists():
            break
        target, way = deck.pop()
        ranks = rng.randint(1, 4)
        before = described(state)
        run = Run(options, kind, ranks, state, out)
        at_work = end_somewhere(run, stages, target % len(stages), way, rng)
        start = time.monotonic()
        code = run.finish(END_SECONDS)
        record["kills"].append({"way": way, "meant": stages[target % len(stages)][0], "met": at_work or "nothing", "ranks": ranks,
                                "code": code, "seconds_to_end": round(time.monotonic() - start, 2)})
        # While a process is being loaded it cannot heed a signal.
        check_end(run, way, code, len(run.ended) == 2 and code > 128 and described(state) == before)
    ranks = rng.randint(1, 4)
    if not out.exists():
        run = Run(options, kind, ranks, state, out)
        code = run.finish(LIMIT_SECONDS)
        if code != 0:
            raise Failed(f"the run that continues ends with {code}: " + " | ".join(run.said[-3:]))
    record["ranks_after"] = ranks
    compare(expected, out)
    check_leftovers(options, folder, state)
    shutil.rmtree(folder)


def reference(options, kind):
    out = options.scratch / f"alone_{kind}"
    shutil.rmtree(out, ignore_errors=True)
    run = Run(options, kind, 2, None, out)
    code = run.finish(LIMIT_SECONDS)
    if code != 0:
        raise Failed(f"the run left alone ends with {code}: " + " | ".join(run.said[-3:]))
    return contents(out), stages_of(run)


def dealt(options, stages, rng):
    """A stage and a way to die for each kill: all combinations in turn, in random order."""
    deck = []
    while len(deck) < options.kills:
        combinations = [(target, way) for target in range(len(stages)) for way in WAYS]
        rng.shuffle(combinations)
        deck += combinations
    return deck[: options.kills]


def summary(rounds, failures):
    kills = [kill for record in rounds for kill in record["kills"]]
    met = {}
    for kill in kills:
        met.setdefault(kill["met"], {}).setdefault(kill["way"], 0)
        met[kill["met"]][kill["way"]] += 1
    lines = [f"{stage:>10}: " + ", ".join(f"{count} {way}" for way, count in sorted(ways.items())) for stage, ways in met.items()]
    lines.append(f"{len(kills)} kills in {len(rounds)} rounds, {len(rounds) - len(failures)} of {len(rounds)} rounds end with the bytes of "
                 f"the run left alone; longest end {max(kill['seconds_to_end'] for kill in kills)} s")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description="Kills runs at random moments and compares what they end with.")
    parser.add_argument("--coseg", required=True, type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shapes", type=int, default=12)
    parser.add_argument("--faces", type=int, default=2000)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--scratch", type=pathlib.Path, help="folder for shapes and runs; default: one that goes")
    parser.add_argument("--out", type=pathlib.Path, help="JSON")
    parser.add_argument("run_options", nargs="*", help="further options of coseg run, after --")
    options = parser.parse_args()
    options.coseg = options.coseg.resolve()
    rng = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as gone:
        options.scratch = (options.scratch or pathlib.Path(gone)).resolve()
        shapes = options.scratch / "shapes"
        if not shapes.is_dir():
            subprocess.run([options.coseg, "generate", "table", "--count", str(options.shapes), "--faces", str(options.faces),
                            "--out", shapes], check=True, stdout=subprocess.DEVNULL, env=dict(os.environ, COSEG_RANKS="1"))
        options.meshes = shapes / "meshes"
        references = {kind: reference(options, kind) for kind in options.kinds}
        longest = max((stages for _, stages in references.values()), key=len)
        deck = dealt(options, longest, rng)
        rounds, failures = [], []
        while deck:
            kind = options.kinds[len(rounds) % len(options.kinds)]
            expected, stages = references[kind]
            number = len(rounds)
            record = {"kind": kind, "kills": []}
            try:
                one_round(options, number, kind, rng, expected, stages, deck, record)
            except Failed as failure:
                record["failed"] = str(failure)
                failures.append(f"round {number} ({kind}): {failure}; see {options.scratch}/round_{number}")
                print(failures[-1], file=sys.stderr, flush=True)
            rounds.append(record)
    print(summary(rounds, failures))
    if options.out:
        options.out.write_text(json.dumps({"format": "coseg kills 1", "seed": options.seed, "rounds": rounds, "failures": failures},
                                          indent=1) + "\n", encoding="utf-8")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
