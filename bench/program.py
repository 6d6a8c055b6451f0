"""What the benchmarks share: running the program, reading and writing meshes and labels, and tables."""
import json
import os
import resource
import shlex
import subprocess
import sys
import time

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.path.join(PROJECT, "build", "bin", "coseg")


class RunFailed(SystemExit):
    """A command that did not end well. A benchmark that does not catch it ends with the sentence and exit code 1."""


def parsed_with_options(parser):
    """The arguments of the command line, and the words behind `--`, which are options of `coseg run`."""
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    return parser.parse_args(words[:split]), words[split + 1:]


def command_output(words, timeout=None, environment=None):
    """What the command prints. Throws RunFailed where it ends with another code than 0, or not in time."""
    words = [str(word) for word in words]
    try:
        result = subprocess.run(words, capture_output=True, text=True, timeout=timeout, env=environment)
    except subprocess.TimeoutExpired as expired:
        raise RunFailed(f"{shlex.join(words)} took more than {timeout} s") from expired
    if result.returncode != 0:
        raise RunFailed(f"{shlex.join(words)} ended with {result.returncode}: {result.stderr.strip()[-500:]}")
    return result.stdout


def timed(words, environment=None):
    """Seconds of the wall clock and of the processor, which other work on the machine disturbs less; and what was printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    printed = command_output(words, environment=environment)
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, printed


def run_labels(arguments, parts, out, words):
    """A run on `arguments.ranks` ranks that leaves labels, and neither pictures nor a model. `words`: options and meshes."""
    command_output(["mpirun", "--oversubscribe", "-n", arguments.ranks, arguments.coseg, "run", "--quiet", "--no-sheet", "--no-html",
                    "--no-keep-model", "--force", "--parts", parts, "--out", out, *words])


def one_to_one(arguments, truth, labels, meshes):
    """The accuracy of the labels in a folder, in percent."""
    return json.loads(command_output([arguments.coseg, "score", "--json", "--truth", truth, "--labels", labels, *meshes]))["one_to_one"]


def read_off(path):
    """The points of an OFF file, and its faces as tuples of numbers of points."""
    with open(path, encoding="latin-1") as file:
        rows = [words for words in (line.split("#")[0].split() for line in file) if words]
    if rows[0][0] == "OFF":
        rows = rows[1:] if len(rows[0]) == 1 else [rows[0][1:]] + rows[1:]
    elif not rows[0][0].isdigit():
        sys.exit(f"{path} is not an OFF file with the keyword OFF")
    vertices, faces = int(rows[0][0]), int(rows[0][1])
    points = [tuple(map(float, row[:3])) for row in rows[1:1 + vertices]]
    return points, [tuple(map(int, row[1:1 + int(row[0])])) for row in rows[1 + vertices:1 + vertices + faces]]


def read_labels(path):
    with open(path) as file:
        return [int(word) for word in file.read().split()]


def markdown(rows):
    head, *body = rows
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in body]) + "\n"


def write_whole(path, text):
    """A reader, or a second call after a kill, sees the old file or the new one."""
    with open(path + ".partial", "w") as file:
        file.write(text)
    os.replace(path + ".partial", path)
