#include "solvers/partition/label_propagation.hpp"

#include <Eigen/Cholesky>

#include "solvers/affinity/affinity.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Keeps the system regular where patches are tied to nothing known; far below any tie that matters.
constexpr double regularisation = 1e-9;

Eigen::MatrixXd dense(const SparseRows& matrix) {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
    for (Eigen::Index r = 0; r < whole.rows(); ++r) {
        const auto row = at(r);
        for (auto k = at(matrix.offsets[row]); k < at(matrix.offsets[row + 1]); ++k) {
            whole(r, matrix.columns[k]) = matrix.values[k];
        }
    }
    const double total = whole.sum();
    if (total > 0.0) whole /= total;
    return whole;
}

/// Makes the equations of known patches say that they have their part and nothing else.
void hold(const std::vector<int>& known, Eigen::MatrixXd& laplacian, Eigen::MatrixXd& values) {
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] < 0) continue;
        const auto patch = static_cast<Eigen::Index>(i);
        values.col(known[i]) -= laplacian.col(patch);
        laplacian.row(patch).setZero();
        laplacian.col(patch).setZero();
        laplacian(patch, patch) = 1.0;
    }
    // Only now: what is taken off for other known patches must not stay.
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] < 0) continue;
        values.row(static_cast<Eigen::Index>(i)).setZero();
        values(static_cast<Eigen::Index>(i), known[i]) = 1.0;
    }
}

}  // namespace

std::vector<int> propagate_labels(const PropagationInput& input, double within_mesh_affinity) {
    const Eigen::Index patches = input.evidence.cols();
    if (patches == 0 || input.evidence.rows() == 0 || !input.evidence.allFinite())
        throw Error(ExitCode::internal, "labels cannot be propagated: the links are empty or not finite");
    if (!input.known.empty() && std::ssize(input.known) != patches)
        throw Error(ExitCode::internal, "labels cannot be propagated: known parts are not of all patches");
    const BlockRange all{0, patches};
    const std::vector<int> one_mesh(at(patches), 0);
    const double scale = within_mesh_affinity * input.evidence.sum();
    const Eigen::MatrixXd ties = scale * (dense(adjacency_affinity(all, input.neighbors, one_mesh)) +
                                          dense(overlap_affinity(all, input.overlaps, patches)));
    Eigen::MatrixXd laplacian = -ties;
    laplacian.diagonal() += ties.rowwise().sum() + input.evidence.colwise().sum().transpose() +
                            Eigen::VectorXd::Constant(patches, regularisation);
    Eigen::MatrixXd values = input.evidence.transpose();  // n x K
    hold(input.known, laplacian, values);
    laplacian.llt().solveInPlace(values);
    std::vector<int> parts;
    for (Eigen::Index j = 0; j < patches; ++j) {
        Eigen::Index part = 0;
        const double largest = values.row(j).maxCoeff(&part);
        parts.push_back(largest > regularisation ? static_cast<int>(part) : -1);
    }
    return parts;
}

}  // namespace coseg
