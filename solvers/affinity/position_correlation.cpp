#include "solvers/affinity/position_correlation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Above it the density of a pair is so narrow that patches a little apart would lose their link.
constexpr double most_correlation = 0.95;
/// Of the logarithm of a weight: a link never vanishes.
constexpr double least_logarithm = -20.0;

/// Weight of a row's links to other meshes, and the sum of weight times place over their other ends.
using RowMoments = std::array<double, 4>;

/// Calls visit(k, j) for each entry k of local row r whose column j is of another mesh.
template <class Visit>
void for_each_link(const SparseRows& links, const std::vector<int>& mesh_of, std::size_t r, Visit&& visit) {
    const int mesh = mesh_of[at(links.rows.begin) + r];
    for (auto k = at(links.offsets[r]); k < at(links.offsets[r + 1]); ++k) {
        if (mesh_of[at(links.columns[k])] != mesh) visit(k, links.columns[k]);
    }
}

/// Of all rows, on all ranks. Collective.
std::vector<RowMoments> row_moments(const Comm& comm, const SparseRows& links,
                                    const Eigen::Matrix3Xd& positions, const std::vector<int>& mesh_of) {
    std::vector<double> local;
    for (std::size_t r = 0; r < at(links.local_rows()); ++r) {
        RowMoments sums{};
        for_each_link(links, mesh_of, r, [&](std::size_t k, int j) {
            sums[0] += links.values[k];
            for (int a = 0; a < 3; ++a) sums[1 + at(a)] += links.values[k] * positions(a, j);
        });
        local.insert(local.end(), sums.begin(), sums.end());
    }
    const std::vector<double> all =
        comm.size() == 1 ? local : all_gather(comm, std::span<const double>(local));
    std::vector<RowMoments> moments(all.size() / 4);
    for (std::size_t i = 0; i < moments.size(); ++i)
        std::copy_n(all.begin() + 4 * static_cast<std::ptrdiff_t>(i), 4, moments[i].begin());
    return moments;
}

/// The density p of normal x and y of spread 1 with correlation r; what does not depend on them is found
/// once.
class PairDensity {
  public:
    explicit PairDensity(double r) : r_(r), rest_(1.0 - r * r), at_centre_(-0.5 * std::log(rest_)) {}
    /// Logarithm of p(x, y) / (p(x) p(y)).
    [[nodiscard]] double log_ratio(double x, double y) const {
        return at_centre_ - (r_ * r_ * (x * x + y * y) - 2.0 * r_ * x * y) / (2.0 * rest_);
    }

  private:
    double r_;
    double rest_;
    double at_centre_;
};

}  // namespace

PositionFrame position_frame(const Comm& comm, const SparseRows& links, const Eigen::Matrix3Xd& positions,
                             const std::vector<int>& mesh_of) {
    const std::vector<RowMoments> rows = row_moments(comm, links, positions, mesh_of);
    double total = 0.0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Eigen::Vector3d x = positions.col(static_cast<Eigen::Index>(i));
        total += rows[i][0];
        mean += rows[i][0] * x;
        own += rows[i][0] * x * x.transpose();
        across += x * Eigen::Vector3d(rows[i][1], rows[i][2], rows[i][3]).transpose();
    }
    if (!(total > 0.0)) return {};
    mean /= total;
    own = own / total - mean * mean.transpose();
    across = across / total - mean * mean.transpose();
    // Flat shapes have no spread along one direction, and nothing to agree on there.
    own += 1e-9 * std::max(own.trace(), 1e-30) * Eigen::Matrix3d::Identity();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        0.5 * (across + across.transpose()), own);
    if (solver.info() != Eigen::Success) return {};  // there is no spread but rounding: positions say nothing
    return {mean, solver.eigenvectors(), solver.eigenvalues().cwiseMax(0.0).cwiseMin(most_correlation)};
}

void weigh_by_position(const PositionFrame& frame, const Eigen::Matrix3Xd& positions,
                       const std::vector<int>& mesh_of, SparseRows& links) {
    const std::array<PairDensity, 3> along{PairDensity(frame.correlation[0]),
                                           PairDensity(frame.correlation[1]),
                                           PairDensity(frame.correlation[2])};
    const Eigen::Matrix3Xd in_frame = frame.directions.transpose() * (positions.colwise() - frame.mean);
    for (std::size_t r = 0; r < at(links.local_rows()); ++r) {
        const auto x =
            in_frame.col(static_cast<Eigen::Index>(links.rows.begin) + static_cast<Eigen::Index>(r));
        for_each_link(links, mesh_of, r, [&](std::size_t k, int j) {
            double logarithm = 0.0;
            for (int a = 0; a < 3; ++a) logarithm += along[at(a)].log_ratio(x[a], in_frame(a, j));
            links.values[k] *= std::exp(std::max(logarithm, least_logarithm));
        });
    }
}

Eigen::Matrix3Xd correlated_places(const PositionFrame& frame, const Eigen::Matrix3Xd* positions,
                                   Eigen::Index patches) {
    if (positions == nullptr) return Eigen::Matrix3Xd::Zero(3, patches);
    const Eigen::Vector3d scale = frame.correlation / std::sqrt(3.0);
    return scale.asDiagonal() * (frame.directions.transpose() * (positions->colwise() - frame.mean));
}

}  // namespace coseg
