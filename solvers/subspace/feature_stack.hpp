#pragma once
// Stacks the H features of every patch into one column, as the solvers read them, with their norms and sums.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "solvers/subspace/subspace_problem.hpp"
#include "src/base/index.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct FeatureStack {
    /// Throws Error(input) where there are more than 2^31 columns.
    explicit FeatureStack(FeatureMatrices given);

    FeatureMatrices matrices;                   ///< the memory that `columns` refers to
    int features = 0;                           ///< H
    int size = 0;                               ///< N
    int dimension = 0;                          ///< D = sum of d_h
    std::vector<int> offset;                    ///< H + 1: feature h is the rows offset[h] .. offset[h + 1]
    Eigen::Map<const Eigen::MatrixXd> columns;  ///< D x N, column major
    Eigen::MatrixXd norm;                       ///< H x N: 2-norms, rounded up
    Eigen::MatrixXd entry_sum;                  ///< H x N: sums of entries, rounded down; > 0
    double squared_norm = 0.0;                  ///< sum_h ||X_h||_F^2, the objective at W = 0
    double largest_inner = 0.0;                 ///< largest squared norm of a column of a feature

    [[nodiscard]] int rows_of(int h) const noexcept { return offset[at(h) + 1] - offset[at(h)]; }
    [[nodiscard]] const double* feature(int h) const noexcept { return columns.data() + offset[at(h)]; }
    /// Per feature, the largest norm of a column.
    [[nodiscard]] std::vector<double> largest_norms() const;
    /// An upper bound of |computed - exact| / (||x|| ||y||) for an inner product of dimension D in double.
    [[nodiscard]] double inner_product_error() const noexcept;
};

/// Stacks the problem's features as they lie in memory.
FeatureStack stack_features(const SubspaceProblem& problem);

/// Stacks the features so that column `order[i]` of the problem becomes column i. The features are copied
/// unless the order changes nothing. Collective.
FeatureStack stack_features(const Comm& comm, const SubspaceProblem& problem, std::span<const int> order);

}  // namespace coseg
