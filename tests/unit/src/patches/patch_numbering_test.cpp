#include "src/patches/patch_numbering.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(PatchNumbering, WorkedExampleOfTheHeader) {
    const PatchNumbering numbers(2, {3, 2, 4, 4});
    EXPECT_EQ(numbers.patch_count(), 13);
    EXPECT_EQ(numbers.first(0, 1), 3);
    EXPECT_EQ(numbers.first(1, 1), 9);
    EXPECT_EQ(numbers.count(1, 0), 4);
    EXPECT_EQ(numbers.count(0), 5);
    EXPECT_EQ(numbers.mesh_of(), (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(PatchNumbering, NoMeshes) { EXPECT_EQ(PatchNumbering(3, {}).patch_count(), 0); }

}  // namespace
}  // namespace coseg
