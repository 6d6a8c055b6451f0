"""describe and score."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, Iterable, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import translated
from ._segmentation import Progress, Result
from ._shapes import (MeshesLike, given_communicator, given_labels, given_options, given_progress,
                      given_shapes)


@dataclasses.dataclass(eq=False)
class Description:
    """The faces of one shape.

    Attributes:
        name: of the shape.
        areas: (F,) area of each face, in the square of the mesh's unit.
        descriptors: name -> (F,) or (F, d) values, free of scale: computed as if the shape's area were 1.
    """

    name: str
    areas: np.ndarray
    descriptors: Dict[str, np.ndarray]


def describe(meshes: MeshesLike, *, names: Optional[Sequence[str]] = None, comm: Any = None,
             progress: Optional[Progress] = None, **options: Any) -> List[Description]:
    """The descriptors of every face: Gaussian curvature, shape diameter, average geodesic distance, shape
    context, conformal factor, and with feature_weights=[1, 1, 1, 1, 1, 1] the wave kernel signature.

    meshes, names, comm, progress and exceptions are as in segment(), and a shape that cannot be used always raises. Of
    its **options these matter: seed, remesh, patches, geodesic_samples and feature_weights.
    """
    shapes = given_shapes(meshes, names)
    with translated():
        rows = _core.describe(shapes, given_options(options), given_communicator(comm), given_progress(progress))
    return [Description(*row) for row in rows]


@dataclasses.dataclass
class Score:
    """How well labels agree with the truth; shares in [0, 1], means over shapes.

    Attributes:
        accuracy: area of the faces whose part stands for their true label, with one assignment of parts to
            labels for all shapes.
        many_to_one: the same if every part takes the label that covers most of its area.
        one_part: the accuracy of one single part for everything, the figure to beat.
        rand_index: by area.
        shapes: for each shape the same without one_part.
    """

    accuracy: float
    many_to_one: float
    one_part: float
    rand_index: float
    shapes: List[Dict[str, float]]


def score(meshes: MeshesLike, labels: Union[Result, Iterable[Any]], truth: Iterable[Any]) -> Score:
    """Compares labels with known ones, as `coseg score` does.

    Args:
        meshes: S shapes, as in segment(); their areas count.
        labels: a Result, or S arrays of F integers; None for a shape without labels, which scores 0.
        truth: S arrays of F integers; the numbering is independent of that of the labels, and faces of
            negative truth never count as right.
    """
    rows = labels.labels if isinstance(labels, Result) else labels
    own, known = given_labels("labels", rows), given_labels("true labels", truth)
    with translated():
        return Score(**_core.score(given_shapes(meshes), own, known))
