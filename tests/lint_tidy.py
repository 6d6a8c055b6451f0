#!/usr/bin/env python3
"""Runs clang-tidy over the library and the program, two files at a time, and remembers what was clean.

usage: lint_tidy.py SOURCE_DIR BUILD_DIR

A file is checked again when it, a header of ours that it includes, its compile command, .clang-tidy or clang-tidy
itself has changed. Exit code 0: clean; 1: something was found; 77: clang-tidy is not installed.
"""
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

FOLDERS = ("src", "io", "solvers", "mpi_drivers")
JOBS = 2
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def included_files(source, path, seen):
    """The file and the headers of ours that it includes, directly or not; all includes are rooted at SOURCE_DIR."""
    if path in seen or not os.path.isfile(os.path.join(source, path)):
        return seen
    seen.add(path)
    with open(os.path.join(source, path), encoding="utf-8") as file:
        for name in INCLUDE.findall(file.read()):
            included_files(source, name, seen)
    return seen


def fingerprint(source, path, command, common):
    digest = hashlib.sha256(common + command.encode())
    for name in sorted(included_files(source, path, set())):
        with open(os.path.join(source, name), "rb") as file:
            digest.update(name.encode() + b"\0" + file.read())
    return digest.hexdigest()


def compile_commands(source, build):
    """Relative path -> command line, for the sources that are checked."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    commands = {os.path.relpath(entry["file"], source): entry["command"] for entry in entries}
    return {path: commands[path] for path in sorted(commands) if path.split(os.sep)[0] in FOLDERS}


def check(source, build, path):
    run = subprocess.run(["clang-tidy", "-p", build, "--quiet", os.path.join(source, path)],
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    # Standard error only counts suppressed warnings, unless clang-tidy itself fails.
    return run.returncode == 0, run.stdout or run.stderr


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def save(path, content):
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(content, file, indent=1, sort_keys=True)
    os.replace(path + ".new", path)


def main(source, build):
    if shutil.which("clang-tidy") is None:
        print("skipped: clang-tidy is not installed")
        return 77
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE, check=True).stdout
    with open(os.path.join(source, ".clang-tidy"), "rb") as file:
        common = version + file.read()
    memory = os.path.join(build, "lint_tidy.json")
    prints = {path: fingerprint(source, path, command, common)
              for path, command in compile_commands(source, build).items()}
    clean = {path: digest for path, digest in load(memory).items() if path in prints}
    if not prints:
        print(f"error: {build}/compile_commands.json names no file in {', '.join(FOLDERS)}")
        return 1
    stale = [path for path in prints if clean.get(path) != prints[path]]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        for path, (ok, text) in zip(stale, pool.map(lambda path: check(source, build, path), stale)):
            if ok:
                clean[path] = prints[path]
                save(memory, clean)  # at once: a run that is stopped has not worked in vain
            else:
                failed += 1
                print(text, flush=True)
    print(f"clang-tidy: {len(prints)} files, {len(stale)} checked now, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])))
