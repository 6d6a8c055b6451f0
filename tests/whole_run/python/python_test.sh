#!/usr/bin/env bash
# The Python module as it is installed: module_test.py with pytest, scripts on two ranks, and the examples.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

build=$(cd "$(dirname "$COSEG")/.." && pwd)
python=$(sed -n 's/^Python_EXECUTABLE:[^=]*=//p' "$build/CMakeCache.txt")
python=${python:-/usr/bin/python3}
if ! compgen -G "$build/python/coseg/_core*.so" >/dev/null; then
    echo "skipped: the Python module is not built; it needs python3-dev, python3-numpy and pybind11-dev"
    exit 77
fi
"$python" -c "import pytest, scipy, matplotlib" || { echo "skipped: no pytest, scipy or matplotlib"; exit 77; }

cmake --install "$build" --component python --prefix "$work/prefix" >"$work/log" 2>&1 || { tail "$work/log"; fail "cmake --install"; }
[[ ! -e $work/prefix/bin && ! -e $work/prefix/include ]] || fail "the component has more than the module"
export PYTHONPATH=$work/prefix/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 MPLCONFIGDIR=$work
here=$(dirname "${BASH_SOURCE[0]}")
tables 6 "$work/set"
COSEG_WORK=$work/module COSEG_SET=$work/set timeout --signal=KILL 500 "$python" -m pytest -q -x -p no:cacheprovider "$here/module_test.py" ||
    fail "module_test.py"
echo "ok: module_test.py"

# Two processes that share the work, with and without mpi4py, give the bytes of one and of the program on two.
cat >"$work/shared.py" <<'END'
import hashlib
import os
import sys
import coseg
comm = "world"
if sys.argv[1] == "mpi4py":
    from mpi4py import MPI
    comm = MPI.COMM_WORLD
    try:
        coseg.cluster([[1, 0], [0, 1]], 2, comm=MPI.COMM_NULL)
        raise SystemExit("MPI_COMM_NULL was taken")
    except coseg.UsageError as error:
        assert "MPI_COMM_NULL" in str(error), error
files = coseg.mesh_files(sys.argv[4])[:4]
shapes = [coseg.load_mesh(path) for path in files]
names = [os.path.splitext(os.path.basename(path))[0] for path in files]
result = coseg.segment(shapes, 2, names=names, patches=20, geodesic_samples=50, oversegmentations=1, comm=comm)
assert result.report["ranks"] == int(sys.argv[2]), result.report["ranks"]
try:
    coseg.segment([shapes[0], ([[0, 0, 0]], [[0, 0, 9]])], 2, comm=comm)
    raise SystemExit("a bad shape was taken")
except coseg.InputError as error:
    assert "shape 1: face 0 refers to vertex 9" in str(error), error
# What differs between the ranks is named, and no rank waits for another.
def differ(call):
    try:
        call()
    except coseg.UsageError as error:
        assert "was given other" in str(error), error
    else:
        raise SystemExit("ranks that say different things were not told")

rank = int(os.environ.get("OMPI_COMM_WORLD_RANK", "0"))
few = dict(patches=20, geodesic_samples=50, oversegmentations=1, comm=comm)
if int(sys.argv[2]) > 1:
    differ(lambda: coseg.segment(shapes, 2 + rank, **few))
    differ(lambda: coseg.segment(shapes, 2, out=os.path.join(sys.argv[3], "nowhere") if rank == 0 else None, **few))
    differ(lambda: coseg.segment(shapes, 2, seed=1 + rank, **few))
    differ(lambda: coseg.segment(shapes, 2, keep_model=rank == 0, **few))
    differ(lambda: coseg.describe(shapes, geodesic_samples=50 + rank, comm=comm))
    differ(lambda: coseg.cluster([[2, 1], [1, 2], [2, 1], [1, 2]], 2 + rank, comm=comm))
    differ(lambda: coseg.assign(shapes, result, strict=rank == 0, comm=comm))
# A file a process: mpirun may run the lines of two processes into one.
with open(os.path.join(sys.argv[3], str(os.getpid())), "w") as file:
    print(hashlib.sha256(b"".join(labels.tobytes() for labels in result.labels)).hexdigest(), file=file)
END
mkdir "$work"/{alone,together,mpi4py}
"$python" "$work/shared.py" world 1 "$work/alone" "$work/set/meshes" || fail "a script on one process"

