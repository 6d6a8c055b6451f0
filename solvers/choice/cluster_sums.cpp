#include "solvers/choice/cluster_sums.hpp"

#include <array>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The patches of each mesh, ascending.
void sum_deviations(const PartitionObjective& objective, const std::vector<int>& labels, ClusterSums& sums) {
    const Eigen::Index rows = objective.deviations.rows();
    const Eigen::Index clusters = sums.area.rows();
    const Eigen::VectorXd per_mesh = objective.per_mesh.cast<double>();
    const Eigen::VectorXd pooled = objective.pooled.cast<double>();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, clusters);
    for (const BlockRange patches : patches_of_meshes(objective)) {
        Eigen::MatrixXd of_mesh = Eigen::MatrixXd::Zero(rows, clusters);
        for (auto i = patches.begin; i < patches.end; ++i)
            of_mesh.col(labels[at(i)]) += objective.deviations.col(i).cast<double>();
        sums.per_mesh.emplace_back(of_mesh.transpose() * per_mesh.asDiagonal() * of_mesh);
        all += of_mesh;
    }
    sums.pooled = all.transpose() * pooled.asDiagonal() * all;
}

double sum_over(const Eigen::MatrixXd& matrix, std::span<const int> members) {
    double sum = 0.0;
    for (const int b : members) {
        for (const int a : members) sum += matrix(a, b);
    }
    return sum;
}

void fold(Eigen::MatrixXd& symmetric, Eigen::Index a, Eigen::Index b) {
    const Eigen::Index last = symmetric.rows() - 1;
    symmetric.row(a) += symmetric.row(b).eval();
    symmetric.col(a) += symmetric.col(b).eval();
    symmetric.row(b) = symmetric.row(last).eval();
    symmetric.col(b) = symmetric.col(last).eval();
    symmetric.conservativeResize(last, last);
}

void fold_rows(Eigen::MatrixXd& matrix, Eigen::Index a, Eigen::Index b) {
    const Eigen::Index last = matrix.rows() - 1;
    matrix.row(a) += matrix.row(b).eval();
    matrix.row(b) = matrix.row(last).eval();
    matrix.conservativeResize(last, Eigen::NoChange);
}

}  // namespace

ClusterSums cluster_sums(const PartitionObjective& objective, const std::vector<int>& labels, int clusters) {
    ClusterSums sums;
    sums.ties = Eigen::MatrixXd::Zero(clusters, clusters);
    sums.area = Eigen::MatrixXd::Zero(clusters, objective.meshes);
    sums.share = sums.area;
    sums.size_weight = objective.size_weight;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        sums.area(labels[i], objective.mesh_of[i]) += objective.area[i];
        sums.share(labels[i], objective.mesh_of[i]) += objective.share[i];
        for_each_tie(objective, static_cast<int>(i),
                     [&](int other, double gain) { sums.ties(labels[i], labels[at(other)]) += 0.5 * gain; });
    }
    sum_deviations(objective, labels, sums);
    return sums;
}

double value_of_part(const ClusterSums& sums, std::span<const int> members) {
    if (members.empty()) return 0.0;
    double value = sum_over(sums.ties, members);
    double area = 0.0;
    double shares = 0.0;
    double squares = 0.0;
    const Eigen::Index meshes = sums.area.cols();
    for (Eigen::Index m = 0; m < meshes; ++m) {
        double area_in_mesh = 0.0;
        double share = 0.0;
        for (const int c : members) {
            area_in_mesh += sums.area(c, m);
            share += sums.share(c, m);
        }
        shares += share;
        squares += share * share;
        area += area_in_mesh;
        if (area_in_mesh > 0.0) value += sum_over(sums.per_mesh[at(m)], members) / area_in_mesh;
    }
    if (area > 0.0) value += sum_over(sums.pooled, members) / area;
    return value - sums.size_weight * relative_variance(shares, squares, static_cast<int>(meshes));
}

double value_of_parts(const ClusterSums& sums) {
    double value = 0.0;
    for (int part = 0; part < sums.count(); ++part) value += value_of_part(sums, std::array{part});
    return value;
}

void unite(ClusterSums& sums, int a, int b) {
    for (Eigen::MatrixXd& products : sums.per_mesh) fold(products, a, b);
    fold(sums.pooled, a, b);
    fold(sums.ties, a, b);
    fold_rows(sums.area, a, b);
    fold_rows(sums.share, a, b);
}

}  // namespace coseg
