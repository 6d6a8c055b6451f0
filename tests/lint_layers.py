#!/usr/bin/env python3
"""Checks the rules of CONTRIBUTING.md that a compiler does not: who may include whom, and what must not be named.

usage: lint_layers.py SOURCE_DIR      prints each violation as FILE:LINE: sentence; exit code 1 if there is any
       lint_layers.py --self-test     shows on a made-up tree that every rule can fail, and that a clean one passes
"""
import os
import re
import sys

import lint_self_test

# The layers whose headers each layer may include.
MAY_INCLUDE = {
    "src": {"src"},
    "io": {"io", "src"},
    "solvers": {"solvers", "src"},
    "mpi_drivers": {"mpi_drivers", "io", "solvers", "src"},
    "tests": {"tests", "mpi_drivers", "io", "solvers", "src"},
    "bench": {"bench", "mpi_drivers", "io", "solvers", "src"},
}
# The rooms whose headers each room may include, beside its own. Drivers join what the other layers offer, so that for them only
# rooms of their own layer are listed. A room stands below those that it includes: the table has no cycle.
ROOMS = {
    "src/base": (),
    "src/records": ("src/base",),
    "src/parallel": ("src/base", "src/records"),
    "src/mesh": ("src/base", "src/records"),
    "src/repair": ("src/base", "src/mesh"),
    "src/remesh": ("src/base", "src/mesh"),
    "src/geodesics": ("src/base", "src/mesh"),
    "src/descriptors": ("src/base", "src/mesh", "src/geodesics"),
    "src/patches": ("src/base", "src/mesh", "src/records"),
    "src/histograms": ("src/base", "src/parallel"),
    "src/metrics": ("src/base", "src/mesh", "src/geodesics"),
    "src/measures": ("src/base", "src/mesh", "src/metrics", "src/parallel", "src/records"),
    "src/pictures": ("src/base", "src/mesh"),
    "src/families": ("src/base", "src/mesh", "src/remesh"),
    "io/files": ("src/base", "src/records"),
    "io/gltf": ("io/files", "src/base", "src/pictures"),
    "io/mesh_files": ("io/files", "io/gltf", "src/base", "src/mesh", "src/pictures", "src/records"),
    "io/data_files": ("io/files", "src/base", "src/records"),
    "io/folders": ("io/data_files", "io/files", "src/base"),
    "io/part_files": ("io/files", "io/reports", "src/base", "src/measures", "src/mesh", "src/records"),
    "io/http": ("src/base",),
    # The part of the interface for other programs that needs no solver.
    "io/interface": ("io/files", "io/folders", "io/mesh_files", "src/base", "src/families", "src/mesh", "src/metrics"),
    "io/reports": ("io/files", "src/base", "src/mesh", "src/parallel", "src/pictures", "src/records"),
    "solvers/petsc": ("src/base", "src/parallel"),
    "solvers/numeric": ("src/base", "src/parallel"),
    "solvers/subspace": ("solvers/numeric", "src/base", "src/parallel", "src/histograms", "src/records"),
    "solvers/row_scope": ("solvers/subspace", "solvers/numeric", "src/base", "src/parallel"),
    "solvers/mesh_scope": ("solvers/subspace", "solvers/numeric", "src/base", "src/parallel"),
    "solvers/variants": ("solvers/row_scope", "solvers/mesh_scope", "solvers/subspace", "solvers/numeric", "src/base",
                         "src/parallel"),
    "solvers/oversegmentation": ("src/base", "src/mesh"),
    "solvers/kmeans": ("solvers/numeric", "src/base", "src/parallel", "src/histograms"),
    "solvers/affinity": ("solvers/subspace", "src/base", "src/parallel", "src/records"),
    "solvers/alignment": ("solvers/subspace", "src/base", "src/parallel", "src/records"),
    "solvers/spectral": ("solvers/affinity", "solvers/petsc", "src/base", "src/parallel", "src/histograms"),
    "solvers/boundaries": ("src/base", "src/mesh"),
    "solvers/choice": ("solvers/affinity", "solvers/boundaries", "src/base", "src/histograms", "src/metrics", "src/parallel",
                       "src/records"),
    "solvers/partition": ("solvers/affinity", "solvers/choice", "solvers/numeric", "solvers/spectral", "solvers/subspace",
                          "src/base", "src/histograms", "src/metrics", "src/parallel", "src/records"),
    "mpi_drivers/process": (),
    "mpi_drivers/options": (),
    "mpi_drivers/describe": ("mpi_drivers/process", "mpi_drivers/options"),
    "mpi_drivers/optimise": ("mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe"),
    "mpi_drivers/partition": ("mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe", "mpi_drivers/optimise"),
    "mpi_drivers/finished_runs": ("mpi_drivers/describe",),
    "mpi_drivers/results": ("mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe", "mpi_drivers/optimise",
                            "mpi_drivers/partition", "mpi_drivers/finished_runs"),
    "mpi_drivers/editing": ("mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe", "mpi_drivers/partition",
                            "mpi_drivers/results"),
    # co_segmentation, assignment and clustering, the lists of the stages; main.cpp belongs to no room.
    "mpi_drivers": ("mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe", "mpi_drivers/optimise",
                    "mpi_drivers/partition", "mpi_drivers/results", "mpi_drivers/editing"),
    "mpi_drivers/interface": ("mpi_drivers", "mpi_drivers/process", "mpi_drivers/describe", "mpi_drivers/optimise",
                              "mpi_drivers/options", "mpi_drivers/finished_runs"),
    "mpi_drivers/commands": ("mpi_drivers", "mpi_drivers/process", "mpi_drivers/options", "mpi_drivers/describe",
                             "mpi_drivers/optimise", "mpi_drivers/partition", "mpi_drivers/results",
                             "mpi_drivers/finished_runs", "mpi_drivers/editing"),
}
PROGRAM = "mpi_drivers/main.cpp"
MOST_UNITS = 25
LIBRARY = ("src", "io", "solvers", "mpi_drivers")
KNOWS_PETSC = ("solvers", "mpi_drivers", "tests", "bench")
PETSC = re.compile(r"(petsc|slepc)\w*\.h$|petsc/|slepc/")
# What a header of the library may include beside the C++ library: it becomes part of every file that includes it.
IN_HEADERS = re.compile(r"Eigen/|mpi\.h$|coseg/(coseg|shapes)\.hpp$")
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


