#include "solvers/partition/label_propagation.hpp"

#include <gtest/gtest.h>

#include "tests/support/errors.hpp"

namespace coseg {
namespace {

PropagationInput chain(const Eigen::MatrixXd& evidence) {
    PropagationInput input{.evidence = evidence, .neighbors = {}, .overlaps = {}};
    for (int j = 0; j + 1 < static_cast<int>(evidence.cols()); ++j)
        input.neighbors.push_back({j, j + 1, 1.0, 0.0});
    return input;
}

TEST(LabelPropagation, FollowsTheLinksWhereNothingTiesPatches) {
    Eigen::MatrixXd evidence(3, 4);
    evidence << 0.6, 0.1, 0.2, 0.5,  //
        0.3, 0.8, 0.1, 0.5,          //
        0.1, 0.1, 0.7, 0.0;
    EXPECT_EQ(propagate_labels(chain(evidence), 0.0), (std::vector<int>{0, 1, 2, 0}));
}

TEST(LabelPropagation, FillsPatchesWithoutLinksFromTheNearerSide) {
    Eigen::MatrixXd evidence = Eigen::MatrixXd::Zero(2, 6);
    evidence(0, 0) = 1.0;
    evidence(1, 5) = 1.0;
    EXPECT_EQ(propagate_labels(chain(evidence), 4.0), (std::vector<int>{0, 0, 0, 1, 1, 1}));
}

TEST(LabelPropagation, AConcaveBoundaryHoldsLabelsApart) {
    Eigen::MatrixXd evidence = Eigen::MatrixXd::Zero(2, 4);
    evidence(0, 0) = 1.0;
    evidence(1, 3) = 1.0;
    PropagationInput input = chain(evidence);
    input.neighbors[0].concavity = 0.9;  // patch 1 is far from 0 now, near 2 and 3
    EXPECT_EQ(propagate_labels(input, 4.0), (std::vector<int>{0, 1, 1, 1}));
}

TEST(LabelPropagation, TiesOutvoteALonePatchAndOverlapsCount) {
    Eigen::MatrixXd evidence(2, 5);
    evidence << 0.9, 0.9, 0.45, 0.9, 0.9,  //
        0.1, 0.1, 0.55, 0.1, 0.1;
    PropagationInput input{.evidence = evidence, .neighbors = {}, .overlaps = {}};
    for (const int other : {0, 1}) input.overlaps.push_back({other, 2, 0.8});
    EXPECT_EQ(propagate_labels(input, 0.0)[2], 1);
    EXPECT_EQ(propagate_labels(input, 2.0)[2], 0);
}

TEST(LabelPropagation, SaysWhatNothingReaches) {
    Eigen::MatrixXd evidence = Eigen::MatrixXd::Zero(2, 3);
    evidence(1, 0) = 1.0;
    const PropagationInput input{.evidence = evidence, .neighbors = {{0, 1, 1.0, 0.0}}, .overlaps = {}};
    EXPECT_EQ(propagate_labels(input, 1.0), (std::vector<int>{1, 1, -1}));
}

TEST(LabelPropagation, KnownPatchesAreHeldAndOthersFollowThem) {
    Eigen::MatrixXd evidence(2, 6);
    evidence << 0.6, 0.6, 0.6, 0.6, 0.6, 0.6,  //
        0.4, 0.4, 0.4, 0.4, 0.4, 0.4;
    PropagationInput input = chain(evidence);
    EXPECT_EQ(propagate_labels(input, 4.0), std::vector<int>(6, 0));
    input.known = {1, 1, -1, -1, -1, 0};
    EXPECT_EQ(propagate_labels(input, 4.0), (std::vector<int>{1, 1, 1, 0, 0, 0}));
    input.known = {-1, 1, -1, -1, -1, -1};
    EXPECT_EQ(propagate_labels(input, 0.0), (std::vector<int>{0, 1, 0, 0, 0, 0}))
        << "without ties nothing follows";
    input.known = {1, 0, 1, 0, 1, 0};
    EXPECT_EQ(propagate_labels(input, 9.0), input.known);
}

/// Patches of which one is known have the values that they would have with that patch's links to its part alone,
/// in the limit of many of them.
TEST(LabelPropagation, ToBeKnownIsToHaveEndlessLinksToThePart) {
    Eigen::MatrixXd evidence(2, 5);
    evidence << 0.7, 0.9, 0.52, 0.45, 0.1,  //
        0.3, 0.1, 0.48, 0.55, 0.9;
    for (int patch = 0; patch < 5; ++patch) {
        for (int part = 0; part < 2; ++part) {
            PropagationInput known = chain(evidence);
            known.known.assign(5, -1);
            known.known[static_cast<std::size_t>(patch)] = part;
            PropagationInput linked = chain(evidence);
            linked.evidence.col(patch).setZero();
            linked.evidence(part, patch) = 1e6;
            // The ties have the total of the links, so that as much less of them is the same.
            const double share = evidence.sum() / linked.evidence.sum();
            EXPECT_EQ(propagate_labels(known, 3.0), propagate_labels(linked, 3.0 * share)) << patch << part;
        }
    }
}

TEST(LabelPropagation, RefusesKnownPartsOfOtherPatches) {
    PropagationInput input = chain(Eigen::MatrixXd::Ones(2, 3));
    input.known = {0, 1};
    EXPECT_THROW(propagate_labels(input, 1.0), Error);
}

TEST(LabelPropagation, RefusesEmptyEvidence) { EXPECT_THROW(propagate_labels({}, 1.0), Error); }

}  // namespace
}  // namespace coseg
