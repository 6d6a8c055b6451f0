"""A picture of labelled shapes, for notebooks; it needs matplotlib."""

from __future__ import annotations

import functools
import io
from typing import Any, Iterable, Union

import numpy as np

from ._errors import InputError, UsageError
from ._segmentation import Result
from ._shapes import MeshesLike, given_labels, given_number, given_shapes, given_whole_number


def _triangles(vertices: np.ndarray, corners: np.ndarray, offsets: np.ndarray) -> tuple:
    """Corner positions (T, 3, 3) of the fans of all faces, and the face of each triangle."""
    if not len(offsets):
        triangles = corners.reshape(-1, 3)
        return vertices[triangles], np.arange(len(triangles))
    fans = [(corners[a], corners[k], corners[k + 1], face)
            for face, (a, b) in enumerate(zip(offsets[:-1], offsets[1:])) for k in range(a + 1, b - 1)]
    rows = np.array(fans, dtype=np.intp).reshape(-1, 4)
    return vertices[rows[:, :3]], rows[:, 3]


def _drawable(shape: int, vertices: np.ndarray, corners: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """The vertices (V, 3) of a mesh whose faces and coordinates can be drawn."""
    vertices = np.asarray(vertices).reshape(-1, 3)
    if not len(corners):
        raise InputError(f"shape {shape}: the mesh has no faces")
    wrong = np.flatnonzero((corners < 0) | (corners >= len(vertices)))
    if len(wrong):
        face = int(np.searchsorted(offsets, wrong[0], side="right")) - 1 if len(offsets) else wrong[0] // 3
        raise InputError(f"shape {shape}: face {face} refers to vertex {corners[wrong[0]]}, but there are "
                         f"{len(vertices)} vertices (counted from 0)")
    endless = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(endless):
        raise InputError(f"shape {shape}: vertex {endless[0]} has a coordinate that is not finite")
    return vertices


@functools.lru_cache(maxsize=None)
def _picture_class() -> type:
    """A figure that a notebook shows although pyplot, which would tell it how, is not imported. matplotlib is only
    imported where a picture is drawn."""
    from matplotlib.figure import Figure

    class Picture(Figure):
        def _repr_png_(self) -> bytes:
            bytes_of_file = io.BytesIO()
            self.savefig(bytes_of_file, format="png")
            return bytes_of_file.getvalue()

    return Picture


def draw(meshes: MeshesLike, labels: Union[Result, Iterable[Any]], *, columns: int = 6, up: str = "z",
         size: float = 2.0) -> Any:
    """A matplotlib figure with every shape in its parts' colours, the same part in the same colour everywhere.

    A notebook shows it; elsewhere figure.savefig("shapes.png") writes it.

    Args:
        meshes, labels: as in score().
        columns: shapes a row.
        up: the axis that points up: "x", "y" or "z".
        size: of one picture, in inches.
    """
    from matplotlib import colormaps
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    from . import load_mesh
    axes_order = {"x": [1, 2, 0], "y": [2, 0, 1], "z": [0, 1, 2]}
    if not isinstance(up, str) or up not in axes_order:
        raise UsageError(f"up: {up!r} is none of 'x', 'y' and 'z'")
    if given_whole_number("columns", columns) < 1:
        raise UsageError(f"columns: {columns!r} is not positive")
    if given_number("size", size) <= 0:
        raise UsageError(f"size: {size!r} is not positive")
    rows = given_labels("labels", labels.labels if isinstance(labels, Result) else labels)
    shapes = given_shapes(meshes)
    if len(rows) != len(shapes):
        raise InputError(f"there are {len(shapes)} shapes and {len(rows)} arrays of labels; give as many of each")
    lines = -(-len(shapes) // columns)
    figure = _picture_class()(figsize=(size * min(columns, len(shapes)), size * lines), dpi=100, layout="constrained")
    light = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
    # The ten strong colours first, then the ten pale ones.
    palette = colormaps["tab20"](np.r_[0:20:2, 1:20:2])[:, :3]
    order = axes_order[up]
    for k, ((_, path, vertices, corners, offsets), part) in enumerate(zip(shapes, rows), 1):
        if path:
            vertices, corners, offsets = load_mesh(path).arrays()
        faces = len(offsets) - 1 if len(offsets) else len(corners) // 3
        if len(part) not in (0, faces):
            raise InputError(f"shape {k - 1}: {len(part)} labels for {faces} faces")
        points, face = _triangles(_drawable(k - 1, vertices, corners, offsets)[:, order], corners, offsets)
        if not len(points):
            raise InputError(f"shape {k - 1}: no face has three corners")
        normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        color = (np.full((len(points), 3), 0.7) if not len(part)
                 else palette[part[face] % 20])
        color = color * (0.6 + 0.4 * np.abs(normal @ light))[:, None]
        axes = figure.add_subplot(lines, min(columns, len(shapes)), k, projection="3d")
        axes.add_collection3d(Poly3DCollection(points, facecolors=color, edgecolors="none"))
        low, high = points.min((0, 1)), points.max((0, 1))
        half = (high - low).max() / 2
        for set_limits, middle in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), (low + high) / 2):
            set_limits(middle - half, middle + half)
        axes.set_axis_off()
    return figure
