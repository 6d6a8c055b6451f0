#pragma once
// How the sums over the entries of distributed vectors are taken.

namespace coseg {

enum class VectorSums {
    exact,  ///< the same bits on any number of ranks, see exact_vector
    plain,  ///< PETSc's and the BLAS's own: faster, for a problem that one rank has for itself
};

}  // namespace coseg
