#!/usr/bin/env python3
"""Checks the rules of CONTRIBUTING.md that a compiler does not: who may include whom, and what must not be named.

usage: lint_layers.py SOURCE_DIR      prints each violation as FILE:LINE: sentence; exit code 1 if there is any
       lint_layers.py --self-test     shows on a made-up tree that every rule can fail, and that a clean one passes
"""
import os
import re
import sys
import tempfile

# The folders whose headers each folder may include.
MAY_INCLUDE = {
    "src": {"src"},
    "io": {"io", "src"},
    "solvers": {"solvers", "src"},
    "mpi_drivers": {"mpi_drivers", "io", "solvers", "src"},
    "tests": {"tests", "mpi_drivers", "io", "solvers", "src"},
    "bench": {"bench", "mpi_drivers", "io", "solvers", "src"},
}
LIBRARY = ("src", "io", "solvers", "mpi_drivers")
KNOWS_PETSC = ("solvers", "mpi_drivers", "tests", "bench")
PETSC = re.compile(r"(petsc|slepc)\w*\.h$|petsc/|slepc/")
# What a header of the library may include beside the C++ library: it becomes part of every file that includes it.
IN_HEADERS = re.compile(r"Eigen/|mpi\.h$")
STANDARD = re.compile(r"[a-z_0-9]+$")
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
FORBIDDEN = (
    (re.compile(r"\b(MPI|PETSC)_COMM_WORLD\b"), ("src", "io", "solvers"),
     "the world communicator belongs to mpi_drivers; take a Comm"),
    (re.compile(r"\bstd::(\w+_distribution|mt19937(_64)?|random_device|default_random_engine)\b|\bs?rand\s*\("), LIBRARY,
     "randomness comes from src/seeded_random.hpp, which gives the same numbers everywhere"),
    (re.compile(r"\busing\s+namespace\b"), LIBRARY, "name what you use instead of a whole namespace"),
)


def included_header_violation(folder, path, quoted, angled):
    """A sentence, or None."""
    if quoted:
        owner = quoted.split("/")[0]
        if owner not in MAY_INCLUDE:
            return f'"{quoted}" is not rooted: write "FOLDER/NAME.hpp", or <...> for a library'
        if owner not in MAY_INCLUDE[folder]:
            return f"{folder}/ must not know {owner}/"
        return None
    if PETSC.search(angled):
        return None if folder in KNOWS_PETSC else f"{folder}/ must not know PETSc or SLEPc"
    if re.match(r"(src|io|solvers|mpi_drivers)/", angled):
        return f'<{angled}> is ours: write it with quotation marks'
    if folder not in LIBRARY or not path.endswith(".hpp"):
        return None
    if STANDARD.match(angled) or IN_HEADERS.match(angled) or (folder == "mpi_drivers" and angled == "CLI/CLI.hpp"):
        return None
    return f"<{angled}> must stay inside a .cpp file"


def without_comments(line):
    return line.split("//")[0]


def violations(root):
    for folder in sorted(MAY_INCLUDE):
        for place, _, names in sorted(os.walk(os.path.join(root, folder))):
            for name in sorted(names):
                if name.endswith((".cpp", ".hpp")):
                    yield from violations_in(root, folder, os.path.join(place, name))


