#include "solvers/spectral/normalized_cut.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// K x N: the first K coordinates of each row of the embedding, scaled to unit length.
MatrixXd unit_points(const MatrixXd& coordinates, int clusters) {
    MatrixXd points = coordinates.leftCols(clusters).transpose();
    for (Index r = 0; r < points.cols(); ++r) {
        const double norm = points.col(r).norm();
        if (norm > 0.0) points.col(r) /= norm;
    }
    return points;
}

/// Columns: points that are as far apart, as nearly orthogonal, as a greedy choice finds them.
MatrixXd distant_points(const MatrixXd& points, Index first) {
    const Index clusters = points.rows();
    MatrixXd rotation(clusters, clusters);
    Eigen::VectorXd closeness = Eigen::VectorXd::Zero(points.cols());
    Index chosen = first;
    for (Index k = 0; k < clusters; ++k) {
        rotation.col(k) = points.col(chosen);
        for (Index r = 0; r < points.cols(); ++r)
            closeness[r] += std::abs(points.col(r).dot(rotation.col(k)));
        closeness.minCoeff(&chosen);
    }
    return rotation;
}

/// Some points at a time: turned points of hundreds of megabytes would be new memory in every round, which
/// takes longer to get than to fill.
void find_nearest_axes(const MatrixXd& points, const MatrixXd& rotation, std::vector<int>& labels) {
    constexpr Index at_once = 512;
    MatrixXd turned(points.rows(), at_once);
    for (Index begin = 0; begin < points.cols(); begin += at_once) {
        const Index count = std::min(at_once, points.cols() - begin);
        turned.leftCols(count).noalias() = rotation.transpose() * points.middleCols(begin, count);
        for (Index r = 0; r < count; ++r) {
            Index axis = 0;
            turned.col(r).maxCoeff(&axis);
            labels[at(begin + r)] = static_cast<int>(axis);
        }
    }
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
    const Index clusters = points.rows();
    MatrixXd sums = MatrixXd::Zero(clusters, clusters);
    for (Index r = 0; r < points.cols(); ++r) sums.col(labels[at(r)]) += points.col(r);
    return rotation_of(sums.transpose());
}

}  // namespace

std::vector<int> discretize(const SpectralEmbedding& embedding, int clusters) {
    constexpr int max_rounds = 200;
    const MatrixXd points = unit_points(embedding.coordinates, clusters);
    const auto heaviest = std::max_element(embedding.degrees.begin(), embedding.degrees.end());
    std::vector<int> labels(at(points.cols()), 0);
    std::vector<int> next = labels;
    find_nearest_axes(points, distant_points(points, heaviest - embedding.degrees.begin()), labels);
    for (int round = 0; round < max_rounds; ++round) {
        find_nearest_axes(points, best_rotation(points, labels), next);
        if (next == labels) break;
        std::swap(labels, next);
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
