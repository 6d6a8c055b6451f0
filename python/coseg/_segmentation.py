"""segment and assign, and what they give."""

from __future__ import annotations

import copy
import dataclasses
import json
import os
import re
from typing import Any, Callable, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._alignment import Alignment, alignment_of
from ._errors import InputError, UsageError, translated
from ._shapes import (MeshesLike, given_communicator, given_folder_of_run, given_options, given_parts, given_path,
                      given_progress, given_shapes, given_switch, path_bytes)

#: Called as progress(stage, done, total) whenever a stage begins (0, 0), gets further, and ends (1, 1). It is
#: called on every rank. What it raises ends the call.
Progress = Callable[[str, int, int], Any]


@dataclasses.dataclass(eq=False)
class Result:
    """Consistent labels of a collection; lists are in the order of the shapes that were given.

    It can be pickled, but without its model: assign() takes an unpickled result only where its folder is still there.
    Two results are equal only where they are the same object; compare their arrays.

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
    _model: Any = dataclasses.field(default=None, repr=False)
    _why_no_model: str = dataclasses.field(default="it has no model; call segment with keep_model=True", repr=False)

    def __repr__(self) -> str:
        faces = sum(len(row) for row in self.labels if row is not None)
        return f"coseg.Result({len(self.names)} shapes, {faces} faces, {self.parts} parts)"

    @classmethod
    def load(cls, folder: Union[str, "os.PathLike[str]"]) -> "Result":
        """The result of a finished run from its folder: what `coseg run --out` or segment(out=...) wrote.

        Shapes that segment() was given as arrays have the index that they had there; files, whose places the report
        does not tell, come in the order of their names in between. Shapes that were set aside are among them. Raises
        InputError for a folder that holds no run, and for labels that the run did not have. `warnings` has those of
        the run and of shapes, and also names report.json and label files that are not as the run wrote them.
        """
        folder = os.fsdecode(given_folder_of_run("folder", folder))
        report = _read_report(folder)
        with translated():
            changed = list(_core.changed_files(path_bytes(folder)))
        try:
            return _result_of_folder(folder, report, changed)
        except InputError:
            raise
        except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
            raise InputError(f"{os.path.join(folder, 'report.json')}: is not the report of a run "
                             f"({type(error).__name__}: {error})") from None

    def __getstate__(self) -> Dict[str, Any]:
        why = "its model was left out when it was pickled; call segment again, or with out= and assign to that folder"
        return {**self.__dict__, "_model": None, **({} if self._model is None else {"_why_no_model": why})}

    def __copy__(self) -> "Result":
        return dataclasses.replace(self)

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Result":
        # Nothing changes a model, so that a copy may share it.
        return dataclasses.replace(self, **{one.name: copy.deepcopy(getattr(self, one.name), memo)
                                            for one in dataclasses.fields(self) if one.name != "_model"})


def _read_report(folder: str) -> Dict[str, Any]:
    try:
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        if not isinstance(report, dict) or report.get("format") != "coseg report 1":
            raise ValueError("coseg has not written it")
        return report
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"'{folder}' is no run: report.json cannot be read ({error}); name the folder that "
                         "coseg run was given with --out") from None


def _name_of(mesh: Dict[str, Any]) -> str:
    if "name_bytes" in mesh:
        return os.fsdecode(bytes.fromhex(mesh["name_bytes"]))
    return mesh["name"]


#: What stands in a report for the path of a shape that was given as arrays.
_GIVEN_AS_ARRAYS = re.compile(r"shape (\d+)(?: \('(.*)'\))?", re.DOTALL)


def _in_given_order(report: Dict[str, Any]) -> List[Dict[str, Any]]:
    """The shapes of a report, with a `name` each, those set aside too; arrays at the index that they had, and files in
    the order of their names in between."""
    entries = [{**mesh, "name": _name_of(mesh)} for mesh in report["meshes"]]
    places = {}
    for away in report["set_aside"]:
        name = os.path.splitext(os.path.basename(away["path"]))[0]
        if (given := _GIVEN_AS_ARRAYS.fullmatch(away["path"])) is not None:
            name = given[2] if given[2] is not None else f"shape_{int(given[1]):04}"
        entries.append({**away, "name": name})
    entries.sort(key=lambda entry: os.fsencode(entry["name"]))
    for entry in entries:
        if (given := _GIVEN_AS_ARRAYS.fullmatch(entry["path"])) is not None:
            places[int(given[1])] = entry
    if any(place >= len(entries) for place in places):  # of a report that something else has changed
        return entries
    taken = {id(entry) for entry in places.values()}
    others = iter([entry for entry in entries if id(entry) not in taken])
    return [places[k] if k in places else next(others) for k in range(len(entries))]


def _result_of_folder(folder: str, report: Dict[str, Any], changed: List[str]) -> Result:
    shapes = _in_given_order(report)
    names = [shape["name"] for shape in shapes]
    set_aside = {k: shape["reason"] for k, shape in enumerate(shapes) if "reason" in shape}
    used = [shape for shape in shapes if "reason" not in shape]
    solution = report["optimisation"]
    parts = len(used[0]["part_area"])
    areas = np.array([shape.get("part_area", [np.nan] * parts) for shape in shapes], dtype=np.float64)

    def read(kind: str, end: Callable[[Dict[str, Any]], int]) -> List[Optional[np.ndarray]]:
        return [None if k in set_aside else
                _read_labels(os.path.join(folder, kind, shape["name"] + ".seg"), shape["faces"], end(shape))
                for k, shape in enumerate(shapes)]

    return Result(
        parts=parts, names=names, labels=read("labels", lambda shape: parts),
        patches=read("patches", lambda shape: shape["patches"]), part_areas=areas,
        certificate={"objective": solution["objective"], "lower_bound": solution["lower_bound"],
                     "relative_gap": solution["relative_gap"], "reached": solution["reason"] == "gap_reached",
                     "reason": solution["reason"], "iterations": solution["iterations"],
                     "nonzero_pairs": solution["nonzero_groups"]},
        report=report,
        warnings=changed + [f"set aside: {reason}" for reason in set_aside.values()] +
        [warning for shape in used for warning in shape["warnings"]] + [str(one) for one in report.get("warnings", [])],
        set_aside=set_aside, folder=folder, alignment=_read_alignment(folder, names, set_aside))


_LABEL = re.compile(rb"-?[0-9]{1,18}")
_LABELS = re.compile(rb"\s*(?:-?[0-9]{1,18}[ \t\r]*(?:\n\s*|\Z))*")


def _read_labels(path: str, faces: int, end: int) -> np.ndarray:
    """Of one integer a line, each in 0 .. end - 1."""
    try:
        with open(path, "rb") as file:
            text = file.read()
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as labels ({error})") from None
    if _LABELS.fullmatch(text) is None:
        for number, line in enumerate(text.split(b"\n"), 1):
            if line.strip() and _LABEL.fullmatch(line.strip()) is None:
                raise InputError(f"{path}:{number}: a label file has one integer a line, but this line has "
                                 f"'{line.strip()[:40].decode('utf-8', 'replace')}'")
    labels = np.array([int(word) for word in text.split()], dtype=np.int64)
    if labels.shape != (faces,):
        raise InputError(f"{path}: {labels.size} labels for {faces} faces")
    wrong = np.flatnonzero((labels < 0) | (labels >= end))
    if len(wrong):
        raise InputError(f"{path}: face {wrong[0]} has {labels[wrong[0]]}, which the run did not have; correct the "
                         "file, or run coseg run again")
    return labels.astype(np.intc)


def _read_alignment(folder: str, names: List[str], set_aside: Dict[int, str]) -> Optional[Alignment]:
    path = os.path.join(folder, "alignment.json")
    if not os.path.exists(path):
        return None
    try:
        with open(path, encoding="utf-8") as file:
            raw = json.load(file)
        rows = {_name_of(shape): shape for shape in raw["shapes"]}
        if len(rows) != len(raw["shapes"]) or set(rows) != {name for k, name in enumerate(names) if k not in set_aside}:
            raise ValueError("it has other shapes than report.json")
        nothing = {"rotation": [[np.nan] * 3] * 3, "scale": np.nan, "translation": [np.nan] * 3, "agreement": np.nan,
                   "residual": np.nan, "reflected": False, "found": False}
        shapes = [nothing if k in set_aside else rows[name] for k, name in enumerate(names)]
        return alignment_of({**raw, "shapes": shapes}, [k in set_aside for k in range(len(names))])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: cannot be read as an alignment ({error})") from None


def _result(raw: Dict[str, Any], folder: Optional[str], **more: Any) -> Result:
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
                  folder=folder, _model=raw["model"], **more,
                  alignment=alignment_of(raw["alignment"], [bool(shape["set_aside"]) for shape in shapes]))


_OF_ASSIGN = "it is of assign(); give the result of segment() or the folder of the run"


def _number_of_parts(value: Any) -> int:
    if isinstance(value, str):
        if value != "auto":
            raise UsageError(f"parts: {value!r} is neither a whole number nor 'auto'")
        return _core.automatic_parts
    return given_parts(value)


def _arguments(strict: bool, out: Any, replace: bool, state: Any) -> Any:
    arguments = _core.SegmentArguments()
    arguments.strict = given_switch("strict", strict)
    arguments.folder = given_path("out", out)
    arguments.replace = given_switch("replace", replace)
    arguments.state = given_path("state", state)
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
        if model is None and (to.folder is None or to._why_no_model == _OF_ASSIGN):
            raise UsageError(f"the result cannot be assigned to: {to._why_no_model}")
        folder = to.folder
    else:
        model, folder = None, given_folder_of_run("to", to)
    shapes = given_shapes(meshes, names)
    arguments = _arguments(strict, out, replace, state)
    arguments.examples = given_path("examples", examples)
    with translated():
        if model is None:
            model = _core.load_model(path_bytes(folder), communicator)
        raw = _core.assign(shapes, model, arguments, communicator, given_progress(progress))
    return _result(raw, None if out is None else os.fsdecode(out),
                   _why_no_model=_OF_ASSIGN)
