#include "solvers/choice/part_gains.hpp"

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The derivative of |X|^2 / a, in the weighted norm, when a patch joins: K x n, for n columns `x`.
Eigen::MatrixXd explained_gains(const Eigen::MatrixXf& sums, const Eigen::VectorXd& area,
                                const Eigen::VectorXf& weight, const Eigen::MatrixXf& x,
                                const Eigen::VectorXd& patch_area) {
    const Eigen::MatrixXf weighted = weight.asDiagonal() * sums;
    Eigen::MatrixXd gains = (weighted.transpose() * x).cast<double>();
    for (Eigen::Index part = 0; part < gains.rows(); ++part) {
        if (area(part) <= 0.0) {
            gains.row(part).setZero();
            continue;
        }
        const double square = weighted.col(part).dot(sums.col(part));
        gains.row(part) *= 2.0 / area(part);
        gains.row(part) -= (square / (area(part) * area(part))) * patch_area.transpose();
    }
    return gains;
}

}  // namespace

PartGains::PartGains(const PartitionObjective& objective, const std::vector<int>& labels, int parts)
    : objective_(objective),
      labels_(labels),
      deviations_(Eigen::MatrixXf::Zero(objective.deviations.rows(), parts)),
      area_(Eigen::VectorXd::Zero(parts)),
      share_(Eigen::MatrixXd::Zero(parts, objective.meshes)) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
        deviations_.col(labels[i]) += objective.deviations.col(static_cast<Eigen::Index>(i));
        area_(labels[i]) += objective.area[i];
        share_(labels[i], objective.mesh_of[i]) += objective.share[i];
    }
}

Eigen::MatrixXd PartGains::of_mesh(BlockRange patches) const {
    const Eigen::Index count = patches.size();
    const Eigen::MatrixXf x = objective_.deviations.matrix().middleCols(patches.begin, count);
    const Eigen::Map<const Eigen::VectorXd> area(objective_.area.data() + patches.begin, count);
    const Eigen::Map<const Eigen::RowVectorXd> share(objective_.share.data() + patches.begin, count);
    Eigen::MatrixXf own = Eigen::MatrixXf::Zero(x.rows(), area_.size());
    Eigen::VectorXd own_area = Eigen::VectorXd::Zero(area_.size());
    for (Eigen::Index i = 0; i < count; ++i) {
        const int part = labels_[at(patches.begin + i)];
        own.col(part) += x.col(i);
        own_area(part) += area(i);
    }
    Eigen::MatrixXd gains = explained_gains(own, own_area, objective_.per_mesh, x, area) +
                            explained_gains(deviations_, area_, objective_.pooled, x, area);
    const int mesh = objective_.mesh_of[at(patches.begin)];
    for (Eigen::Index part = 0; part < gains.rows(); ++part) {
        const double sum = share_.row(part).sum();
        if (sum <= 0.0) continue;
        // Of variance / mean = (sum of squares) / sum - sum / M.
        const double slope = 2.0 * share_(part, mesh) / sum - share_.row(part).squaredNorm() / (sum * sum) -
                             1.0 / objective_.meshes;
        gains.row(part) -= objective_.size_weight * slope * share;
    }
    return gains;
}

}  // namespace coseg
