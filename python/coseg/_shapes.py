"""Makes what the extension takes of what users give: shapes, labels, options and communicators."""

from __future__ import annotations

import atexit
import functools
import keyword
import math
import numbers
import operator
import os
import sys
from typing import Any, Iterable, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._errors import InputError, UsageError, translated

#: A mesh file, or a mesh in memory: (vertices, faces), or an object with these attributes such as trimesh's.
#: vertices: (V, 3) numbers in any unit. faces: (F, k) vertex numbers from 0, k at least 3, or F sequences of
#: them of different lengths, of which those with fewer than 3 corners have no area.
MeshLike = Union[str, "os.PathLike[str]", Tuple[Any, Any], Any]

#: A list of meshes, or a folder, file or "@LIST" that stands for the mesh files in it, sorted by name.
MeshesLike = Union[str, "os.PathLike[str]", Iterable[MeshLike]]

_NO_DOUBLES = np.empty(0, dtype=np.float64)
_NO_INTS = np.empty(0, dtype=np.intc)
_INT = np.iinfo(np.intc)


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def path_bytes(path: Any) -> bytes:
    """A path as the extension takes it: names of files need not be UTF-8."""
    try:
        encoded = os.fsencode(path)
    except TypeError:
        raise UsageError(f"{path!r} is no path") from None
    except UnicodeEncodeError:
        raise UsageError(f"{path!r} cannot be written as the name of a file") from None
    if not encoded:
        raise UsageError(f"{path!r} is no path, as it is empty")
    return encoded


def _not_empty(what: str, given: bytes) -> bytes:
    if not given:
        raise UsageError(f"{what}: has an empty value; give one, or leave it out")
    return given


def given_list(what: str, given: Any) -> list:
    """A list of what belongs to the shapes; text is none, though Python would take it for one of letters."""
    if isinstance(given, (str, bytes, dict)) or not hasattr(given, "__iter__"):
        raise UsageError(f"{what}: give a list with one for each shape, not {type(given).__name__}")
    return list(given)


def _vertices(shape: str, given: Any) -> np.ndarray:
    if np.ma.is_masked(given):
        raise InputError(f"{shape}: vertices are masked; leave them out, and their faces")
    try:
        vertices = np.asarray(given)
    except ValueError as error:
        raise InputError(f"{shape}: the vertices are no array: {error}") from None
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise InputError(f"{shape}: the vertices have the shape {vertices.shape}, not (V, 3)")
    if vertices.dtype.kind not in "fiu":
        raise InputError(f"{shape}: the vertices are of type {vertices.dtype}, not numbers")
    return np.ascontiguousarray(vertices, dtype=np.float64)


def _corners(shape: str, faces: np.ndarray, vertex_count: int, face_of: Any) -> np.ndarray:
    """As C's int. What that does not hold is refused here, other numbers by the program."""
    if faces.size and faces.dtype.kind not in "iu":
        raise InputError(f"{shape}: the faces are of type {faces.dtype}, not whole numbers")
    if faces.size and faces.dtype.itemsize >= np.dtype(np.intc).itemsize and (
            int(faces.max()) > _INT.max or int(faces.min()) < _INT.min):
        bad = int(np.flatnonzero((faces > _INT.max) | (faces < _INT.min))[0])
        raise InputError(f"{shape}: face {face_of(bad)} refers to vertex {faces[bad]}, but there are "
                         f"{vertex_count} vertices (counted from 0)")
    return np.ascontiguousarray(faces, dtype=np.intc)


def _polygons(shape: str, given: Any, vertex_count: int) -> Tuple[np.ndarray, np.ndarray]:
    """Corners and offsets of faces of different lengths."""
    rows = []
    for number, face in enumerate(given):
        row = np.asarray(face)
        if row.ndim != 1:
            raise InputError(f"{shape}: face {number} has the shape {row.shape}; it must be a list of vertex numbers")
        rows.append(row)
    lengths = np.fromiter((len(row) for row in rows), dtype=np.int64, count=len(rows))
    ends = np.cumsum(lengths)
    filled = [row for row in rows if len(row)]
    joined = np.concatenate(filled) if filled else _NO_INTS
    corners = _corners(shape, joined, vertex_count, lambda k: int(np.searchsorted(ends, k, side="right")))
    if len(ends) and ends[-1] > _INT.max:
        raise InputError(f"{shape}: the mesh has too many corners; split it")
    return corners, np.concatenate([[0], ends]).astype(np.intc)


