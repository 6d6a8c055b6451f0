"""coseg cuts a collection of 3D shapes into the same parts, without training data.

>>> import coseg
>>> result = coseg.segment([(vertices_a, faces_a), (vertices_b, faces_b), "c.off"], parts=4)
>>> result.labels[0]        # the part of every face of the first shape, 0 .. 3

Functions: segment, assign, describe, score, cluster, generate, load_mesh, mesh_files, draw. docs/python.md
explains them.
"""

from __future__ import annotations

import dataclasses
import os
from typing import List, Tuple, Union

import numpy as np

from . import _core
from ._alignment import Alignment
from ._clusters import Clusters, SubspaceClustering, cluster
from ._errors import Error, InputError, UsageError, translated as _translated
from ._measures import Description, Score, describe, score
from ._pictures import draw
from ._segmentation import Progress, Result, assign, segment
from ._shapes import MeshesLike, MeshLike, given_whole_number, path_bytes, text_bytes

__version__ = _core.version()

__all__ = ["Alignment", "Clusters", "Description", "Error", "InputError", "Mesh", "MeshLike", "MeshesLike", "Progress",
           "Result", "Score", "SubspaceClustering", "UsageError", "assign", "cluster", "describe", "draw", "generate",
           "load_mesh", "mesh_files", "option_names", "score", "segment"]


@dataclasses.dataclass(eq=False)
class Mesh:
    """A mesh as it stands in a file; segment() and the others take it as a shape.

    Attributes:
        vertices: (V, 3) float64.
        faces: (F, 3) integers where every face is a triangle, else a list of F arrays.
        labels: of a generated shape (F,) integers, its true parts; else None.
        name: of a generated shape; else "".
    """

    vertices: np.ndarray
    faces: Union[np.ndarray, List[np.ndarray]]
    labels: Union[np.ndarray, None] = None
    name: str = ""

    def arrays(self) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """vertices, corners and offsets: face f has the corners [offsets[f] .. offsets[f + 1])."""
        if isinstance(self.faces, np.ndarray):
            faces, corners = self.faces.shape if self.faces.ndim == 2 else (0, 0)
            return self.vertices, self.faces.reshape(-1), np.arange(faces + 1) * corners
        ends = np.cumsum([0] + [len(face) for face in self.faces])
        return self.vertices, np.concatenate([np.empty(0, dtype=np.intc), *self.faces]).astype(np.intc), ends


def _mesh(vertices: np.ndarray, corners: np.ndarray, offsets: np.ndarray, **more: object) -> Mesh:
    if np.all(np.diff(offsets) == 3):
        return Mesh(vertices, corners.reshape(-1, 3), **more)
    return Mesh(vertices, np.split(corners, offsets[1:-1]), **more)


def load_mesh(path: Union[str, "os.PathLike[str]"]) -> Mesh:
    """The mesh of a file in a format that `coseg run` reads, with as many faces as the file has, in its order."""
    with _translated():
        return _mesh(*_core.load_mesh(path_bytes(path)))


def mesh_files(*arguments: Union[str, "os.PathLike[str]"]) -> List[str]:
    """The mesh files that files, folders and "@LIST"s stand for, sorted by name."""
    with _translated():
        return list(_core.mesh_files([path_bytes(argument) for argument in arguments]))


def generate(family: str, count: int = 12, *, seed: int = 1, faces: int = 5000) -> List[Mesh]:
    """Shapes with known parts, the same as those of `coseg generate FAMILY --count --seed --faces`.

    family: airplane, ant, chair, cup, goblet, human, lamp, octopus, pliers, quadruped, table ...
    """
    for what, value, least, end in (("count", count, -2**31, 2**31), ("seed", seed, 0, 2**64),
                                    ("faces", faces, -2**31, 2**31)):
        if not least <= given_whole_number(what, value) < end:
            raise UsageError(f"{what}: {value!r} is not in {least} .. {end - 1}")
    family_name = text_bytes(f"family: {family!r}", str(family))
    with _translated():
        return [_mesh(*mesh, labels=labels, name=name)
                for name, mesh, labels in _core.generate(family_name, count, seed, faces)]


def option_names() -> List[str]:
    """The names of the options that segment() takes, with - for _."""
    return list(_core.option_names())
