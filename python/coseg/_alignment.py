"""How the shapes of a collection are brought to stand alike."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Optional

import numpy as np

from ._errors import InputError, UsageError
from ._shapes import given_whole_number


@dataclasses.dataclass(eq=False)
class Alignment:
    """What brings the shapes of a run to stand alike; rows are in the order of the shapes that were given.

    A point x of shape k comes to scales[k] * rotations[k] @ x + translations[k], in a frame in which the centre of
    a shape lies near the origin and the root mean square of a coordinate is about 1. Rows of shapes that were set
    aside are NaN.

    Attributes:
        aligned: whether shapes were turned. If not, all rotations are the identity, and the others bring each
            shape's centre to the origin and its size to that of the others.
        reason: why they are aligned, or are not.
        rotations: (S, 3, 3), orthogonal; of determinant -1 where a shape is mirrored.
        scales: (S,).
        translations: (S, 3).
        agreement: (S,) how well the links of a shape to others agree in the frame, 0 .. 1.
        residuals: (S,) the length of the links that agree, in the unit of the frame.
        reflected: (S,) whether the rotation mirrors the shape.
        found: (S,) whether links say how the shape stands; else its rotation is a guess.
        standing_share: the share of the shapes that stand like the others as they were given.
    """

    aligned: bool
    reason: str
    rotations: np.ndarray
    scales: np.ndarray
    translations: np.ndarray
    agreement: np.ndarray
    residuals: np.ndarray
    reflected: np.ndarray
    found: np.ndarray
    standing_share: float

    def __repr__(self) -> str:
        return f"coseg.Alignment({len(self.scales)} shapes, aligned={self.aligned}: {self.reason})"

    def apply(self, shape: int, points: Any) -> np.ndarray:
        """The points (N, 3) of the shape with this index, 0 .. S - 1, as they lie in the frame."""
        shape = given_whole_number("shape", shape)
        if not 0 <= shape < len(self.scales):
            raise UsageError(f"shape: {shape} is not in 0 .. {len(self.scales) - 1}")
        if np.ma.is_masked(points):
            raise InputError("points are masked; leave them out")
        try:
            given = np.asarray(points, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"the points must be N x 3 numbers ({error})") from None
        if given.ndim != 2 or given.shape[1] != 3:
            raise InputError(f"the points must be N x 3 numbers, not an array of the shape {given.shape}")
        turned = given @ self.rotations[shape].T
        return self.scales[shape] * turned + self.translations[shape]

    @property
    def matrices(self) -> np.ndarray:
        """(S, 4, 4): the same as matrices on homogeneous coordinates."""
        matrices = np.tile(np.eye(4), (len(self.scales), 1, 1))
        matrices[:, :3, :3] = self.scales[:, None, None] * self.rotations
        matrices[:, :3, 3] = self.translations
        return matrices


def alignment_of(raw: Optional[Dict[str, Any]], set_aside: List[bool]) -> Optional[Alignment]:
    """Of what the library or alignment.json says; nothing where that is nothing."""
    if raw is None:
        return None
    shapes = raw["shapes"]
    away = np.array(set_aside, dtype=bool)

    def rows(key: str, *extent: int) -> np.ndarray:
        values = np.array([shape[key] for shape in shapes], dtype=np.float64).reshape((len(shapes), *extent))
        values[away] = np.nan
        return values

    return Alignment(aligned=raw["aligned"], reason=raw["reason"], rotations=rows("rotation", 3, 3),
                     scales=rows("scale"), translations=rows("translation", 3), agreement=rows("agreement"),
                     residuals=rows("residual"), reflected=np.array([shape["reflected"] for shape in shapes], dtype=bool),
                     found=np.array([shape["found"] for shape in shapes], dtype=bool),
                     standing_share=raw["standing_share"])
