#pragma once
// Tells where a decomposition of a matrix has failed.

#include <Eigen/Core>
#include <string>

#include "src/base/error.hpp"

namespace coseg {

/// The decomposition itself. Throws Error(internal), which calls the matrix `what`, where Eigen says that it
/// has not come about, as a Cholesky decomposition of a matrix that is not positive definite: what is solved
/// with it would be wrong without a word.
template <class Decomposition>
const Decomposition& succeeded(const Decomposition& decomposition, const char* what) {
    if (decomposition.info() == Eigen::Success) return decomposition;
    throw Error(ExitCode::internal, std::string(what) + " cannot be decomposed");
}

}  // namespace coseg
