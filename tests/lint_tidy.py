#!/usr/bin/env python3
"""Runs clang-tidy on all cores over what changed in the library and the program, and remembers what was clean.

usage: lint_tidy.py SOURCE_DIR BUILD_DIR      or      lint_tidy.py --self-test

Checked is what the compiler compiles together, a room or a source alone, if one of its files has changed since a commit,
the base. The base is COSEG_LINT_BASE if that is set; else the commit of origin/main that HEAD builds on; and where HEAD is
origin/main or there is none, the parent of HEAD. Changes that are not committed count. Everything is checked with
COSEG_LINT_ALL=1, where git knows no such commit, and where .clang-tidy or this script has changed.
Of that, what was clean before is checked again when it, a header of ours that it includes, its compile command,
.clang-tidy or clang-tidy itself has changed.
Exit code 0: clean; 1: something was found; 77: clang-tidy is not installed.
"""
import concurrent.futures
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

FOLDERS = ("src", "io", "solvers", "mpi_drivers")
RULES = (".clang-tidy", "tests/lint_tidy.py")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
# gcc's precompiled headers mean nothing to clang.
PRECOMPILED = re.compile(r"-Winvalid-pch|-fpch-preprocess|-include \S*cmake_pch\.hxx")


def git(source, *arguments):
    """The lines that git prints, or None if it fails."""
    try:
        run = subprocess.run(["git", "-C", source, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    except OSError:
        return None
    return run.stdout.splitlines() if run.returncode == 0 else None


def base_commit(source):
    """The commit that changes are counted from, or None."""
    named = os.environ.get("COSEG_LINT_BASE")
    if named:
        known = git(source, "rev-parse", "--verify", "--quiet", named + "^{commit}")
        if not known:
            sys.exit(f"error: COSEG_LINT_BASE={named} is no commit of this clone")
        return known[0]
    head = git(source, "rev-parse", "HEAD")
    common = git(source, "merge-base", "HEAD", "origin/main")
    if common and common != head:
        return common[0]
    parent = git(source, "rev-parse", "--verify", "--quiet", "HEAD^")
    return parent[0] if parent else None


def changed_files(source):
    """Paths that changed since the base, and a word about it; None for everything."""
    if os.environ.get("COSEG_LINT_ALL") == "1":
        return None, "COSEG_LINT_ALL=1"
    base = base_commit(source)
    if base is None:
        return None, "no commit to compare with"
    committed = git(source, "diff", "--name-only", "--no-renames", base)
    new = git(source, "ls-files", "--others", "--exclude-standard")
    if committed is None or new is None:
        return None, "git cannot compare"
    changed = set(committed) | set(new)
    if changed.intersection(RULES):
        return None, "the rules have changed"
    return changed, f"changed since {base[:10]}"


def includes(source, path):
    with open(os.path.join(source, path), encoding="utf-8") as file:
        names = INCLUDE.findall(file.read())
    return [os.path.relpath(name, source) if os.path.isabs(name) else name for name in names]


def included_files(source, path, seen):
    """The file and the files of ours that it includes, directly or not; all includes are rooted at SOURCE_DIR."""
    if path in seen or not os.path.isfile(os.path.join(source, path)):
        return seen
    seen.add(path)
    for name in includes(source, path):
        included_files(source, name, seen)
    return seen


def sources_of(source, path):
    """The sources of ours that are compiled as `path`: those that a generated source includes, or the file itself."""
    together = "/Unity/unity_" in "/" + path.replace(os.sep, "/")
    found = includes(source, path) if together else [path]
    return [name for name in found if name.split(os.sep)[0] in FOLDERS]


def concerns(source, path, changed):
    """Whether one of the sources that are compiled as `path`, or a header of its room's units, has changed."""
    if changed is None:
        return True
    stems = {os.path.splitext(name)[0] for name in sources_of(source, path)}
    if any(os.path.splitext(name)[0] in stems for name in changed):
        return True
    # A header without a source of its own is seen where its neighbours include it.
    alone = {name for name in changed if name.endswith(".hpp") and
             not os.path.isfile(os.path.join(source, os.path.splitext(name)[0] + ".cpp"))}
    return any(os.path.dirname(name) in {os.path.dirname(stem) for stem in stems} for name in alone)


def fingerprint(source, path, command, common):
    digest = hashlib.sha256(common + command.encode())
    for name in sorted(included_files(source, path, set())):
        with open(os.path.join(source, name), "rb") as file:
            digest.update(name.encode() + b"\0" + file.read())
    return digest.hexdigest()


def compile_commands(source, build):
    """Relative path -> entry of the compilation database without precompiled headers, for what is checked."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    found = {}
    for entry in entries:
        path = os.path.relpath(entry["file"], source)
        if os.path.isfile(entry["file"]) and sources_of(source, path):
            found[path] = dict(entry, command=PRECOMPILED.sub("", entry["command"]))
    return found


def check(source, database, path):
    run = subprocess.run(["clang-tidy", "--config-file", os.path.join(source, ".clang-tidy"), "-p", database, "--quiet",
                          os.path.join(source, path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
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
    commands = compile_commands(source, build)
    if not commands:
        print(f"error: {build}/compile_commands.json names no file in {', '.join(FOLDERS)}")
        return 1
    database = os.path.join(build, "lint")
    os.makedirs(database, exist_ok=True)
    save(os.path.join(database, "compile_commands.json"), list(commands.values()))
    memory = os.path.join(database, "clean.json")
    prints = {path: fingerprint(source, path, entry["command"], common) for path, entry in commands.items()}
    clean = {path: digest for path, digest in load(memory).items() if path in prints}
    changed, why = changed_files(source)
    concerned = [path for path in sorted(prints) if concerns(source, path, changed)]
    stale = [path for path in concerned if clean.get(path) != prints[path]]
    # The largest first, so that no core waits long for the last one.
    stale.sort(key=lambda path: -len(sources_of(source, path)))
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for path, (ok, text) in zip(stale, pool.map(lambda path: check(source, database, path), stale)):
            if ok:
                clean[path] = prints[path]
                save(memory, clean)  # at once: a run that is stopped has not worked in vain
            else:
                failed += 1
                print(text, flush=True)
    print(f"clang-tidy: of {len(prints)} compilations {len(concerned)} concerned ({why}), {len(stale)} checked now, "
          f"{failed} with findings")
    return 1 if failed else 0


def self_test():
    """Which compilations are chosen, in a repository of two rooms."""
    failures = []
    for name in ("COSEG_LINT_ALL", "COSEG_LINT_BASE"):
        os.environ.pop(name, None)

    def expect(what, chosen, wanted):
        if chosen != wanted:
            failures.append(f"{what}: {chosen}, not {wanted}")

    with tempfile.TemporaryDirectory() as source:
        def write(path, text):
            os.makedirs(os.path.dirname(os.path.join(source, path)) or source, exist_ok=True)
            with open(os.path.join(source, path), "w", encoding="utf-8") as file:
                file.write(text)

        def commit():
            git(source, "add", "-A", "src", "README")
            git(source, "-c", "user.name=t", "-c", "user.email=t@t", "commit", "-q", "-m", "t")

        room = os.path.join("build", "Unity", "unity_0_cxx.cxx")
        other = os.path.join("src", "b", "three.cpp")

        def chosen():
            changed, _ = changed_files(source)
            return [path for path in (room, other) if concerns(source, path, changed)]

        git(source, "init", "-q")
        expect("no commit at all", chosen() if write("README", "") is None and write(
            room, f'#include "{source}/src/a/one.cpp"\n#include "{source}/src/a/two.cpp"\n') is None else None, [room, other])
        for path in ("src/a/one.cpp", "src/a/two.cpp", "src/a/two.hpp", "src/a/types.hpp", other):
            write(path, "")
        write(".gitignore", "build\n.gitignore\n")
        commit()
        expect("one commit without a parent", chosen(), [room, other])
        write("README", "more\n")
        commit()
        expect("only a document in the last commit", chosen(), [])
        write("src/a/two.cpp", "int two;\n")
        expect("a source that is not committed", chosen(), [room])
        commit()
        expect("a source in the last commit", chosen(), [room])
        write("README", "still more\n")
        commit()
        expect("a source in the commit before the last", chosen(), [])
        git(source, "update-ref", "refs/remotes/origin/main", "HEAD~2")
        expect("a source since origin/main", chosen(), [room])
        os.environ["COSEG_LINT_BASE"] = "HEAD"
        expect("nothing since COSEG_LINT_BASE", chosen(), [])
        write(other, "int three;\n")
        write("src/a/types.hpp", "int types;\n")
        expect("a source, and a header without a source", chosen(), [room, other])
        os.environ["COSEG_LINT_ALL"] = "1"
        expect("COSEG_LINT_ALL=1", chosen(), [room, other])
    print("\n".join(failures) or "lint_tidy: the self-test passes")
    return 1 if failures else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])))
