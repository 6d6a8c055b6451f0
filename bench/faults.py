#!/usr/bin/env python3
"""Runs under faults of the machine, and says for each whether it ends as it should.

    bench/faults.py --coseg build/bin/coseg [--cases CASE ...] [--steps 12] [--pause 5] [--shapes 5] [--faces 2000]
                    [--out faults.json] [--scratch DIR]

    full        the disk under results and state is full: a tmpfs of --steps sizes, from nothing to all that the run writes; then
                it has room, and the same command continues
    read-only   the state folder, or the folder of the results, is on a disk that is mounted read-only
    stopped     one rank is stopped (SIGSTOP) in every stage for --pause seconds and continued; also many times in a row
    memory      a rank, or all of them, may not have more than so much memory (`ulimit -v`), in --steps sizes
    shm         /dev/shm is small, from 0 to 32 MB
    clock       the clock jumps back by an hour during the run, or the state was written under a clock that was a day ahead
    files       few open files are allowed (`ulimit -n`), or only short files (`ulimit -f`)

A case passes if the run ends with the bytes of a run left alone, or if it says why it cannot in one sentence, with a documented
code other than 0; within 30 s and four times what the run takes alone; with no process, no partial folder and no damaged
file of the state left; and if the same command without the fault, on the same state folder, ends with those bytes. Where MPI
itself cannot begin, words and code are its own. The exit code is 1 if a case fails. `full`, `read-only` and `shm` need the right
to mount, `clock` needs Debian's package faketime; they are skipped without it.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import kills

LIMIT_SECONDS = 30
CODES = {1, 2, 3, 4, 5, 75}
OF_MPI = ("MPI_INIT", "MPI_Init", "MPI_ERRORS_ARE_FATAL")


class Failed(Exception):
    pass


class Skipped(Exception):
    pass


class Bench:
    def __init__(self, options, scratch):
        self.options, self.scratch, self.coseg = options, scratch, str(options.coseg.resolve())
        self.environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                                OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                                OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1")
        self.shapes = scratch / "shapes"
        subprocess.run([self.coseg, "generate", "table", "--count", str(options.shapes), "--faces", str(options.faces), "--out",
                        str(self.shapes)], env=dict(self.environment, COSEG_RANKS="1"), check=True, stdout=subprocess.DEVNULL)
        self.rows = []
        self.draw(False)

    def draw(self, pages):
        """Whether runs from now on draw a sheet and a page, which takes most of the time of so small a run."""
        self.pages, self.limit = pages, 600
        for name in ("alone", "alone_state"):
            shutil.rmtree(self.scratch / name, ignore_errors=True)
        start = time.monotonic()
        done = self.run(self.scratch / "alone", self.scratch / "alone_state")
        self.seconds = time.monotonic() - start
        self.limit = LIMIT_SECONDS + 4 * self.seconds
        if done.returncode != 0:
            sys.exit(f"the run left alone ends with {done.returncode}:\n{done.stderr}")
        self.expected = kills.contents(self.scratch / "alone")

    def words(self, out, state):
        return ["run", "--json-log", "--parts", "2", "--patches", "20", "--geodesic-samples", "100", "--checkpoint-seconds", "0",
                *([] if self.pages else ["--no-html", "--no-sheet"]), "--state", str(state), "--out", str(out), str(self.shapes / "meshes")]

    def start(self, out, state, ranks=2, launcher=(), program=None, **keywords):
        command = [*launcher, "mpirun", "--oversubscribe", "-n", str(ranks), *(program or [self.coseg]), *self.words(out, state)]
        return subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                errors="replace", start_new_session=True, **keywords)

    def end(self, process):
        try:
            said = process.communicate(timeout=self.limit)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            raise Failed(f"not over after {self.limit:.0f} s") from None
        return subprocess.CompletedProcess(process.args, process.returncode, stderr=said)

    def run(self, out, state, **keywords):
        return self.end(self.start(out, state, **keywords))

    def is_right(self, out):
        try:
            kills.compare(self.expected, out)
        except kills.Failed as failure:
            raise Failed(str(failure)) from None

    def has_sentence(self, done):
        """The one sentence of the program, without lines of progress and of the launcher."""
        # Ranks that end the others may say the same.
        said = sorted({re.sub(r"rank \d+: ", "", line) for line in done.stderr.splitlines() if is_error(line)})
        if not said and '"event"' not in done.stderr and any(word in done.stderr for word in OF_MPI):
            return "MPI itself cannot begin, and says so"
        if done.returncode not in CODES:
            raise Failed(f"code {done.returncode}: " + " | ".join(done.stderr.splitlines()[-4:])[:400])
        if len(said) != 1:
            raise Failed(f"code {done.returncode} with {len(said)} sentences: " + " | ".join(said or done.stderr.splitlines()[-4:])[:400])
        return sentence(said[0])

    def nothing_is_left(self, folder, state):
        if kills.left_alone(folder):
            raise Failed(f"processes are left: {kills.left_alone(folder)}")
        partial = [path for path in folder.rglob("*.partial-*") if not str(path).startswith(str(state))]
        if partial:
            raise Failed(f"left behind: {partial}")
        if (state / "coseg-state").exists():
            verified = subprocess.run([self.coseg, "state", "verify", str(state)], capture_output=True, text=True,
                                      env=dict(self.environment, COSEG_RANKS="1"), check=False)
            if verified.returncode != 0:
                raise Failed(f"the state is damaged: {verified.stderr}")

    def judge(self, done, out, folder, state):
        """What the disturbed run came to."""
        if done.returncode == 0:
            self.is_right(out)
            outcome = "right bytes"
        else:
            outcome = f"code {done.returncode}: {self.has_sentence(done)}"
            if out.exists():
                raise Failed("half a result: " + outcome)
        self.nothing_is_left(folder, state)
        return outcome

    def continues(self, out, state):
        shutil.rmtree(out, ignore_errors=True)
        done = self.run(out, state)
        if done.returncode != 0:
            raise Failed(f"does not continue: code {done.returncode}: {done.stderr[-300:]}")
        self.is_right(out)

    def case(self, name, act):
        folder = self.scratch / "case"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        start = time.monotonic()
        try:
            row = {"case": name, "passed": True, "outcome": act(folder)}
        except Failed as failure:
            row = {"case": name, "passed": False, "outcome": str(failure)}
        except Skipped as reason:
            row = {"case": name, "passed": None, "outcome": str(reason)}
        row["seconds"] = round(time.monotonic() - start, 2)
        self.rows.append(row)
        word = {True: "pass", False: "FAIL", None: "skip"}[row["passed"]]
        print(f"{word} {name} ({row['seconds']} s): {row['outcome']}", flush=True)


def is_error(line):
    if line.startswith("{"):
        return json.loads(line).get("event") == "error"
    return line.startswith("coseg: ") and not line.startswith("coseg: warning")


def sentence(line):
    return json.loads(line).get("message", line) if line.startswith("{") else line


class Disk:
    """A tmpfs of some size."""

    def __init__(self, place, size):
        self.place = place
        place.mkdir(exist_ok=True)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(place)], capture_output=True, check=False).returncode != 0:
            raise Skipped("no right to mount")

    def change(self, option):
        subprocess.run(["mount", "-o", f"remount,{option}", str(self.place)], check=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", "--lazy", str(self.place)], check=False)


def used_kib(folder):
    return int(subprocess.run(["du", "--block-size=1k", "--summarize", str(folder)], capture_output=True, text=True,
                              check=True).stdout.split()[0])


def full_disk(bench):
    bench.draw(True)
    whole = used_kib(bench.scratch / "alone") + used_kib(bench.scratch / "alone_state")
    steps = bench.options.steps
    for step in range(steps):
        size = max(4, whole * step // max(1, steps - 1) // 4 * 4)

        def act(folder, size=size):
            with Disk(folder / "disk", f"{size}k") as disk:
                out, state = disk.place / "out", disk.place / "state"
                outcome = bench.judge(bench.run(out, state), out, folder, state)
                disk.change("size=1g")
                bench.continues(out, state)
            return outcome

        bench.case(f"full disk of {size} kB", act)
    bench.draw(False)


def read_only(bench):
    def act(folder, what):
        with Disk(folder / "disk", "1g") as disk:
            on_disk, elsewhere = disk.place / "there", folder / "elsewhere"
            places = {"state": (elsewhere, on_disk), "results": (on_disk, elsewhere)}[what]
            if what == "state":
                bench.end(bench.start(folder / "first", on_disk))
            disk.change("ro")
            outcome = bench.judge(bench.run(*places), places[0], folder, places[1])
            if outcome == "right bytes":
                raise Failed("it cannot have written anything")
            disk.change("rw")
            bench.continues(*places)
        return outcome

    for what in ("state", "results"):
        bench.case(f"{what} read-only", lambda folder, what=what: act(folder, what))


def ranks_of(process, bench, count):
    for _ in range(500):
        found = kills.ranks_of(process.pid, bench.coseg)
        if len(found) >= count or process.poll() is not None:
            return found
        time.sleep(0.01)
    return []


def stopped_rank(bench):
    def act(folder, share, times, pause):
        out, state = folder / "out", folder / "state"
        process = bench.start(out, state)
        found = ranks_of(process, bench, 2)
        time.sleep(share * bench.seconds)
        for _ in range(times):
            try:
                os.kill(found[-1], signal.SIGSTOP)
                time.sleep(pause)
                os.kill(found[-1], signal.SIGCONT)
                time.sleep(0.01)
            except (ProcessLookupError, IndexError):
                break
        return bench.judge(bench.end(process), out, folder, state)

    for share in (0.0, 0.2, 0.4, 0.6, 0.8):
        bench.case(f"a rank stopped for {bench.options.pause} s at {share:.0%} of the run",
                   lambda folder, share=share: act(folder, share, 1, bench.options.pause))
    bench.case("a rank stopped and continued 100 times", lambda folder: act(folder, 0.0, 100, 0.005))


def limited(bench, name, limits, launcher_too):
    """limits: of the shell's ulimit."""

    def act(folder):
        out, state = folder / "out", folder / "state"
        program = ["bash", "-c", f'{limits} exec "$0" "$@"', bench.coseg]
        if launcher_too:
            done = bench.run(out, state, program=program)
        else:
            words = bench.words(out, state)
            command = ["mpirun", "--oversubscribe", "-n", "1", bench.coseg, *words, ":", "-n", "1", *program, *words]
            process = subprocess.Popen(command, env=bench.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                       text=True, errors="replace", start_new_session=True)
            done = bench.end(process)
        outcome = bench.judge(done, out, folder, state)
        bench.continues(out, state)
        return outcome

    bench.case(name, act)


