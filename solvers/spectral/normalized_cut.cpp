#include "solvers/spectral/normalized_cut.hpp"

#include <Eigen/SVD>
#include <algorithm>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd unit_rows(const MatrixXd& coordinates, int columns) {
    MatrixXd rows = coordinates.leftCols(columns);
    for (Index r = 0; r < rows.rows(); ++r) {
        const double norm = rows.row(r).norm();
        if (norm > 0.0) rows.row(r) /= norm;
    }
    return rows;
}

/// Columns: rows of `points` that are as far apart, as nearly orthogonal, as a greedy choice finds them.
MatrixXd distant_rows(const MatrixXd& points, Index first) {
    const Index clusters = points.cols();
    MatrixXd rotation(clusters, clusters);
    Eigen::VectorXd closeness = Eigen::VectorXd::Zero(points.rows());
    Index chosen = first;
    for (Index k = 0; k < clusters; ++k) {
        rotation.col(k) = points.row(chosen).transpose();
        closeness += (points * rotation.col(k)).cwiseAbs();
        closeness.minCoeff(&chosen);
    }
    return rotation;
}

std::vector<int> nearest_axes(const MatrixXd& points, const MatrixXd& rotation) {
    const MatrixXd turned = points * rotation;
    std::vector<int> labels(at(points.rows()));
    for (Index r = 0; r < points.rows(); ++r) {
        Index axis = 0;
        turned.row(r).maxCoeff(&axis);
        labels[at(r)] = static_cast<int>(axis);
    }
    return labels;
}

/// The rotation V U^T of a matrix U S V^T. Jacobi's method takes sweep after sweep over all pairs of columns,
/// which with hundreds of clusters is most of a cut; divide and conquer takes a fraction of the time there.
MatrixXd rotation_of(const MatrixXd& sums) {
    constexpr Index most_for_jacobi = 64;
    const auto rotation = [](const auto& svd) { return MatrixXd(svd.matrixV() * svd.matrixU().transpose()); };
    constexpr unsigned both = Eigen::ComputeFullU | Eigen::ComputeFullV;
    if (sums.cols() <= most_for_jacobi) return rotation(Eigen::JacobiSVD<MatrixXd>(sums, both));
    return rotation(Eigen::BDCSVD<MatrixXd>(sums, both));
}

/// The rotation that brings the points closest to the axes of their labels.
MatrixXd best_rotation(const MatrixXd& points, const std::vector<int>& labels) {
    const Index clusters = points.cols();
    MatrixXd sums = MatrixXd::Zero(clusters, clusters);
    for (Index r = 0; r < points.rows(); ++r) sums.row(labels[at(r)]) += points.row(r);
    return rotation_of(sums);
}

}  // namespace

std::vector<int> discretize(const SpectralEmbedding& embedding, int clusters) {
    constexpr int max_rounds = 200;
    const MatrixXd points = unit_rows(embedding.coordinates, clusters);
    const auto heaviest = std::max_element(embedding.degrees.begin(), embedding.degrees.end());
    std::vector<int> labels =
        nearest_axes(points, distant_rows(points, heaviest - embedding.degrees.begin()));
    for (int round = 0; round < max_rounds; ++round) {
        std::vector<int> next = nearest_axes(points, best_rotation(points, labels));
        if (next == labels) break;
        labels = std::move(next);
    }
    return labels;
}

std::vector<int> cut_embedding(const SpectralEmbedding& embedding, int clusters, std::int64_t size) {
    const std::vector<int> of_row = discretize(embedding, clusters);
    std::vector<int> labels(at(size), -1);
    for (std::size_t r = 0; r < of_row.size(); ++r) labels[at(embedding.rows[r])] = of_row[r];
    return labels;
}

}  // namespace coseg
