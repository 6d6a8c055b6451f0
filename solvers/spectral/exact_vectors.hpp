#pragma once
// Distributed vectors and bases of PETSc and SLEPc whose sums have the same bits on any number of ranks.

#include <slepcbv.h>

#include <cstdint>

#include "solvers/petsc/petsc_handle.hpp"
#include "solvers/spectral/vector_sums.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

using BasisVectors = PetscHandle<BV, BVDestroy>;

/// A vector of `size` entries, all 0, owned as the rows of SparseRows. Its inner products and norms are sums
/// of tiles in an ExactSum, and its sums of multiples go tile by tile (tile_kernels), so that PETSc's and
/// SLEPc's methods have the same bits on any number of ranks. Random entries are hashed with their global
/// place. Duplicates are of the same kind. Entries should be of order 1 or less: a product of two tiles
/// beyond 2^77 is an error (PETSC_ERR_FP), and so are PETSc's split reductions (VecDotBegin ...).
/// Collective. Throws Error(internal).
PetscVector exact_vector(const Comm& comm, std::int64_t size);

/// exact_vector, or one of the same rows whose operations are PETSc's own. Collective. Throws
/// Error(internal).
PetscVector row_vector(const Comm& comm, std::int64_t size, VectorSums sums);

/// An empty basis of such vectors, for a solver to fill: an array of vectors (BVVECS) whose combination in
/// place goes tile by tile too. `columns` >= 1 is what the solver starts with; it resizes the basis as it
/// needs. Collective. Throws Error(internal).
BasisVectors exact_basis(const Comm& comm, const PetscVector& like, int columns);

}  // namespace coseg