def room_violation(path, quoted):
    """A sentence, or None: whether the room of the file `path` may include the header `quoted`."""
    room, other = os.path.dirname(path), os.path.dirname(quoted)
    if path == PROGRAM or room.split("/")[0] not in LIBRARY or other == room:
        return None
    if room not in ROOMS:
        return f"{room}/ is no room: add it to ROOMS in tests/lint_layers.py, and to docs/architecture.md"
    foreign = other.split("/")[0] != room.split("/")[0]
    if other in ROOMS[room] or (foreign and room.split("/")[0] == "mpi_drivers"):
        return None
    return f"the room {room}/ must not know {other}/"


def cycles(rooms):
    """The rooms from which a way leads back to themselves."""
    def reached(room, seen):
        for other in rooms.get(room, ()):
            if other not in seen:
                seen.add(other)
                reached(other, seen)
        return seen
    return sorted(room for room in rooms if room in reached(room, set()))


def crowded(root):
    """Folders of the library that hold more than MOST_UNITS units (a header and its source are one)."""
    for layer in LIBRARY:
        for place, _, names in sorted(os.walk(os.path.join(root, layer))):
            units = {name.rsplit(".", 1)[0] for name in names if name.endswith((".cpp", ".hpp"))}
            if len(units) > MOST_UNITS:
                yield f"{os.path.relpath(place, root)}:1: {len(units)} units in one folder, {MOST_UNITS} at most: split the room"


def without_comments(line):
    return line.split("//")[0]


def violations(root, rooms=None):
    yield from (f"tests/lint_layers.py:1: the rooms have a cycle through {room}/" for room in cycles(rooms or ROOMS))
    yield from crowded(root)
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
            if not sentence and include.group(1):
                sentence = room_violation(path, include.group(1))
            if sentence:
                yield f"{path}:{number}: {sentence}"
        for pattern, folders, sentence in FORBIDDEN:
            if folder in folders and pattern.search(without_comments(line)):
                yield f"{path}:{number}: {sentence}"


