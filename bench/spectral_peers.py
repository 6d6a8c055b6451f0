#!/usr/bin/env python3
"""Solves the operator that spectral_bench --write left with SciPy, and prints CPU seconds, products and residuals.

  spectral_bench --vectors 5,20 --write OPERATOR > ours.json
  /usr/bin/python3 bench/spectral_peers.py OPERATOR --vectors 5,20 [--tolerance 1e-10]

Needs Debian's python3-scipy, and python3-sklearn for its spectral embedding. All use one thread
(OPENBLAS_NUM_THREADS=1). The first eigenvector is known, and is deflated by LOBPCG and by ARPACK's operator, as
spectral_bench does; scikit-learn gets the affinity whose degrees are equal to those of the operator.
"""

import argparse
import json
import time
import warnings

import numpy
import scipy.sparse
import scipy.sparse.linalg


def read_operator(path):
    with open(path, "rb") as file:
        rows, entries = numpy.fromfile(file, numpy.int64, 2)
        offsets = numpy.fromfile(file, numpy.int64, rows + 1)
        columns = numpy.fromfile(file, numpy.int32, entries)
        values = numpy.fromfile(file, numpy.float64, entries)
        first = numpy.fromfile(file, numpy.float64, rows)
    return scipy.sparse.csr_matrix((values, columns, offsets), (rows, rows)), first


class Counted(scipy.sparse.linalg.LinearOperator):
    """The operator on the complement of its first eigenvector, with the products of single vectors counted."""

    def __init__(self, matrix, first):
        super().__init__(matrix.dtype, matrix.shape)
        self.matrix, self.first, self.products = matrix, first, 0

    def _matvec(self, x):
        x = x.reshape(-1)
        self.products += 1
        return self.matrix @ x - self.first * (self.first @ x)

    def _matmat(self, x):
        self.products += x.shape[1]
        return self.matrix @ x - numpy.outer(self.first, self.first @ x)


def lobpcg(operator, wanted, tolerance):
    start = numpy.random.default_rng(1).standard_normal((operator.shape[0], wanted))
    known = operator.first.reshape(-1, 1)
    return scipy.sparse.linalg.lobpcg(operator, start, Y=known, tol=tolerance, maxiter=2000, largest=True)


def arpack(operator, wanted, tolerance):
    return scipy.sparse.linalg.eigsh(operator, wanted, which="LA", tol=tolerance)


def measured(solve, matrix, first, wanted, tolerance):
    operator = Counted(matrix, first)
    begin = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        values, vectors = solve(operator, wanted, tolerance)
    cpu = time.process_time() - begin
    residuals = numpy.linalg.norm(matrix @ vectors - vectors * values, axis=0)
    return {"vectors": wanted, "products": operator.products, "cpu_seconds": cpu,
            "worst_residual": float(residuals.max()), "last_eigenvalue": float(values.min())}


def embedding(matrix, first, wanted, tolerance):
    """scikit-learn normalises the affinity itself; D^1/2 A D^1/2 with D = first^2 has first^2 as its degrees."""
    import sklearn.manifold

    scale = scipy.sparse.diags(first)
    affinity = scale @ matrix @ scale
    begin = time.process_time()
    sklearn.manifold.spectral_embedding(affinity, n_components=wanted, eigen_solver="lobpcg", random_state=1,
                                        eigen_tol=tolerance)
    return {"vectors": wanted, "cpu_seconds": time.process_time() - begin}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("operator")
    parser.add_argument("--vectors", default="5,20")
    parser.add_argument("--tolerance", type=float, default=1e-10)
    arguments = parser.parse_args()
    matrix, first = read_operator(arguments.operator)
    result = {"rows": matrix.shape[0], "entries": matrix.nnz}
    for wanted in map(int, arguments.vectors.split(",")):
        for name, solve in (("scipy_lobpcg", lobpcg), ("scipy_arpack", arpack)):
            result.setdefault(name, []).append(measured(solve, matrix, first, wanted, arguments.tolerance))
        try:
            figures = embedding(matrix, first, wanted, arguments.tolerance)
        except ImportError:
            continue
        result.setdefault("sklearn_embedding", []).append(figures)
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