def violations_in(root, folder, file_path):
    path = os.path.relpath(file_path, root)
    with open(file_path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    if path.endswith(".hpp") and "#pragma once" not in lines:
        yield f"{path}:1: a header starts with #pragma once"
    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        if include:
            sentence = included_header_violation(folder, path, *include.groups())
            if sentence:
                yield f"{path}:{number}: {sentence}"
        for pattern, folders, sentence in FORBIDDEN:
            if folder in folders and pattern.search(without_comments(line)):
                yield f"{path}:{number}: {sentence}"


CLEAN_TREE = {
    "src/a.hpp": '#pragma once\n// MPI_COMM_WORLD is named in a comment only\n#include <Eigen/Core>\n#include <mpi.h>\n#include <vector>\n',
    "src/a.cpp": '#include "src/a.hpp"\n#include <OpenMesh/Core/IO/MeshIO.hh>\n',
    "io/b.hpp": '#pragma once\n#include "src/a.hpp"\n',
    "io/b.cpp": '#include "io/b.hpp"\n#include <nlohmann/json.hpp>\n',
    "solvers/c.hpp": '#pragma once\n#include <slepceps.h>\n#include "src/a.hpp"\n',
    "mpi_drivers/d.hpp": '#pragma once\n#include <CLI/CLI.hpp>\n',
    "mpi_drivers/d.cpp": '#include "io/b.hpp"\n#include "solvers/c.hpp"\nint f() { return MPI_COMM_WORLD; }\n',
    "tests/unit/e_test.cpp": '#include "mpi_drivers/d.hpp"\n#include "tests/support/f.hpp"\n#include <gtest/gtest.h>\n',
    "tests/support/f.hpp": '#pragma once\n',
}
# file -> a text that breaks exactly one rule, and a piece of the sentence that must come out.
BROKEN_FILES = (
    ("src/x.cpp", '#include "solvers/c.hpp"\n', "src/ must not know solvers/"),
    ("src/x.cpp", '#include "io/b.hpp"\n', "src/ must not know io/"),
    ("io/x.cpp", '#include "solvers/c.hpp"\n', "io/ must not know solvers/"),
    ("solvers/x.cpp", '#include "io/b.hpp"\n', "solvers/ must not know io/"),
    ("solvers/x.cpp", '#include "mpi_drivers/d.hpp"\n', "solvers/ must not know mpi_drivers/"),
    ("mpi_drivers/x.cpp", '#include "tests/support/f.hpp"\n', "mpi_drivers/ must not know tests/"),
    ("src/x.cpp", '#include "a.hpp"\n', "not rooted"),
    ("src/x.cpp", '#include <src/a.hpp>\n', "quotation marks"),
    ("src/x.cpp", '#include <petscmat.h>\n', "must not know PETSc"),
    ("io/x.hpp", '#pragma once\n#include <slepceps.h>\n', "must not know PETSc"),
    ("io/x.hpp", '#pragma once\n#include <OpenMesh/Core/IO/MeshIO.hh>\n', "inside a .cpp"),
    ("solvers/x.hpp", '#pragma once\n#include <boost/graph/adjacency_list.hpp>\n', "inside a .cpp"),
    ("src/x.hpp", '#pragma once\n#include <embree3/rtcore.h>\n', "inside a .cpp"),
    ("src/x.hpp", '#pragma once\n#include <CLI/CLI.hpp>\n', "inside a .cpp"),
    ("src/x.hpp", "int f();\n", "#pragma once"),
    ("solvers/x.cpp", "auto c = MPI_COMM_WORLD;\n", "world communicator"),
    ("src/x.cpp", "std::uniform_real_distribution<double> d;\n", "seeded_random"),
    ("io/x.cpp", "int i = rand();\n", "seeded_random"),
    ("src/x.cpp", "using namespace std;\n", "namespace"),
)


def found_in(tree):
    with tempfile.TemporaryDirectory() as root:
        for path, text in tree.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        return list(violations(root))


def self_test():
    wrong = [f"a clean tree is refused: {v}" for v in found_in(CLEAN_TREE)]
    for path, text, sentence in BROKEN_FILES:
        found = found_in({**CLEAN_TREE, path: text})
        if len(found) != 1 or not found[0].startswith(path + ":") or sentence not in found[0]:
            wrong.append(f"{path} with {text!r} must give one '{sentence}', gave {found}")
    return wrong


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found_now = self_test() if sys.argv[1] == "--self-test" else list(violations(sys.argv[1]))
    print("\n".join(found_now) if found_now else "layers: nothing found")
    sys.exit(1 if found_now else 0)
