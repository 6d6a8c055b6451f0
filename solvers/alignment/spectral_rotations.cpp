#include "solvers/alignment/spectral_rotations.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cstddef>

#include "solvers/alignment/rotation_fit.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

using Blocks = Eigen::Matrix<double, Eigen::Dynamic, 3>;  ///< 3 x 3 for each shape, one below the other

Blocks product(const std::vector<PairMoment>& moments, const Blocks& blocks) {
    Blocks result = Blocks::Zero(blocks.rows(), 3);
    for (const PairMoment& pair : moments) {
        const Eigen::Index from = 3 * Eigen::Index{pair.from};
        const Eigen::Index to = 3 * Eigen::Index{pair.to};
        result.middleRows<3>(from) += 0.5 * pair.moment * blocks.middleRows<3>(to);
        result.middleRows<3>(to) += 0.5 * pair.moment.transpose() * blocks.middleRows<3>(from);
    }
    return result;
}

Blocks orthonormal(const Blocks& blocks) {
    const Eigen::HouseholderQR<Blocks> qr(blocks);
    return qr.householderQ() * Blocks::Identity(blocks.rows(), 3);
}

/// Not less than the size of any eigenvalue: the largest sum of norms in a row of blocks.
double eigenvalue_bound(int shapes, const std::vector<PairMoment>& moments) {
    std::vector<double> sums(at(shapes), 0.0);
    for (const PairMoment& pair : moments) {
        sums[at(pair.from)] += 0.5 * pair.moment.norm();
        sums[at(pair.to)] += 0.5 * pair.moment.norm();
    }
    return *std::max_element(sums.begin(), sums.end());
}

}  // namespace

std::vector<Eigen::Matrix3d> spectral_rotations(int shapes, const std::vector<PairMoment>& moments,
                                                std::uint64_t seed) {
    constexpr int iterations = 200;
    Blocks blocks(3 * Eigen::Index{shapes}, 3);
    for (Eigen::Index k = 0; k < blocks.size(); ++k)
        blocks.data()[k] = normal_of(hash_words({seed, static_cast<std::uint64_t>(k)}));
    blocks = orthonormal(blocks);
    // Half of the bound is enough in practice to keep negative eigenvalues, which are smaller, from winning.
    const double shift = 0.5 * eigenvalue_bound(shapes, moments);
    for (int k = 0; k < iterations; ++k) blocks = orthonormal(product(moments, blocks) + shift * blocks);
    int reflected = 0;
    for (int m = 0; m < shapes; ++m)
        reflected += blocks.middleRows<3>(3 * Eigen::Index{m}).determinant() < 0.0 ? 1 : 0;
    if (2 * reflected > shapes) blocks.col(2) = -blocks.col(2);
    std::vector<Eigen::Matrix3d> rotations;
    for (int m = 0; m < shapes; ++m)
        rotations.push_back(nearest_rotation(blocks.middleRows<3>(3 * Eigen::Index{m}).transpose()));
    return rotations;
}

}  // namespace coseg
