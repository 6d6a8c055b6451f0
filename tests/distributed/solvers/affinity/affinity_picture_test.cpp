#include "solvers/affinity/affinity_picture.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

/// 128 patches in four tiles; patch i is linked to i + 2 (mod 128), so even to even and odd to odd, with
/// `weight` of i.
template <class Weight>
SparseCoefficients ring(const Comm& comm, const Weight& weight) {
    constexpr int patches = 128;
    SparseCoefficients coefficients;
    coefficients.size = patches;
    coefficients.features = 2;
    coefficients.columns = block_range(patches, comm.size(), comm.rank(), coefficient_tile);
    coefficients.offsets = {0};
    for (auto j = coefficients.columns.begin; j < coefficients.columns.end; ++j) {
        coefficients.rows.push_back(static_cast<int>((j + 2) % patches));
        coefficients.values.insert(coefficients.values.end(), {3.0 * weight(j), 4.0 * weight(j)});
        coefficients.offsets.push_back(static_cast<std::int64_t>(coefficients.rows.size()));
    }
    return coefficients;
}

std::vector<int> odd_or_even() {
    std::vector<int> parts;
    for (int i = 0; i < 128; ++i) parts.push_back(i % 2);
    return parts;
}

TEST(AffinityPicture, PartsAreBlocksAndNothingIsBetweenThem) {
    const Comm world(MPI_COMM_WORLD);
    const AffinityPicture picture =
        affinity_picture(world, ring(world, [](std::int64_t) { return 1.0; }), odd_or_even(), 2, 2);
    EXPECT_EQ(picture.rows, (std::vector<std::string>{"z0", "0z"}));
    EXPECT_EQ(picture.part_ends, (std::vector<int>{1, 2}));
}

TEST(AffinityPicture, IsSymmetricAndShowsTheSquareRoot) {
    const Comm world(MPI_COMM_WORLD);
    // Links among even patches four times as strong as among odd ones: half as bright, z = 35 and i = 18.
    const AffinityPicture picture = affinity_picture(
        world, ring(world, [](std::int64_t j) { return j % 2 == 0 ? 4.0 : 1.0; }), odd_or_even(), 2, 2);
    EXPECT_EQ(picture.rows, (std::vector<std::string>{"z0", "0i"}));
    const AffinityPicture fine =
        affinity_picture(world, ring(world, [](std::int64_t j) { return 1.0 + static_cast<double>(j); }),
                         odd_or_even(), 2, 16);
    for (std::size_t r = 0; r < 16; ++r) {
        for (std::size_t c = 0; c < 16; ++c) EXPECT_EQ(fine.rows[r][c], fine.rows[c][r]);
    }
}

}  // namespace
}  // namespace coseg
