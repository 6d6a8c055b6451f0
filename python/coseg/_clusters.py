"""Multi-view subspace clustering of matrices."""

from __future__ import annotations

import contextlib
import dataclasses
import inspect
import json
import re
from typing import Any, Dict, Iterator, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import InputError, UsageError, translated
from ._segmentation import Progress
from ._shapes import (given_communicator, given_number, given_parts, given_progress, given_switch,
                      given_text, given_whole_number)


@dataclasses.dataclass(eq=False)
class Clusters:
    """Attributes:
        labels: (N,) cluster of each item, 0 .. K-1.
        certificate: as in Result.
        report: the certificate with the sizes of the problem and the history of the solve.
    """

    labels: np.ndarray
    certificate: Dict[str, Any]
    report: Dict[str, Any]
    _coefficients: Any = dataclasses.field(default=None, repr=False)
    _affinity: Any = dataclasses.field(default=None, repr=False)

    @property
    def coefficients(self) -> list:
        """W of each feature, N x N scipy.sparse.csc_matrix: column j says of which items j is made."""
        from scipy import sparse
        return [sparse.csc_matrix((values, indices, offsets), shape=(size, size))
                for size, values, indices, offsets in self._coefficients]

    @property
    def affinity(self) -> Any:
        """The symmetric matrix that is cut, N x N scipy.sparse.csr_matrix."""
        from scipy import sparse
        size, values, indices, offsets = self._affinity
        return sparse.csr_matrix((values, indices, offsets), shape=(size, size))


def _matrices(data: Any) -> List[np.ndarray]:
    views = data if isinstance(data, (list, tuple)) and len(data) and np.ndim(data[0]) == 2 else [data]
    matrices = []
    for number, view in enumerate(views):
        if np.ma.is_masked(view):
            raise InputError(f"feature {number}: values are masked; leave the items out, or give values")
        matrix = np.asarray(view)
        if matrix.ndim != 2 or 0 in matrix.shape or matrix.dtype.kind not in "fiub":
            raise InputError(f"feature {number}: give an array of N items x d numbers, not {matrix.dtype} of the shape "
                             f"{matrix.shape}")
        if len(matrix) != len(views[0]):
            raise InputError(f"feature {number} has {len(matrix)} items, but feature 0 has {len(views[0])}")
        matrices.append(np.ascontiguousarray(matrix, dtype=np.float64))
    return matrices


def _numbers_of_groups(groups: Any) -> List[int]:
    """0, 1, ... for equal ones; a number that is none, which equals nothing, belongs to no group."""
    if np.ma.is_masked(groups):
        raise UsageError("groups: are masked; leave the items out, or give their groups")
    try:
        given = np.asarray(groups)
        if given.ndim != 1 or (given.dtype.kind in "fc" and not np.isfinite(given).all()):
            raise ValueError(f"{given.dtype} of the shape {given.shape}")
        return np.unique(given, return_inverse=True)[1].astype(np.intc).tolist()
    except (TypeError, ValueError) as error:
        raise UsageError(f"groups: give one for each item, finite and comparable with each other ({error})") from None


def _check_scope(scope: str, groups: Sequence[int]) -> None:
    if scope == "meshes" and len(set(groups)) < 2:
        raise UsageError("scope: 'meshes' needs groups with at least two different ones; items of one group are not "
                         "linked to each other")


_OF_MATRICES = re.compile(r"the matrices: feature (\d+), column (\d+)(.*?)(?: \(features are the datasets.*)?", re.DOTALL)


@contextlib.contextmanager
def _items_named() -> Iterator[None]:
    """Names what the program says of its file, whose columns are the items here, as NumPy counts."""
    try:
        yield
    except InputError as error:
        said = _OF_MATRICES.fullmatch(str(error))
        if said is None:
            raise
        rest = said[3].replace("leave that column out", "leave that item out")
        raise InputError(f"feature {int(said[1]) - 1}, item {int(said[2]) - 1} (both counted from 0){rest}") from None


