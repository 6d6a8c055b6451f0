#include "solvers/partition/partition_agreement.hpp"

namespace coseg {

Eigen::MatrixXd common_areas(const std::vector<int>& first, int rows, const std::vector<int>& second,
                             int columns, const std::vector<double>& patch_area) {
    Eigen::MatrixXd common = Eigen::MatrixXd::Zero(rows, columns);
    for (std::size_t i = 0; i < first.size(); ++i) common(first[i], second[i]) += patch_area[i];
    return common;
}

double adjusted_rand_index(const Eigen::MatrixXd& common) {
    const double pairs = common.sum() * common.sum();
    const double in_both = common.squaredNorm() / pairs;
    const double in_first = common.rowwise().sum().squaredNorm() / pairs;
    const double in_second = common.colwise().sum().squaredNorm() / pairs;
    const double expected = in_first * in_second;
    const double most = 0.5 * (in_first + in_second);
    return most > expected ? (in_both - expected) / (most - expected) : 1.0;
}

}  // namespace coseg