# give_the_bytes FOLDER : two processes wrote into FOLDER what one wrote into alone.
give_the_bytes() {
    [[ $(cat "$work/$1"/* | wc -l) -eq 2 && $(sort -u "$work/$1"/*) == "$(cat "$work/alone"/*)" ]] || fail "labels on two processes: $1"
}
# A program that a process of coseg starts is not part of it, and neither is a process that is forked from it.
cat >"$work/starts.py" <<'END'
import os
import subprocess
import sys
import coseg
matrix = [[2, 1], [1, 2], [2, 1], [1, 2]]
first = coseg.cluster(matrix, 2).labels.tolist()
subprocess.run(sys.argv[1:], check=True)
child = os.fork()
if child == 0:
    sys.exit(0)
assert os.waitpid(child, 0)[1] == 0
assert coseg.cluster(matrix, 2).labels.tolist() == first
END
timeout 120 "$python" "$work/starts.py" "$COSEG" run --ranks 2 --quiet --patches 10 --oversegmentations 1 --geodesic-samples 20 --no-choose --no-html \
    --no-sheet --parts 2 --out "$work/started" "$work/set/meshes" || fail "a program that is started by a process of coseg"
ranks 2 "$python" "$work/shared.py" world 2 "$work/together" "$work/set/meshes" || fail "a script on two processes"
give_the_bytes together
if "$python" -c "import mpi4py" 2>/dev/null; then
    ranks 2 "$python" "$work/shared.py" mpi4py 2 "$work/mpi4py" "$work/set/meshes" || fail "a script with mpi4py"
    give_the_bytes mpi4py
fi
# A process that fails alone ends the others, which wait for it in a call.
cat >"$work/fails.py" <<'END'
import os
import sys
import coseg
coseg.cluster([[2, 1], [1, 2], [2, 1], [1, 2]], 2, comm="world")
if sys.argv[1] == "all" or os.environ["OMPI_COMM_WORLD_RANK"] == "1":
    raise LookupError("a mistake of the script")
coseg.cluster([[2, 1], [1, 2], [2, 1], [1, 2]], 2, comm="world")
END
for who in one all; do
    status=0
    ranks 2 "$python" "$work/fails.py" "$who" >"$work/out" 2>&1 || status=$?
    [[ $status -ne 0 && $status -ne 137 ]] || fail "exit code $status where $who of two processes fails: $(cat "$work/out")"
    grep -q "LookupError: a mistake of the script" "$work/out" || fail "no traceback where $who of two processes fails"
done
if grep -q MPI_ABORT "$work/out"; then fail "processes that fail alike end by MPI_Abort"; fi
echo "ok: no process is left behind"
mkdir "$work/four"
cp "$work"/set/meshes/table_000[0-3].off "$work/four"
ranks 2 "$COSEG" run --quiet --parts 2 --patches 20 --geodesic-samples 50 --oversegmentations 1 --no-sheet --no-html \
    --out "$work/of_program" "$work/four" || fail "the program on two processes"
"$python" - "$work"/of_program/labels/*.seg >"$work/hash" <<'END'
import hashlib, sys
import numpy
print(hashlib.sha256(b"".join(numpy.loadtxt(path, dtype=numpy.int32).tobytes() for path in sys.argv[1:])).hexdigest())
END
[[ $(sort -u "$work/together"/*) == "$(cat "$work/hash")" ]] || fail "labels of two processes of Python and of the program"
echo "ok: two processes"

# The examples run, and draw; the cells of a notebook are run one after the other, as Jupyter would. All cut the same tables, which
# are made once.
cp -r "$COSEG_SOURCE/python/examples" "$work/examples"
awk '/^```/ { inside = ($0 == "```python") ; next } inside' "$COSEG_SOURCE/docs/python.md" >"$work/document.py"
"$python" - "$work" <<'END' || fail "the examples: $(cat "$work"/*.said)"
import contextlib, copy, functools, json, os, runpy, sys
import coseg
work = sys.argv[1]
made = functools.lru_cache(coseg.generate)
coseg.generate = lambda *given, **named: copy.deepcopy(made(*given, **named))

def run(name, *words):
    sys.argv = [name, *words]
    with open(f"{work}/{os.path.basename(name)}.said", "w") as said, contextlib.redirect_stdout(said):
        runpy.run_path(name, run_name="__main__")

run(f"{work}/examples/segment_generated.py", f"{work}/picture.png")
run(f"{work}/document.py")
notebook = json.load(open(f"{work}/examples/segment_generated.ipynb"))
assert notebook["nbformat"] == 4
code = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
assert sum(len(cell.strip().splitlines()) for cell in code[:2]) < 10, "more than 10 lines to the picture"
names = {}
for cell in code:
    *lines, last = cell.strip().splitlines()
    exec("\n".join(lines), names)
    shown = eval(last, names)
    names.setdefault("shown", []).append(shown)
figure = names["shown"][1]
figure.savefig(f"{work}/notebook.png")
assert len(figure.axes) == 12
# What Jupyter asks a result for. Nothing here has imported pyplot, which would tell it how to show any figure.
assert "matplotlib.pyplot" not in sys.modules and figure._repr_png_().startswith(b"\x89PNG"), "no picture in a notebook"
assert 0.8 < names["shown"][2] <= 1.0, names["shown"]
END
[[ $(head -c 4 "$work/picture.png" | tail -c 3) == PNG ]] || fail "segment_generated.py draws nothing"
grep -q "^accuracy 0\.[89]" "$work/segment_generated.py.said" || fail "segment_generated.py says $(cat "$work/segment_generated.py.said")"
grep -q "shape 0: face 0 refers to vertex 7, but there are 3 vertices" "$work/document.py.said" ||
    fail "docs/python.md says $(cat "$work/document.py.said")"
echo "ok: the examples and the document"