def little_memory(bench):
    # What a process has mapped when it has begun is mostly libraries; below that the loader itself ends it.
    steps = bench.options.steps
    for step in range(steps):
        mib = 350 + 650 * step // max(1, steps - 1)
        for who in ("one rank", "all ranks"):
            limited(bench, f"{mib} MB of address space for {who}", f"ulimit -v {mib * 1024};", who == "all ranks")


def few_files(bench):
    for count in (16, 24, 32, 48, 64):
        limited(bench, f"{count} open files a rank", f"ulimit -n {count};", True)
    for kib in (1, 16, 64, 256):
        limited(bench, f"files of at most {kib} kB", f"ulimit -f {kib};", True)


def small_shared_memory(bench):
    def act(folder, size):
        out, state = folder / "out", folder / "state"
        launcher = ["unshare", "--mount", "bash", "-c", f'mount -t tmpfs -o size={size} none /dev/shm && exec "$0" "$@"']
        if subprocess.run([*launcher, "true"], capture_output=True, check=False).returncode != 0:
            raise Skipped("no right to mount")
        outcome = bench.judge(bench.run(out, state, launcher=launcher), out, folder, state)
        bench.continues(out, state)
        return outcome

    for size in ("4k", "256k", "1m", "4m", "8m", "16m", "32m"):
        bench.case(f"/dev/shm of {size}B", lambda folder, size=size: act(folder, size))


