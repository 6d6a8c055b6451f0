#include "src/patches/patch_label_areas.hpp"

#include <gtest/gtest.h>

namespace coseg {
namespace {

TEST(PatchLabelAreas, AddUpTheFacesOfWhichALabelIsKnown) {
    const Eigen::VectorXd area = (Eigen::VectorXd(5) << 1.0, 2.0, 4.0, 8.0, 16.0).finished();
    const Eigen::MatrixXd areas = patch_label_areas({0, 0, 1, 1, 2}, 3, {1, 1, 0, -1, -1}, 2, area);
    EXPECT_EQ(areas, (Eigen::MatrixXd(2, 3) << 0.0, 4.0, 0.0, 3.0, 0.0, 0.0).finished());
}

}  // namespace
}  // namespace coseg
