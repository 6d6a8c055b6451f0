"""segment and assign, and what they give."""

from __future__ import annotations

import dataclasses
import json
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._alignment import Alignment, alignment_of
from ._errors import InputError, UsageError, translated
from ._shapes import (MeshesLike, given_communicator, given_options, given_path, given_progress, given_shapes,
                      given_switch, given_whole_number, path_bytes)

#: Called as progress(stage, done, total) whenever a stage begins (0, 0), gets further, and ends (1, 1). It is
#: called on every rank. What it raises ends the call.
Progress = Callable[[str, int, int], Any]


@dataclasses.dataclass
class Result:
    """Consistent labels of a collection; lists are in the order of the shapes that were given.

    Attributes:
        parts: K. A part has the same number in every shape.
        names: S names.
        labels: S arrays of F integers, the part of each face, 0 .. K-1; None for a shape that was set aside.
        patches: S arrays of F integers, the patch of each face in the first over-segmentation; None likewise.
        part_areas: (S, K) shares of each shape's area; rows of NaN for shapes that were set aside.
        certificate: how far the coefficients are from the optimum: objective, lower_bound (proven),
            relative_gap, reached (whether the gap that was asked for was), reason, iterations, nonzero_pairs.
        report: what report.json holds; see docs/formats.md.
        warnings: sentences about the run and about shapes.
        set_aside: index of a shape -> why it could not be used (only with strict=False).
        folder: where the results lie as files, or None.
        alignment: how each shape is turned, scaled and moved to stand like the others, of assign() like
            the shapes of the run; None from folders of runs that have no alignment.json.
    """

    parts: int
    names: List[str]
    labels: List[Optional[np.ndarray]]
    patches: List[Optional[np.ndarray]]
    part_areas: np.ndarray
    certificate: Dict[str, Any]
    report: Dict[str, Any]
    warnings: List[str] = dataclasses.field(default_factory=list)
    set_aside: Dict[int, str] = dataclasses.field(default_factory=dict)
    folder: Optional[str] = None
    alignment: Optional[Alignment] = None
    _model: Any = dataclasses.field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        faces = sum(len(row) for row in self.labels if row is not None)
        return f"coseg.Result({len(self.names)} shapes, {faces} faces, {self.parts} parts)"

    @classmethod
    def load(cls, folder: Union[str, "os.PathLike[str]"]) -> "Result":
        """The result of a finished run from its folder: what `coseg run --out` or segment(out=...) wrote.

        Shapes are in the order of the report, which is that of their names. Raises InputError for a folder
        that holds no run. `warnings` also names report.json and label files that are not as the run wrote them.
        """
        folder = os.fsdecode(given_path(folder))
        path = os.path.join(folder, "report.json")
        try:
            with open(path, encoding="utf-8") as file:
                report = json.load(file)
            if report.get("format") != "coseg report 1":
                raise ValueError("coseg has not written it")
        except (OSError, ValueError) as error:
            raise InputError(f"'{folder}' is no run: report.json cannot be read ({error}); name the folder that "
                             "coseg run was given with --out") from None
        with translated():
            changed = list(_core.changed_files(path_bytes(folder)))
        meshes = report["meshes"]
        names = [_name_of(mesh) for mesh in meshes]
        solution = report["optimisation"]
        areas = np.array([mesh["part_area"] for mesh in meshes], dtype=np.float64)
        return cls(
            parts=int(report["options"]["parts"]) if "parts" in report["options"] else areas.shape[1],
            names=names,
            labels=[_read_labels(folder, "labels", name, mesh["faces"]) for name, mesh in zip(names, meshes)],
            patches=[_read_labels(folder, "patches", name, mesh["faces"]) for name, mesh in zip(names, meshes)],
            part_areas=areas,
            certificate={"objective": solution["objective"], "lower_bound": solution["lower_bound"],
                         "relative_gap": solution["relative_gap"], "reached": solution["reason"] == "gap_reached",
                         "reason": solution["reason"], "iterations": solution["iterations"],
                         "nonzero_pairs": solution["nonzero_groups"]},
            report=report,
            warnings=changed + [warning for mesh in meshes for warning in mesh["warnings"]],
            folder=folder,
            alignment=_read_alignment(folder, names))


def _name_of(mesh: Dict[str, Any]) -> str:
    if "name_bytes" in mesh:
        return os.fsdecode(bytes.fromhex(mesh["name_bytes"]))
    return mesh["name"]


def _read_labels(folder: str, kind: str, name: str, faces: int) -> np.ndarray:
    path = os.path.join(folder, kind, name + ".seg")
    try:
        labels = np.loadtxt(path, dtype=np.intc, ndmin=1)
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as labels ({error})") from None
    if labels.shape != (faces,):
        raise InputError(f"{path}: {labels.size} labels for {faces} faces")
    return labels


def _read_alignment(folder: str, names: List[str]) -> Optional[Alignment]:
    path = os.path.join(folder, "alignment.json")
    if not os.path.exists(path):
        return None
    try:
        with open(path, encoding="utf-8") as file:
            raw = json.load(file)
        if [_name_of(shape) for shape in raw["shapes"]] != names:
            raise ValueError("it has other shapes than report.json")
        return alignment_of(raw, [False] * len(names))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: cannot be read as an alignment ({error})") from None