def cluster(features: Union[Any, Sequence[Any]], parts: int, *, groups: Optional[Any] = None,
            unit_items: bool = False, alpha: float = 0.01, beta: float = 0.1, lambda_: float = 1.0,
            variant: str = "multi-feature", scope: str = "auto", affinity: str = "formula-8", links: int = 0,
            seed: int = 1, gap: float = 1e-4, max_iterations: int = 10000, max_seconds: float = 3600.0,
            comm: Any = None, progress: Optional[Progress] = None) -> Clusters:
    """Multi-view subspace clustering of any data, as `coseg cluster` does it (docs/method.md).

    Args:
        features: (N, d) numbers >= 0, or a list of such matrices with the same N: one a feature ("view"). No
            item may be all 0 in a feature.
        parts: K, 1 .. N, and 1000 at most.
        groups: (N,) anything that can be compared: items of one group are not linked to each other.
        unit_items: whether every item of every feature is scaled to norm 1 first.
        alpha, beta, lambda_: weights of consistency over the features, of sparseness, and of squared sums.
        gap: relative duality gap at which the optimiser stops.
        comm, progress: as in segment().

    Raises:
        UsageError, InputError: feature and item (row) are named, both counted from 0.
    """
    matrices = _matrices(features)
    settings = _core.ClusterSettings()
    settings.parts = given_parts(parts)
    if groups is not None:
        settings.groups = _numbers_of_groups(groups)
    given = {"unit_items": given_switch("unit_items", unit_items)}
    for name, value in (("alpha", alpha), ("beta", beta), ("lambda_", lambda_), ("gap", gap),
                        ("max_seconds", max_seconds)):
        given[name] = given_number(name, value)
    for name, value in (("links", links), ("seed", seed), ("max_iterations", max_iterations)):
        given[name] = given_whole_number(name, value)
    for name, value in (("variant", variant), ("scope", scope), ("affinity", affinity)):
        given[name] = given_text(name, value)
    _check_scope(scope, settings.groups)
    for name, value in given.items():
        try:
            setattr(settings, name, value)
        except TypeError:
            raise UsageError(f"{name}: {value!r} is out of range") from None
    with _items_named(), translated():
        raw = _core.cluster(matrices, settings, given_communicator(comm), given_progress(progress))
    return Clusters(labels=raw["labels"], certificate=raw["certificate"], report=json.loads(raw["report"]),
                    _coefficients=raw["coefficients"], _affinity=raw["affinity"])


def _known_settings(settings: Dict[str, Any]) -> Dict[str, Any]:
    known = [name for name, one in inspect.signature(cluster).parameters.items() if one.kind is one.KEYWORD_ONLY]
    for name in settings:
        if name not in known:
            raise UsageError(f"'{name}' is no parameter of SubspaceClustering, which has n_clusters, {', '.join(known)}")
    return settings


class SubspaceClustering:
    """The same in the manner of scikit-learn, which is not needed.

    >>> labels = coseg.SubspaceClustering(n_clusters=3).fit_predict(X)

    X is (N, d), or a list of such matrices, one a view. After fit(), labels_ (N,), affinity_matrix_,
    coefficients_ and certificate_ are there. Other arguments are those of cluster().
    """

    def __init__(self, n_clusters: int = 8, **settings: Any):
        self.n_clusters = n_clusters
        self.settings = _known_settings(settings)

    def get_params(self, deep: bool = True) -> Dict[str, Any]:
        return {"n_clusters": self.n_clusters, **self.settings}

    def set_params(self, **params: Any) -> "SubspaceClustering":
        n_clusters = params.pop("n_clusters", self.n_clusters)
        self.settings.update(_known_settings(params))
        self.n_clusters = n_clusters
        return self

    def fit(self, X: Any, y: Any = None) -> "SubspaceClustering":
        self.clusters_ = cluster(X, self.n_clusters, **self.settings)
        self.labels_ = self.clusters_.labels
        self.certificate_ = self.clusters_.certificate
        return self

    def fit_predict(self, X: Any, y: Any = None) -> np.ndarray:
        return self.fit(X).labels_

    @property
    def affinity_matrix_(self) -> Any:
        return self.clusters_.affinity

    @property
    def coefficients_(self) -> list:
        return self.clusters_.coefficients
