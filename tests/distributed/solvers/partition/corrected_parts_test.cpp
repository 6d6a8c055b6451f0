// What is said of some patches, against the segments that a collection was made of.

#include "solvers/partition/corrected_parts.hpp"

#include <gtest/gtest.h>

#include "src/base/index.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::segment_descriptors;
using testing_graphs::segment_features;
using testing_graphs::toy_collection;
using testing_graphs::toy_input;
using testing_graphs::ToyCollection;

constexpr int toy_meshes = 6;
constexpr int toy_segments = 3;

/// Six meshes of three segments, of which a partition is there and nothing is said yet.
struct Said {
    ToyCollection toy;
    std::vector<ChoiceDescriptor> descriptors;
    SinglePrecisionFeatures features;
    CorrectedParts parts;
    SaidParts said;

    Said(const Comm& comm, int part_count)
        : toy(toy_collection(comm, toy_meshes, toy_segments, 6, 77)),
          descriptors(segment_descriptors(toy)),
          features(segment_features(toy)),
          parts(comm, toy_input(toy, descriptors, &features), options(), {}),
          said{toy.truth, Eigen::MatrixXd::Zero(part_count, toy.patches),
               Eigen::MatrixXi::Ones(part_count, toy_meshes)} {}

    static CutOptions options() {
        CutOptions options;
        options.parts = toy_segments;
        options.starts = pooled_starts(toy_segments);
        return options;
    }

    void say(int mesh, int segment, int part) {
        for (int i = 0; i < toy.patches; ++i) {
            if (toy.mesh_of[at(i)] == mesh && toy.truth[at(i)] == segment)
                said.area(part, i) = toy.area[at(i)];
        }
    }

    [[nodiscard]] std::vector<int> corrected(const Comm& comm) const {
        return parts.corrected(comm, said, parts.scores(said)).parts;
    }
};

TEST(CorrectedParts, WhereNothingIsSaidAGoodPartitionStays) {
    const Comm comm(MPI_COMM_WORLD);
    const Said said(comm, toy_segments);
    EXPECT_EQ(said.corrected(comm), said.toy.truth);
}

TEST(CorrectedParts, OneShapeMendsAPartitionThatMixesTwoPartsUp) {
    const Comm comm(MPI_COMM_WORLD);
    Said said(comm, toy_segments);
    for (std::size_t i = 0; i < said.said.base.size(); ++i) {
        if (said.toy.mesh_of[i] % 2 == 1) said.said.base[i] = (said.toy.truth[i] + 1) % toy_segments;
    }
    for (int segment = 0; segment < toy_segments; ++segment) said.say(0, segment, segment);
    EXPECT_EQ(said.corrected(comm), said.toy.truth);
    const Comm self(MPI_COMM_SELF);
    Said alone(self, toy_segments);
    alone.said = said.said;
    EXPECT_EQ(alone.corrected(self), said.corrected(comm));
}

TEST(CorrectedParts, APartThatIsNewIsFoundInAllShapes) {
    const Comm comm(MPI_COMM_WORLD);
    Said said(comm, toy_segments + 1);
    std::vector<int> expected = said.toy.truth;
    for (int& part : expected) part = part == 1 ? toy_segments : part;
    for (const int mesh : {0, 1}) said.say(mesh, 1, toy_segments);
    EXPECT_EQ(said.corrected(comm), expected);
}

TEST(CorrectedParts, NoShapeGetsAPartThatItMayNotHave) {
    const Comm comm(MPI_COMM_WORLD);
    Said said(comm, toy_segments);
    said.said.allowed(2, 4) = 0;
    const std::vector<int> parts = said.corrected(comm);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool is_free = said.toy.mesh_of[i] == 4 && said.toy.truth[i] == 2;
        EXPECT_TRUE(is_free ? parts[i] != 2 : parts[i] == said.toy.truth[i]) << i;
    }
    said.said.allowed.col(4).setZero();
    EXPECT_THROW(static_cast<void>(said.corrected(comm)), AgreedError);
}

}  // namespace
}  // namespace coseg