def _faces(shape: str, given: Any, vertex_count: int) -> Tuple[np.ndarray, np.ndarray]:
    if np.ma.is_masked(given):
        raise InputError(f"{shape}: faces are masked; leave them out")
    faces = given if isinstance(given, np.ndarray) else None
    if faces is None:
        try:
            faces = np.asarray(given)
        except ValueError:  # rows of different lengths
            return _polygons(shape, given, vertex_count)
    if faces.dtype == object and faces.ndim == 1:
        return _polygons(shape, given, vertex_count)
    if faces.size == 0 and faces.ndim <= 2:
        return _NO_INTS, np.zeros(1, dtype=np.intc)
    if faces.ndim != 2 or faces.shape[1] < 3:
        raise InputError(f"{shape}: the faces have the shape {faces.shape}, not (F, k) with k at least 3")
    width = faces.shape[1]
    if faces.size > _INT.max:
        raise InputError(f"{shape}: the mesh has too many corners; split it")
    corners = _corners(shape, faces.reshape(-1), vertex_count, lambda k: k // width)
    if width == 3:
        return corners, _NO_INTS
    return corners, np.arange(0, faces.size + 1, width, dtype=np.intc)


def _arrays_of(index: int, mesh: Any) -> Tuple[Any, Any]:
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    raise InputError(f"shape {index}: give a path, (vertices, faces), or an object with these attributes, "
                     f"not {type(mesh).__name__}")


def given_shapes(meshes: MeshesLike, names: Optional[Sequence[str]] = None) -> list:
    """[(name, path, vertices, corners, offsets)] for the extension."""
    if _is_path(meshes):
        with translated():
            meshes = _core.mesh_files([path_bytes(meshes)])
    elif isinstance(meshes, np.ndarray) or hasattr(meshes, "vertices"):
        raise InputError("the meshes must be a list, as [(vertices, faces), ...], or a folder")
    meshes = given_list("the meshes", meshes)
    if names is not None:
        names = given_list("names", names)
        for index, name in enumerate(names):
            if not isinstance(name, str):
                raise UsageError(f"names: {name!r}, of shape {index}, is no text")
        if len(names) != len(meshes):
            raise UsageError(f"names: there are {len(names)} for {len(meshes)} shapes")
    shapes = []
    for index, mesh in enumerate(meshes):
        name = names[index] if names is not None else ""
        key = text_bytes(f"names: {name!r}, of shape {index},", name)
        if _is_path(mesh):
            shapes.append((key, path_bytes(mesh), _NO_DOUBLES, _NO_INTS, _NO_INTS))
            continue
        vertices, faces = _arrays_of(index, mesh)
        shape = f"shape {index}" + (f" ('{name}')" if name else "")
        vertices = _vertices(shape, vertices)
        shapes.append((key, "", vertices.reshape(-1), *_faces(shape, faces, len(vertices))))
    return shapes


def given_whole_number(what: str, value: Any) -> int:
    try:
        if isinstance(value, (bool, np.bool_)) or np.ndim(value) != 0:
            raise TypeError
        return operator.index(value)
    except (TypeError, ValueError):
        raise UsageError(f"{what}: {value!r} is no whole number") from None


def given_parts(value: Any) -> int:
    parts = given_whole_number("parts", value)
    if not 1 <= parts <= 1000:
        raise UsageError(f"parts: {parts} is not in 1 .. 1000")
    return parts


def _is_number(value: Any) -> bool:
    if isinstance(value, np.ndarray):
        return value.ndim == 0 and value.dtype.kind in "fiu"
    return isinstance(value, numbers.Real) and not isinstance(value, (bool, np.bool_))


def given_number(what: str, value: Any) -> float:
    if not _is_number(value):
        raise UsageError(f"{what}: {value!r} is no number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise UsageError(f"{what}: {value!r} is not finite; give a finite number")
    return number


def given_switch(what: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise UsageError(f"{what}: {value!r} is neither True nor False")
    return bool(value)


def text_bytes(what: str, value: str) -> bytes:
    try:
        return os.fsencode(value)
    except UnicodeEncodeError:
        raise UsageError(f"{what} has a character that is none") from None


def given_text(what: str, value: Any) -> str:
    if not isinstance(value, str):
        raise UsageError(f"{what}: {value!r} is no text")
    _not_empty(what, text_bytes(f"{what}: {value!r}", value))
    return value


def given_progress(progress: Any) -> Any:
    if progress is not None and not callable(progress):
        raise UsageError(f"progress: {progress!r} is no function")
    return progress


def _number_text(what: str, value: Any) -> str:
    number = given_number(what, value)
    return str(int(value)) if isinstance(value, numbers.Integral) else repr(number)


def _numbers_text(what: str, value: Any) -> str:
    if not isinstance(value, (list, tuple)) and not (isinstance(value, np.ndarray) and value.ndim):
        return _number_text(what, value)
    if len(value) == 0:
        raise UsageError(f"{what}: {value!r} is no list of numbers")
    return ",".join(_number_text(what, one) for one in value)


def _word_text(what: str, value: Any) -> Any:
    """Texts, paths, and numbers where the option may be one, as links=8."""
    if isinstance(value, os.PathLike):
        return path_bytes(value)
    if isinstance(value, str):
        return _not_empty(what, text_bytes(f"{what}: {value!r}", value))
    return _number_text(what, value) if _is_number(value) else given_text(what, value)


#: By what coseg::option_kinds says of an option.
_TEXT_OF_KIND = {"on or off": lambda what, value: "true" if given_switch(what, value) else "false",
                 "whole number": lambda what, value: str(given_whole_number(what, value)),
                 "number": _number_text, "numbers": _numbers_text, "text": _word_text}


@functools.lru_cache(maxsize=None)
def _option_kinds() -> Mapping[str, str]:
    return dict(zip(_core.option_names(), _core.option_kinds()))


def given_options(options: Mapping[str, Any]) -> list:
    """[(name, text)]: geodesic_samples=200 is the option --geodesic-samples 200."""
    given = []
    for name, value in options.items():
        option = name.rstrip("_").replace("_", "-")
        kind = _option_kinds().get(option)
        if kind is not None and name.endswith("_") and not keyword.iskeyword(name[:-1]):
            meant = option.replace("-", "_")
            raise UsageError(f"'{name}' is no option; did you mean '{meant + '_' * keyword.iskeyword(meant)}'?")
        if kind is None:
            given.append((option, ""))  # which the extension refuses, and says what was probably meant
        elif value is not None:
            given.append((option, _TEXT_OF_KIND[kind](name, value)))
    return given


@functools.lru_cache(maxsize=None)
def _end_together() -> None:
    """Sees to it that a process which fails alone does not leave the others waiting for ever.

    The extension does at the end of the process, when its exit code is known. Where mpi4py has started MPI, it ends MPI
    before that: there an exception ends the others here, and any other end is taken for a normal one.
    """
    before = sys.excepthook

    def tell_and_end(*told: Any) -> None:
        before(*told)
        sys.stderr.flush()
        _core.leave_failed()

    def wait_at_exit() -> None:
        if "mpi4py.MPI" in sys.modules:
            _core.leave_together(-1.0)

    sys.excepthook = tell_and_end
    atexit.register(wait_at_exit)


def given_communicator(comm: Any) -> Optional[int]:
    """The Fortran handle of a communicator of mpi4py or of anything with py2f(); "world" is all processes."""
    if comm is None:
        return None
    if isinstance(comm, str) and comm == "world":
        with translated():
            handle = _core.world()
        _end_together()
        return handle
    if hasattr(comm, "py2f"):
        with translated():
            _core.start()
        return int(comm.py2f())
    raise UsageError('comm: give a communicator of mpi4py, "world", or None')


def given_labels(what: str, labels: Iterable[Any]) -> list:
    rows = []
    for index, row in enumerate(given_list(what, labels)):
        if np.ma.is_masked(row):
            raise InputError(f"shape {index}: the {what} are masked; give a number for every face")
        array = _NO_INTS if row is None else np.asarray(row)
        if array.ndim != 1 or (array.size and array.dtype.kind not in "iub"):
            raise InputError(f"shape {index}: the {what} must be F whole numbers, not {array.dtype} of the "
                             f"shape {array.shape}")
        if array.size and (int(array.max()) > _INT.max or int(array.min()) < _INT.min):
            raise InputError(f"shape {index}: the {what} hold a number beyond 32 bits")
        rows.append(np.ascontiguousarray(array, dtype=np.intc))
    return rows


def given_path(what: str, path: Any) -> bytes:
    """Of an argument that may be left out."""
    if path is None:
        return b""
    return _not_empty(what, b"") if isinstance(path, (str, bytes)) and not path else path_bytes(path)


def given_folder_of_run(what: str, folder: Any) -> bytes:
    if folder is None:
        raise UsageError(f"{what}: give the folder of a run, not None")
    return given_path(what, folder)
