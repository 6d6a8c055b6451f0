#include "solvers/partition/part_count.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::same_partition;
using testing_graphs::segment_descriptors;
using testing_graphs::toy_collection;
using testing_graphs::toy_input;
using testing_graphs::ToyCollection;

CountedParts counted(const Comm& comm, int parts, std::int64_t one_rank_entries = 1'000'000) {
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    const std::vector<ChoiceDescriptor> descriptors =
        segment_descriptors(toy, {.pooled = 15.0, .per_mesh = 20.0});
    CutOptions options;
    options.starts = pooled_starts(2);
    options.spectral.mesh_balance = 0.3;
    options.one_rank_entries = one_rank_entries;
    return count_parts(comm, toy_input(toy, descriptors), options);
}

class PartCount : public testing::TestWithParam<int> {};

TEST_P(PartCount, IsThatOfTheSegmentsAndTheirPartitionIsFound) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    const CountedParts found = counted(comm, parts);
    ASSERT_EQ(found.figures.size(), 11U);
    EXPECT_EQ(found.figures.front().parts, parts);
    EXPECT_TRUE(is_clear(found.figures));
    EXPECT_GT(found.figures.front().agreement, 0.98) << "the graphs agree but for a patch here and there";
    EXPECT_EQ(found.figures.front().rarest, 1.0);
    EXPECT_TRUE(same_partition(found.partitions[static_cast<std::size_t>(parts - 2)],
                               toy_collection(comm, 6, parts, 6, 77).truth));
    for (std::size_t k = 0; k < found.partitions.size(); ++k)
        EXPECT_EQ(1 + *std::max_element(found.partitions[k].begin(), found.partitions[k].end()),
                  static_cast<int>(k) + 2);
}

TEST_P(PartCount, HasTheSameBytesOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const CountedParts shared = counted(comm, GetParam());
    const CountedParts alone = counted(self, GetParam());
    EXPECT_EQ(shared.figures, alone.figures);
    EXPECT_EQ(shared.partitions, alone.partitions);
    EXPECT_EQ(counted(comm, GetParam(), 0).figures, counted(self, GetParam(), 0).figures)
        << "where all ranks share each graph";
}

INSTANTIATE_TEST_SUITE_P(Parts, PartCount, testing::Values(2, 3, 5));

TEST(PartCountSentence, NamesTheNextOnesAndWhetherNothingIsClear) {
    std::vector<PartCountFigures> figures = {{5, 150.0, 0.062, 1.0, 0.98, 159.26},
                                             {6, 150.25, 0.004, 0.125, 0.97, 158.89},
                                             {4, 147.5, 0.07, 1.0, 0.97, 157.14},
                                             {3, 140.0, 0.2, 1.0, 0.97, 150.14}};
    EXPECT_EQ(
        part_count_sentence(figures),
        "5 parts (starts agree to 0.98, smallest part 6.2 % of the area, rarest in 100 % of the shapes); "
        "next are 6 (behind by 0.37: score +0.2, starts agree to 0.97, smallest part 0.4 % of the area, "
        "rarest in 12 % of the shapes) and 4 (behind by 2.12: score -2.5, starts agree to 0.97, smallest "
        "part 7.0 % of the area, rarest in 100 % of the shapes); nothing is clear: 6 are nearly as good");
    figures.erase(figures.begin() + 1);
    EXPECT_TRUE(is_clear(figures));
    EXPECT_EQ(part_count_sentence(figures).find("nothing is clear"), std::string::npos);
    figures.resize(1);
    EXPECT_TRUE(is_clear(figures));
}

}  // namespace
}  // namespace coseg
