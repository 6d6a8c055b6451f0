#!/usr/bin/env python3
"""Checks what makes comments and documents hard to read: lines that are too long, comments that are torn over two lines,
and paths in documents that lead nowhere.

usage: lint_words.py SOURCE_DIR      prints each violation as FILE:LINE: sentence; exit code 1 if there is any
       lint_words.py --self-test     shows on a made-up tree that every rule can fail, and that a clean one passes
"""
import glob
import os
import re
import sys

import lint_self_test

CODE_FOLDERS = ("include", "src", "io", "solvers", "mpi_drivers", "python", "tests", "bench", "examples")
LONGEST_COMMENT = 110
LONGEST_DOCUMENT_LINE = 200
# A row of a table cannot be wrapped; what needs more room than this belongs into the text below the table.
LONGEST_TABLE_ROW = 400
# Tells of paths as they were at the time.
CHANGELOG = "CHANGELOG.md"
COMMENT = re.compile(r"//.*$")
# What a document names between backquotes or links to. Capitals stand for a name that the reader fills in.
NAMED_PATH = re.compile(r"`((?:include|src|io|solvers|mpi_drivers|python|tests|bench|docs|jobs|examples)/[a-z0-9_./*-]+)[`:]")
LINKED_PATH = re.compile(r"\]\(((?![a-z]+:)[^)#]+)")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')


def comment_column(line):
    """Where a comment begins, or -1. What stands in a string is no comment."""
    bare = STRING.sub(lambda text: "_" * len(text.group(0)), line)
    found = COMMENT.search(bare)
    return found.start() if found else -1


def violations_in_code(path, lines):
    column_before, trailing_before = -1, False
    for number, line in enumerate(lines, 1):
        column = comment_column(line)
        alone = column >= 0 and not line[:column].strip()
        if column >= 0 and len(line) > LONGEST_COMMENT:
            yield f"{path}:{number}: a comment of {len(line)} columns, {LONGEST_COMMENT} at most: wrap it"
        if alone and trailing_before and column == column_before:
            yield f"{path}:{number}: a trailing comment goes on in this line: put it above what it explains"
        elif alone and line[column:].startswith("///<"):
            yield f"{path}:{number}: nothing stands before this trailing comment: put it above what it explains"
        column_before, trailing_before = column, column >= 0 and not alone


def is_there(path):
    """A path may leave out the ending of a unit, and may hold wildcards."""
    return any(glob.glob(path + ending) for ending in ("", ".hpp", ".cpp"))


def violations_in_document(root, path, lines):
    here = os.path.dirname(path)
    for number, line in enumerate(lines, 1):
        named = [] if path == CHANGELOG else [(name, "") for name in NAMED_PATH.findall(line)]
        for name, folder in named + [(name, here) for name in LINKED_PATH.findall(line)]:
            if not is_there(os.path.join(root, folder, name)):
                yield f"{path}:{number}: {name} is not there: correct the path"
        if line.startswith("|"):
            if len(line) > LONGEST_TABLE_ROW:
                yield (f"{path}:{number}: a row of {len(line)} characters, {LONGEST_TABLE_ROW} at most: "
                       "say the rest below the table")
        elif len(line) > LONGEST_DOCUMENT_LINE:
            yield f"{path}:{number}: a line of {len(line)} characters, {LONGEST_DOCUMENT_LINE} at most: wrap it"


def files_below(folder, endings):
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "build")))
        for name in sorted(names):
            if name.endswith(endings):
                yield os.path.join(place, name)


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read().splitlines()


def violations(root):
    for folder in CODE_FOLDERS:
        for path in files_below(os.path.join(root, folder), (".cpp", ".hpp")):
            yield from violations_in_code(os.path.relpath(path, root), lines_of(path))
    for path in files_below(root, (".md",)):
        yield from violations_in_document(root, os.path.relpath(path, root), lines_of(path))


LONG_WORDS = "word " * 100
CLEAN_TREE = {
    "src/mesh/a.hpp": "/// The rank's area, in square units.\ndouble area;\nint faces;  ///< at least 1\n// Next.\nint x;  // one\n"
                      "int y;  // two\n    // a comment of its own, elsewhere\n" f'const char* s = "// {LONG_WORDS}";\n',
    "README.md": f"# Title\n\n{LONG_WORDS[:LONGEST_DOCUMENT_LINE]}\n| {LONG_WORDS[:300]} |\n"
                 "[b](docs/b.md) `src/mesh/a` `src/mesh/*.hpp` `src/NAME.hpp` [net](https://example.org/x)\n",
    "docs/b.md": "[up](../README.md#title)\n",
    "CHANGELOG.md": "`src/gone.hpp` has gone\n",
}
# file -> a text that breaks exactly one rule, and a piece of the sentence that must come out.
BROKEN_FILES = (
    ("src/mesh/x.hpp", f"/// {LONG_WORDS[:LONGEST_COMMENT]}\n", "wrap it"),
    ("tests/unit/x.cpp", f"int f();  // {LONG_WORDS[:LONGEST_COMMENT]}\n", "wrap it"),
    ("src/mesh/x.hpp", "int f;  ///< a long\n        ///< story\n", "goes on"),
    ("src/mesh/x.cpp", "int f;  // a long\n        // story\n", "goes on"),
    ("io/files/x.hpp", "int f;\n    ///< a story\n", "nothing stands before"),
    ("docs/x.md", LONG_WORDS + "\n", "wrap it"),
    ("CHANGELOG.md", f"| {LONG_WORDS} |\n", "below the table"),
    ("docs/x.md", "`src/mesh/gone.hpp`\n", "src/mesh/gone.hpp is not there"),
    ("docs/x.md", "[b](docs/b.md)\n", "docs/b.md is not there"),
)


def self_test():
    return lint_self_test.wrong_answers(CLEAN_TREE, BROKEN_FILES, violations)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found_now = self_test() if sys.argv[1] == "--self-test" else list(violations(sys.argv[1]))
    print("\n".join(found_now) if found_now else "words: nothing found")
    sys.exit(1 if found_now else 0)
