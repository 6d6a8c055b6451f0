#include "src/descriptors/average_geodesic.hpp"

#include <algorithm>
#include <array>

namespace coseg {

namespace {

/// So many faces are summed side by side: one sum's additions wait for each other.
constexpr Eigen::Index faces_at_once = 8;

std::array<double, faces_at_once> weighted_sums(const GeodesicTable& table, Eigen::Index first) {
    const Eigen::Index samples = table.distance.rows();
    const float* distance = table.distance.data() + first * samples;
    std::array<double, faces_at_once> sums{};
    for (Eigen::Index k = 0; k < samples; ++k) {
        const double weight = table.sample_weight[k];
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += weight * static_cast<double>(distance[static_cast<Eigen::Index>(i) * samples + k]);
    }
    return sums;
}

double weighted_sum(const GeodesicTable& table, Eigen::Index face) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < table.distance.rows(); ++k)
        sum += table.sample_weight[k] * static_cast<double>(table.distance(k, face));
    return sum;
}

}  // namespace

Eigen::VectorXd average_geodesic(const GeodesicTable& table) {
    Eigen::VectorXd average(table.distance.cols());
    const Eigen::Index whole = average.size() - average.size() % faces_at_once;
    for (Eigen::Index f = 0; f < whole; f += faces_at_once)
        std::ranges::copy(weighted_sums(table, f), average.data() + f);
    for (Eigen::Index f = whole; f < average.size(); ++f) average[f] = weighted_sum(table, f);
    if (average.size() > 0) average.array() -= average.minCoeff();
    return average;
}

}  // namespace coseg