def _result(raw: Dict[str, Any], folder: Optional[str]) -> Result:
    shapes = raw["shapes"]
    parts = raw["parts"]
    areas = np.full((len(shapes), parts), np.nan)
    for row, shape in zip(areas, shapes):
        if not shape["set_aside"]:
            row[:] = shape["part_areas"]

    def used(key: str) -> list:
        return [None if shape["set_aside"] else shape[key] for shape in shapes]

    return Result(parts=parts, names=[shape["name"] for shape in shapes], labels=used("labels"),
                  patches=used("patches"), part_areas=areas, certificate=raw["certificate"],
                  report=json.loads(raw["report"]), warnings=list(raw["warnings"]),
                  set_aside={k: shape["set_aside"] for k, shape in enumerate(shapes) if shape["set_aside"]},
                  folder=folder, _model=raw["model"],
                  alignment=alignment_of(raw["alignment"], [bool(shape["set_aside"]) for shape in shapes]))


def _number_of_parts(value: Any) -> int:
    if isinstance(value, str):
        if value != "auto":
            raise UsageError(f"parts: {value!r} is neither a whole number nor 'auto'")
        return _core.automatic_parts
    parts = given_whole_number("parts", value)
    if not 1 <= parts <= 1000:
        raise UsageError(f"parts: {parts} is not in 1 .. 1000")
    return parts


def _arguments(strict: bool, out: Any, replace: bool, state: Any) -> Any:
    arguments = _core.SegmentArguments()
    arguments.strict = given_switch("strict", strict)
    arguments.folder = given_path(out)
    arguments.replace = given_switch("replace", replace)
    arguments.state = given_path(state)
    return arguments


def segment(meshes: MeshesLike, parts: Union[int, str], *, names: Optional[Sequence[str]] = None, out: Any = None,
            replace: bool = False, state: Any = None, strict: bool = True, keep_model: bool = True,
            comm: Any = None, progress: Optional[Progress] = None, **options: Any) -> Result:
    """Cuts all shapes of a collection into the same parts.

    Args:
        meshes: a list whose elements are paths or (vertices, faces): vertices (V, 3) numbers in any unit,
            faces (F, k) vertex numbers from 0, or F sequences of them. Or a folder of mesh files. Two shapes
            are the least that make sense; four or more are better.
        parts: K, 1 .. 1000, or "auto": 2 to 12, found from the shapes.
        names: of the shapes, unique and without '/'. The randomness of a shape is drawn by its name, so that
            shapes of the same names have the same labels as `coseg run` gives them. Without: the names of the
            files, and "shape_0007" for arrays.
        out: a folder, new or empty unless replace=True, into which results are written as by `coseg run --out`.
        state: a folder that keeps what is computed, as by `coseg run --state`.
        strict: whether a shape that cannot be used raises InputError. Otherwise it is set aside.
        keep_model: whether the result can be given to assign().
        comm: a communicator of mpi4py, or "world": the processes share the work, and each has the whole
            result. All of them must make the same call. None: this process works alone.
        progress: see Progress.
        **options: every option of `coseg run --help-all` by its name, with _ for -: patches=30, seed=2,
            preset="paper", choose=False, feature_weights=[1, 1, 1, 0, 0], lambda_=100.

    Returns:
        A Result. The same shapes, names and options give the same bytes in every call, on any number of
        processes, and as `coseg run` gives them.

    Raises:
        UsageError: an option; InputError: a shape, named by its index (counted from 0) and face; Error:
        anything else. KeyboardInterrupt on Ctrl-C, when the next mesh or tile of columns is done.
    """
    arguments = _arguments(strict, out, replace, state)
    arguments.parts = _number_of_parts(parts)
    arguments.options = given_options(options)
    arguments.keep_model = given_switch("keep_model", keep_model)
    shapes = given_shapes(meshes, names)
    with translated():
        raw = _core.segment(shapes, arguments, given_communicator(comm), given_progress(progress))
    return _result(raw, None if out is None else os.fsdecode(out))


def assign(meshes: MeshesLike, to: Union[Result, str, "os.PathLike[str]"], *,
           names: Optional[Sequence[str]] = None, examples: Any = None, out: Any = None, replace: bool = False,
           state: Any = None, strict: bool = True, comm: Any = None, progress: Optional[Progress] = None) -> Result:
    """Labels new shapes like those of a finished run, in seconds and without solving it again.

    Args:
        meshes: the new shapes, as in segment().
        to: a Result of segment(), or the folder of a run.
        examples: a folder with NAME.seg for some of the new shapes: one part of the run for each face, or -1
            where nothing is said. These faces keep their parts, and new shapes that are like them follow.
        Others: as in segment(). Options are those of the run.

    Returns:
        A Result whose part k is part k of the run.
    """
    communicator = given_communicator(comm)
    if isinstance(to, Result):
        model = to._model
        if model is None and to.folder is None:
            raise UsageError("the result has no model; call segment with keep_model=True")
    else:
        model = None
    shapes = given_shapes(meshes, names)
    arguments = _arguments(strict, out, replace, state)
    arguments.examples = given_path(examples)
    with translated():
        if model is None:
            model = _core.load_model(to.folder if isinstance(to, Result) else given_path(to), communicator)
        raw = _core.assign(shapes, model, arguments, communicator, given_progress(progress))
    return _result(raw, None if out is None else os.fsdecode(out))
