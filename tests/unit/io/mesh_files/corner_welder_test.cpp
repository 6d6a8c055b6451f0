#include "io/mesh_files/corner_welder.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

TEST(CornerWelder, NumbersPositionsAsTheyAreFirstMet) {
    CornerWelder welder;
    EXPECT_EQ(welder.number_of({1, 2, 3}), 0);
    EXPECT_EQ(welder.number_of({3, 2, 1}), 1);
    EXPECT_EQ(welder.number_of({1, 2, 3}), 0);
    EXPECT_EQ(welder.number_of({1, 2, std::nextafter(3.0, 4.0)}), 2);
    const std::vector<Eigen::Vector3d> vertices = welder.take_vertices();
    ASSERT_EQ(vertices.size(), 3U);
    EXPECT_EQ(vertices[1], Eigen::Vector3d(3, 2, 1));
}

TEST(CornerWelder, ZerosOfEitherSignAndTinyNumbersAreOne) {
    CornerWelder welder;
    EXPECT_EQ(welder.number_of({0.0, 1, 0.0}), 0);
    EXPECT_EQ(welder.number_of({-0.0, 1, 0.0}), 0);
    EXPECT_EQ(welder.number_of({1e-40, 1, -std::numeric_limits<float>::min()}), 0);
    EXPECT_EQ(welder.number_of({1e-30, 1, 0.0}), 1);
    EXPECT_TRUE(is_same_position({0, 0, -0.0}, {0, 1e-41, 0}));
    EXPECT_FALSE(is_same_position({0, 0, 0}, {0, 0, 1e-30}));
}

TEST(CornerWelder, OfTinyShapesNeglectsNothing) {
    CornerWelder welder(0.0);
    EXPECT_EQ(welder.number_of({0.0, 1e-200, 0.0}), 0);
    EXPECT_EQ(welder.number_of({-0.0, 1e-200, 0.0}), 0);
    EXPECT_EQ(welder.number_of({0.0, 2e-200, 0.0}), 1);
    EXPECT_TRUE(is_tiny({{0, 0, 0}, {0, 1e-31, 0}}));
    EXPECT_FALSE(is_tiny({{0, 0, 0}, {0, -1e-29, 0}}));
}

TEST(CornerWelder, AgreesWithAnOrderedMapOnManyPositions) {
    CornerWelder welder;
    std::map<std::array<double, 3>, int> numbers;
    SeededStream random(3);
    for (int i = 0; i < 100000; ++i) {
        std::array<double, 3> p{};
        for (double& value : p) value = static_cast<double>(random() % 33) / 7.0;
        const int expected = numbers.try_emplace(p, static_cast<int>(numbers.size())).first->second;
        ASSERT_EQ(welder.number_of({p[0], p[1], p[2]}), expected);
    }
    EXPECT_EQ(welder.take_vertices().size(), numbers.size());
}

}  // namespace
}  // namespace coseg
