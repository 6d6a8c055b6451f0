#include "src/patches/overlapping_subsets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "src/base/error.hpp"

namespace coseg {
namespace {

std::vector<std::string> names(int count) {
    std::vector<std::string> list;
    for (int i = 0; i < count; ++i) list.push_back("mesh" + std::to_string(i));
    return list;
}

TEST(OverlappingSubsets, CommonMeshesAreInEachAndTheOthersInOne) {
    for (const int meshes : {5, 9, 20, 41, 100}) {
        for (const int size : {4, 7, 12}) {
            const OverlappingSubsets plan = overlapping_subsets(names(meshes), size, 3);
            std::map<int, int> uses;
            for (const std::vector<int>& subset : plan.subsets) {
                EXPECT_LE(subset.size(), static_cast<std::size_t>(size));
                EXPECT_TRUE(std::is_sorted(subset.begin(), subset.end()));
                for (const int m : subset) ++uses[m];
            }
            EXPECT_EQ(uses.size(), static_cast<std::size_t>(meshes));
            for (const auto& [mesh, count] : uses) {
                const bool common = std::binary_search(plan.common.begin(), plan.common.end(), mesh);
                EXPECT_EQ(count, common ? static_cast<int>(plan.subsets.size()) : 1);
            }
            EXPECT_GE(plan.common.size(), 2U);
        }
    }
}

TEST(OverlappingSubsets, OneSubsetWhereAllFit) {
    const OverlappingSubsets plan = overlapping_subsets(names(6), 6, 1);
    EXPECT_EQ(plan.subsets, (std::vector<std::vector<int>>{{0, 1, 2, 3, 4, 5}}));
}

TEST(OverlappingSubsets, DependOnNamesAndSeedAlone) {
    std::vector<std::string> list = names(30);
    const OverlappingSubsets plan = overlapping_subsets(list, 9, 5);
    std::set<std::string> common;
    for (const int m : plan.common) common.insert(list[static_cast<std::size_t>(m)]);
    std::reverse(list.begin(), list.end());
    std::set<std::string> reversed;
    for (const int m : overlapping_subsets(list, 9, 5).common)
        reversed.insert(list[static_cast<std::size_t>(m)]);
    EXPECT_EQ(common, reversed);
    EXPECT_NE(overlapping_subsets(names(30), 9, 6).common, plan.common);
    EXPECT_THROW(overlapping_subsets(list, 3, 1), Error);
}

}  // namespace
}  // namespace coseg
