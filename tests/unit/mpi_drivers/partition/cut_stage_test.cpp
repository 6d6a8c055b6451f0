// What a cut is made with must mean the same however often, and into however many patches, each mesh is
// over-segmented.

#include "mpi_drivers/partition/cut_stage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/base/index.hpp"

namespace coseg {
namespace {

/// Two meshes of four patches in a row, `count` times the same.
Collection repeated_rows(int count) {
    Collection collection;
    collection.numbering = PatchNumbering(count, std::vector<int>(at(2 * count), 4));
    for (int m = 0; m < 2; ++m) {
        MeshDescription mesh;
        mesh.mesh = m;
        mesh.patch_counts.assign(at(count), 4);
        mesh.neighbors.assign(at(count), {{0, 1, 0.5, 0.1}, {1, 2, 0.25, 0.5}, {2, 3, 0.125, 0.9}});
        collection.local.push_back(std::move(mesh));
    }
    return collection;
}

/// What the boundary between the first two patches of each mesh and the others costs.
double cost_of_boundary(const Collection& collection) {
    const SparseCoefficients none;
    const PartitionInput input{.collection = collection,
                               .coefficients = none,
                               .patch_area = {},
                               .positions = {},
                               .choice_weights = {},
                               .features = {},
                               .rounded_positions = {},
                               .clustered = {},
                               .examples = nullptr};
    std::vector<int> labels;
    for (int i = 0; i < collection.numbering.patch_count(); ++i) labels.push_back(i % 4 / 2);
    return cut_options(input, PartitionOptions()).choice.crease *
           boundary_crease(local_neighbors(collection), labels, 2);
}

TEST(CutOptions, CreasesWeighTheSameInAnyNumberOfOversegmentations) {
    const double of_three = cost_of_boundary(repeated_rows(3));
    EXPECT_DOUBLE_EQ(of_three, ChoiceWeights().crease * -3.0 * 0.25 * 0.25) << "the weight is that of three";
    EXPECT_DOUBLE_EQ(cost_of_boundary(repeated_rows(1)), of_three);
    EXPECT_DOUBLE_EQ(cost_of_boundary(repeated_rows(9)), of_three);
}

TEST(ShareWeight, FollowsThePatchesOfAnOversegmentationAndNothingElse) {
    EXPECT_EQ(share_weight(PatchNumbering(1, {50, 50})), 1.0) << "the weights of the table are those of 50";
    EXPECT_EQ(share_weight(PatchNumbering(3, {50, 50, 50, 40, 50, 60})), 1.0) << "of the mean";
    EXPECT_DOUBLE_EQ(share_weight(PatchNumbering(2, {100, 100})), std::exp2(0.6));
    EXPECT_DOUBLE_EQ(share_weight(PatchNumbering(1, {25, 25, 25})), std::exp2(-0.6));
}

}  // namespace
}  // namespace coseg