CLEAN_TREE = {
    "src/mesh/a.hpp": '#pragma once\n// MPI_COMM_WORLD is named in a comment only\n#include <Eigen/Core>\n#include <mpi.h>\n#include <vector>\n',
    "src/mesh/a.cpp": '#include "src/mesh/a.hpp"\n#include <OpenMesh/Core/IO/MeshIO.hh>\n',
    "io/files/b.hpp": '#pragma once\n#include "src/base/g.hpp"\n',
    "io/files/b.cpp": '#include "io/files/b.hpp"\n#include <nlohmann/json.hpp>\n',
    "solvers/numeric/c.hpp": '#pragma once\n#include <slepceps.h>\n#include "src/base/g.hpp"\n',
    "mpi_drivers/options/d.hpp": '#pragma once\n#include <CLI/CLI.hpp>\n',
    "mpi_drivers/options/d.cpp": '#include "io/files/b.hpp"\n#include "solvers/numeric/c.hpp"\nint f() { return MPI_COMM_WORLD; }\n',
    "tests/unit/e_test.cpp": '#include "mpi_drivers/options/d.hpp"\n#include "tests/support/f.hpp"\n#include <gtest/gtest.h>\n',
    "tests/support/f.hpp": '#pragma once\n',
    "src/base/g.hpp": '#pragma once\n',
    "mpi_drivers/main.cpp": '#include "mpi_drivers/options/d.hpp"\n',
}
# file -> a text that breaks exactly one rule, and a piece of the sentence that must come out.
BROKEN_FILES = (
    ("src/mesh/x.cpp", '#include "solvers/numeric/c.hpp"\n', "src/ must not know solvers/"),
    ("src/mesh/x.cpp", '#include "io/files/b.hpp"\n', "src/ must not know io/"),
    ("io/files/x.cpp", '#include "solvers/numeric/c.hpp"\n', "io/ must not know solvers/"),
    ("solvers/numeric/x.cpp", '#include "io/files/b.hpp"\n', "solvers/ must not know io/"),
    ("solvers/numeric/x.cpp", '#include "mpi_drivers/options/d.hpp"\n', "solvers/ must not know mpi_drivers/"),
    ("mpi_drivers/options/x.cpp", '#include "tests/support/f.hpp"\n', "mpi_drivers/ must not know tests/"),
    ("src/mesh/x.cpp", '#include "a.hpp"\n', "not rooted"),
    ("src/mesh/x.cpp", '#include <src/mesh/a.hpp>\n', "quotation marks"),
    ("src/mesh/x.cpp", '#include <petscmat.h>\n', "must not know PETSc"),
    ("io/files/x.hpp", '#pragma once\n#include <slepceps.h>\n', "must not know PETSc"),
    ("io/files/x.hpp", '#pragma once\n#include <OpenMesh/Core/IO/MeshIO.hh>\n', "inside a .cpp"),
    ("solvers/numeric/x.hpp", '#pragma once\n#include <boost/graph/adjacency_list.hpp>\n', "inside a .cpp"),
    ("src/mesh/x.hpp", '#pragma once\n#include <embree3/rtcore.h>\n', "inside a .cpp"),
    ("src/mesh/x.hpp", '#pragma once\n#include <CLI/CLI.hpp>\n', "inside a .cpp"),
    ("src/mesh/x.hpp", "int f();\n", "#pragma once"),
    ("solvers/numeric/x.cpp", "auto c = MPI_COMM_WORLD;\n", "world communicator"),
    ("src/mesh/x.cpp", "std::uniform_real_distribution<double> d;\n", "seeded_random"),
    ("io/files/x.cpp", "int i = rand();\n", "seeded_random"),
    ("src/mesh/x.cpp", "using namespace std;\n", "namespace"),
    ("src/base/x.cpp", '#include "src/mesh/a.hpp"\n', "the room src/base/ must not know src/mesh/"),
    ("mpi_drivers/process/x.cpp", '#include "mpi_drivers/options/d.hpp"\n', "must not know mpi_drivers/options/"),
    ("src/attic/x.cpp", '#include "src/base/g.hpp"\n', "src/attic/ is no room"),
)


def self_test():
    wrong = lint_self_test.wrong_answers(CLEAN_TREE, BROKEN_FILES, violations)
    many = {f"src/base/unit_{k}.cpp": "" for k in range(MOST_UNITS + 1)}
    if [f for f in lint_self_test.found_in({**CLEAN_TREE, **many}, violations) if "units in one folder" in f] == []:
        wrong.append(f"{MOST_UNITS + 1} units in one folder must be refused")
    if cycles({"a": ("b",), "b": ("c",), "c": ("b",)}) != ["b", "c"]:
        wrong.append("a cycle of rooms must be found")
    return wrong


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found_now = self_test() if sys.argv[1] == "--self-test" else list(violations(sys.argv[1]))
    print("\n".join(found_now) if found_now else "layers: nothing found")
    sys.exit(1 if found_now else 0)