FAKETIME = "/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1"


def clock_jumps(bench):
    def under(clock):
        if not os.path.exists(FAKETIME):
            raise Skipped("no package faketime")
        return ["env", f"LD_PRELOAD={FAKETIME}", f"FAKETIME_TIMESTAMP_FILE={clock}", "FAKETIME_NO_CACHE=1", "DONT_FAKE_MONOTONIC=1",
                "NO_FAKE_STAT=1", bench.coseg]

    def during(folder, share):
        out, state, clock = folder / "out", folder / "state", folder / "clock"
        clock.write_text("+0\n")
        process = bench.start(out, state, program=under(clock))
        ranks_of(process, bench, 2)
        time.sleep(share * bench.seconds)
        clock.write_text("-1h\n")
        outcome = bench.judge(bench.end(process), out, folder, state)
        bench.continues(out, state)
        return outcome

    def between(folder):
        out, state, clock = folder / "out", folder / "state", folder / "clock"
        clock.write_text("+1d\n")
        bench.run(folder / "first", state, program=under(clock))
        for path in state.rglob("*"):  # times of files are the kernel's, whose clock is right
            os.utime(path, (time.time() + 86400, time.time() + 86400))
        outcome = bench.judge(bench.run(out, state), out, folder, state)
        listed = subprocess.run([bench.coseg, "state", "list", str(state)], capture_output=True, text=True, check=False,
                                env=dict(bench.environment, COSEG_RANKS="1"))
        if listed.returncode != 0:
            raise Failed(f"coseg state list ends with {listed.returncode}: {listed.stderr}")
        return outcome

    for share in (0.1, 0.3, 0.5, 0.7, 0.9):
        bench.case(f"the clock jumps back by an hour at {share:.0%} of the run", lambda folder, share=share: during(folder, share))
    bench.case("a state of tomorrow", between)


CASES = {"clock": clock_jumps, "full": full_disk, "read-only": read_only, "stopped": stopped_rank, "memory": little_memory, "shm": small_shared_memory,
         "files": few_files}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True, type=pathlib.Path)
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES))
    parser.add_argument("--steps", type=int, default=12)
    parser.add_argument("--pause", type=float, default=5.0)
    parser.add_argument("--shapes", type=int, default=5)
    parser.add_argument("--faces", type=int, default=2000)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--scratch", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.scratch) as scratch:
        bench = Bench(options, pathlib.Path(scratch).resolve())
        for name in options.cases:
            CASES[name](bench)
    failed = sum(row["passed"] is False for row in bench.rows)
    skipped = sum(row["passed"] is None for row in bench.rows)
    print(f"{len(bench.rows)} cases: {len(bench.rows) - failed - skipped} pass, {failed} fail, {skipped} skipped")
    if options.out:
        options.out.write_text(json.dumps({"format": "coseg faults 1", "cases": bench.rows}, indent=1) + "\n", encoding="utf-8")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
