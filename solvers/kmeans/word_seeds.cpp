#include "solvers/kmeans/word_seeds.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

/// nearest[i] = min(nearest[i], squared distance of point i to point `chosen`); exactly 0 for equal points.
COSEG_VECTOR_CLONES void lower_square_distances(const Eigen::MatrixXf& points, Eigen::Index chosen,
                                                Eigen::VectorXf& nearest) {
    constexpr Eigen::Index block = 1024;
    std::array<float, block> sum{};
    for (Eigen::Index begin = 0; begin < points.rows(); begin += block) {
        const Eigen::Index count = std::min(block, points.rows() - begin);
        sum.fill(0.0F);
        for (Eigen::Index d = 0; d < points.cols(); ++d) {
            const float* x = points.data() + d * points.rows() + begin;
            const float c = points(chosen, d);
            for (Eigen::Index i = 0; i < count; ++i) {
                sum[at(i)] += (x[i] - c) * (x[i] - c);
            }
        }
        for (Eigen::Index i = 0; i < count; ++i) {
            const float candidate = sum[at(i)];
            nearest[begin + i] = candidate < nearest[begin + i] ? candidate : nearest[begin + i];
        }
    }
}

/// The point at which the running sum of `mass` passes `target`; the last one with mass if rounding keeps it
/// below.
Eigen::Index point_at(const Eigen::VectorXf& mass, double target) {
    Eigen::Index last = -1;
    double below = 0.0;
    for (Eigen::Index i = 0; i < mass.size(); ++i) {
        if (!(mass[i] > 0.0F)) continue;
        below += static_cast<double>(mass[i]);
        last = i;
        if (below > target) break;
    }
    return last;
}

}  // namespace

Eigen::MatrixXf word_seeds(const Eigen::MatrixXf& points, int words, std::uint64_t seed) {
    SeededStream random(seed);
    Eigen::MatrixXf seeds(points.cols(), words);
    Eigen::VectorXf nearest =
        Eigen::VectorXf::Constant(points.rows(), std::numeric_limits<float>::infinity());
    Eigen::Index count = 0;
    while (count < words && points.rows() > 0) {
        double total = 0.0;
        for (Eigen::Index i = 0; i < nearest.size(); ++i) total += static_cast<double>(nearest[i]);
        if (!(total > 0.0)) break;
        const double share = random.uniform();
        const auto first = static_cast<Eigen::Index>(share * static_cast<double>(points.rows()));
        const Eigen::Index chosen = count == 0 ? first : point_at(nearest, share * total);
        seeds.col(count++) = points.row(chosen).transpose();
        lower_square_distances(points, chosen, nearest);
    }
    return seeds.leftCols(count);
}

}  // namespace coseg
