#pragma once
// Links of a shape to itself turned, for tests of what finds the turn.

#include <cstdint>

#include "solvers/alignment/rotation_fit.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg::test {

/// Points without any symmetry, a hash of the seed, turned by `rotation`; of every ten links `wrong` lead to
/// another point.
inline LinkedPoints turned_points(const Eigen::Matrix3d& rotation, int wrong, std::uint64_t seed) {
    constexpr int count = 200;
    SeededStream random(seed);
    LinkedPoints points{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count),
                        Eigen::VectorXd::Constant(count, 1.0 / count)};
    for (int k = 0; k < count; ++k)
        points.own.col(k) =
            Eigen::Vector3d(2.0 * random.normal(), random.normal(), 0.5 * random.normal() + random.uniform());
    for (int k = 0; k < count; ++k) {
        const int other = k % 10 < wrong ? static_cast<int>(random() % count) : k;
        points.other.col(k) = rotation * points.own.col(other);
    }
    return points;
}

}  // namespace coseg::test
