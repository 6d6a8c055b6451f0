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

TEST(LabelPropagation, RefusesEmptyEvidence) { EXPECT_THROW(propagate_labels({}, 1.0), Error); }

}  // namespace
}  // namespace coseg
