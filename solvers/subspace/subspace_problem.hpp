#pragma once
// The multi-feature subspace clustering problem: its data, its penalties and what its input must satisfy.
//
// Row scope, equations (6)-(7):
//   min over W_h >= 0 with zero diagonal, h = 1..H, of
//     sum_h ( ||X_h W_h - X_h||_F^2 + lambda ||W_h^T W_h||_{1,1} ) + alpha ||W||_{2,1} + beta ||W||_{1,1}
//   where ||W_h^T W_h||_{1,1} = ||W_h 1||^2, the squared norm of the row sums, and ||W||_{2,1} sums the norms
//   of the H values of each pair.
// Mesh scope replaces the lambda term by lambda sum_g s_g^2, g = (mesh of i, column j), s_g the sum over the
//   pairs (i, j) of g of the norm of their H values, and allows no pairs inside a mesh.
//   Deviates: from equation (6), so that each patch finds a match in every other mesh; columns then separate.
//
// Source: Hu, Fan, Liu, "Co-Segmentation of 3D Shapes via Subspace Clustering", SGP 2012, equations (6)-(7);
//   mesh scope is an exclusive group lasso (Zhou, Jin, Hoi 2010) over meshes.

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/enum_names.hpp"
#include "src/histograms/feature_matrices.hpp"

namespace coseg {

/// What lambda's squared sums run over.
enum class PenaltyScope {
    rows,    ///< whole rows of W, as in the paper
    meshes,  ///< the links of one patch to one mesh
};
constexpr std::array<EnumName<PenaltyScope>, 2> enum_names(PenaltyScope /*type*/) {
    return {{{PenaltyScope::rows, "rows"}, {PenaltyScope::meshes, "meshes"}}};
}
constexpr std::array<EnumName<PenaltyScope>, 2> enum_aliases(PenaltyScope /*type*/) {
    return {{{PenaltyScope::rows, "paper"}, {PenaltyScope::meshes, "mesh"}}};
}

/// What the gap of an objective is relative to (`relative_gap`). In row scope, the objective, and at least a
/// millionth of that at W = 0: it vanishes where duplicates explain each other. In mesh scope, what has been
/// gained: objective_at_zero - objective.
double gap_scale(PenaltyScope scope, double objective, double objective_at_zero);

/// The largest alpha, beta and lambda that commands and the library accept.
inline constexpr double most_penalty = 1e12;

struct SubspaceProblem {
    FeatureMatrices features;  ///< H matrices, d_h x N, nonnegative, the same on every rank
    double alpha = 0.01;       ///< of ||W||_{2,1}; >= 0
    double beta = 0.1;         ///< of ||W||_{1,1}; >= 0
    double lambda = 1000.0;    ///< of the scope's squared sums; >= 0
    PenaltyScope scope = PenaltyScope::rows;
    std::vector<int> mesh_of;  ///< the mesh of each of N patches; mesh scope only
    /// Mesh scope only: for each mesh the meshes, ascending, in which its patches may have matches (the rows
    /// of its columns). Empty means all others.
    std::vector<std::vector<int>> allowed_meshes;

    [[nodiscard]] int feature_count() const noexcept { return static_cast<int>(features.size()); }
    /// N.
    [[nodiscard]] std::int64_t size() const noexcept { return features.columns(); }
};

/// The number of pairs (i, j), i != j, that may have a value: all pairs in row scope, those of allowed meshes
/// in mesh scope.
std::int64_t allowed_pair_count(const SubspaceProblem& problem);

/// Throws Error(input), naming feature and column (both counted from 1), where the problem cannot be solved:
/// no feature, no column, a value that is negative or not finite, a column of zeros,
/// a penalty that is negative or not finite, `mesh_of` of the wrong length. Does not communicate.
void validate(const SubspaceProblem& problem);

}  // namespace coseg
