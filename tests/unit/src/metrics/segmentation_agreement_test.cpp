#include "src/metrics/segmentation_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/base/error.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// The unit square, 20 x 20 cells of two triangles, cut into strips by x.
struct Square {
    TriMesh mesh = test::flat_square(20);
    FaceGeometry geometry = face_geometry(mesh);
    DualGraph graph = dual_graph(mesh, geometry);

    /// Segment = number of `cuts` below the face's x; cuts on multiples of 0.05.
    [[nodiscard]] std::vector<int> strips(const std::vector<double>& cuts) const {
        std::vector<int> label;
        for (Eigen::Index f = 0; f < geometry.area.size(); ++f) {
            int below = 0;
            for (const double cut : cuts) below += geometry.centroid(0, f) > cut ? 1 : 0;
            label.push_back(below);
        }
        return label;
    }
    [[nodiscard]] SegmentationAgreement agreement(const std::vector<double>& reference,
                                                  const std::vector<double>& answer) const {
        return segmentation_agreement(mesh, geometry, graph, strips(reference), strips(answer));
    }
};

TEST(SegmentationAgreement, TheSameSegmentationHasNoErrorWhateverItsNumbers) {
    const Square square;
    const std::vector<int> reference = square.strips({0.25, 0.5});
    std::vector<int> renumbered;
    for (const int label : reference) renumbered.push_back(-7 * label + 3);
    for (const auto& [a, b] : {std::pair(reference, renumbered), std::pair(renumbered, reference)}) {
        const SegmentationAgreement same =
            segmentation_agreement(square.mesh, square.geometry, square.graph, a, b);
        EXPECT_NEAR(same.rand_index_error, 0.0, 1e-12);
        EXPECT_NEAR(same.hamming_distance, 0.0, 1e-12);
        EXPECT_NEAR(same.global_consistency_error, 0.0, 1e-12);
        EXPECT_NEAR(same.local_consistency_error, 0.0, 1e-12);
        EXPECT_EQ(same.cut_discrepancy, 0.0);
    }
}

TEST(SegmentationAgreement, AShiftedBoundaryByHand) {
    // reference [0, .5] [.5, 1], answer [0, .75] [.75, 1]
    const Square square;
    const SegmentationAgreement shifted = square.agreement({0.5}, {0.75});
    // reference: [0,.5] lies in the first segment, of [.5, 1] one half of it in each: .25 unmatched
    EXPECT_NEAR(shifted.missing_rate, 0.25, 1e-9);
    // answer: [0, .75] shares .5 with the first: .25 unmatched; [.75, 1] lies in the second
    EXPECT_NEAR(shifted.false_alarm_rate, 0.25, 1e-9);
    EXPECT_NEAR(shifted.hamming_distance, 0.25, 1e-9);
    // shared: .5 (of .5 and .75), .25 (of .5 and .75), .25 (of .5 and .25)
    EXPECT_NEAR(shifted.global_consistency_error, 0.25 * 0.5 + 0.25 * 0.5, 1e-9);
    EXPECT_NEAR(shifted.local_consistency_error, 0.25 * 0.5, 1e-9);
    // pairs of 800 faces apart in one and together in the other: (400 x 200) and (200 x 200)
    EXPECT_NEAR(shifted.rand_index_error, (400.0 * 200 + 200.0 * 200) / (800.0 * 799 / 2), 1e-9);
    // two boundaries 0.25 apart; the mean distance of a unit square from its centre is (sqrt 2 + asinh 1) / 6
    const double radius = (std::sqrt(2.0) + std::asinh(1.0)) / 6.0;
    ASSERT_TRUE(shifted.cut_discrepancy.has_value());
    EXPECT_NEAR(*shifted.cut_discrepancy, 2 * 0.25 / radius, 0.01);
}

TEST(SegmentationAgreement, ARefinementIsNoInconsistency) {
    const Square square;
    const SegmentationAgreement finer = square.agreement({0.5}, {0.25, 0.5});
    EXPECT_NEAR(finer.global_consistency_error, 0.0, 1e-9);
    EXPECT_NEAR(finer.local_consistency_error, 0.0, 1e-9);
    EXPECT_NEAR(finer.missing_rate, 0.25, 1e-9);
    EXPECT_NEAR(finer.false_alarm_rate, 0.0, 1e-9);
    const double radius = (std::sqrt(2.0) + std::asinh(1.0)) / 6.0;
    EXPECT_NEAR(*finer.cut_discrepancy, 0.5 * 0.25 / radius,
                0.01);  // half of the answer's boundary is 0.25 away

    const SegmentationAgreement crossed = square.agreement({0.25, 0.5}, {0.5, 0.75});
    EXPECT_NEAR(crossed.local_consistency_error, 0.0, 1e-9);
    EXPECT_NEAR(crossed.global_consistency_error, 0.25,
                1e-9);  // in either direction one half is cut into two
}

TEST(SegmentationAgreement, BoundariesOfOneAloneHaveNoDistance) {
    const Square square;
    EXPECT_FALSE(square.agreement({0.5}, {}).cut_discrepancy.has_value());
    EXPECT_EQ(square.agreement({}, {}).cut_discrepancy, 0.0);
    EXPECT_THROW(segmentation_agreement(square.mesh, square.geometry, square.graph, {0, 1}, {0, 1}), Error);
}

}  // namespace
}  // namespace coseg
