#include "mpi_drivers/partition/partition_checkpoint.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

TEST(KeptCut, ReturnsWhatWasWritten) {
    const test::TemporaryFolder folder;
    CutResult cut;
    cut.part_of_patch = {0, 2, 1, 1};
    cut.part_share = {0.5, 0.3, 0.2};
    cut.meshes_with_part = {2, 2, 1};
    cut.starts.resize(2);
    cut.starts[0].start = {{1.0, 2.0, true}, 5};
    cut.starts[0].terms = {.explained = {{0.25, 0.5}, {0.125, 0.75}},
                           .crease = -0.1,
                           .overlap = 1.0 / 3.0,
                           .concavity = 0.6,
                           .size = -0.8};
    cut.starts[0].moved = 7;
    cut.starts[0].degenerate = true;
    cut.starts[1].terms.explained = {{1.0 / 7.0, 0.5}};
    cut.starts[0].score = -1.5;
    cut.eigenvalues = {1.0, 0.5};
    cut.starts[1].parts_found = 3;
    cut.starts[1].set_aside = 4;
    cut.starts[1].unreached = 1;
    cut.chosen = 1;
    cut.frame = {{0.1, 0.2, 0.3}, Eigen::Matrix3d::Random(), {0.0, 1.0 / 3.0, 0.9}};
    write_cut(folder.path("cut.h5"), cut);
    const CutResult read = read_cut(folder.path("cut.h5"));
    EXPECT_EQ(read.part_of_patch, cut.part_of_patch);
    EXPECT_EQ(read.part_share, cut.part_share);
    EXPECT_EQ(read.meshes_with_part, cut.meshes_with_part);
    EXPECT_EQ(read.chosen, cut.chosen);
    EXPECT_EQ(read.frame.mean, cut.frame.mean);
    EXPECT_EQ(read.frame.directions, cut.frame.directions);
    EXPECT_EQ(read.frame.correlation, cut.frame.correlation);
    EXPECT_EQ(read.starts, cut.starts);
    EXPECT_EQ(read.eigenvalues, cut.eigenvalues);
}

TEST(KeptCut, OptionsWithoutEffectAreLeftOut) {
    const std::vector<OptionValue> options = {{"parts", "3", Affects::cut},
                                              {"out", "here", Affects::nothing},
                                              {"refine", "held", Affects::output},
                                              {"alpha", "0.1", Affects::solve}};
    EXPECT_EQ(cut_option_text(options, {"-eps_ncv", "80"}), "parts=3\nalpha=0.1\n-eps_ncv\n80\n");
}

}  // namespace
}  // namespace coseg
