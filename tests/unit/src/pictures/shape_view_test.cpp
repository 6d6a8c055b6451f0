#include "src/pictures/shape_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

const std::vector<UpAxis> all_axes = {UpAxis::x, UpAxis::y, UpAxis::z};

Eigen::Vector3d unit(UpAxis axis) { return Eigen::Vector3d::Unit(static_cast<int>(axis)); }

TEST(ShapeView, ViewsAreUprightFrames) {
    for (const UpAxis up : all_axes) {
        for (const View& view : candidate_views({up})) {
            EXPECT_NEAR(view.towards.norm(), 1.0, 1e-12);
            EXPECT_NEAR(view.up.norm(), 1.0, 1e-12);
            EXPECT_NEAR(view.up.dot(view.towards), 0.0, 1e-12);
            EXPECT_GT(view.up.dot(unit(up)), 0.5);
            EXPECT_GT(view.towards.dot(unit(up)), 0.0) << "seen from above";
        }
    }
}

TEST(ShapeView, AzimuthTurnsToTheRightOfTheFront) {
    for (const UpAxis up : all_axes) {
        const View front = view_from(up, 0.0, 0.0);
        EXPECT_TRUE(front.up.isApprox(unit(up)));
        EXPECT_TRUE(view_from(up, 90.0, 0.0).towards.isApprox(front.right(), 1e-12));
        EXPECT_TRUE(named_view("top", up)->towards.isApprox(unit(up), 1e-12));
        EXPECT_TRUE(named_view("30,-20", up)->towards.isApprox(view_from(up, 30.0, -20.0).towards));
    }
}

TEST(ShapeView, RefusesWhatIsNoView) {
    for (const char* text : {"", "auto", "above", "30", "30,", "30,91", "nan,3", "1,2,3", "30;20"})
        EXPECT_FALSE(named_view(text, UpAxis::y)) << text;
}

TEST(ShapeView, OutlineOfABoxIsItsProjection) {
    const TriMesh box = test::box(1.0, 2.0, 3.0, 3);
    for (const View& view : {view_from(UpAxis::y, 0.0, 0.0), view_from(UpAxis::y, 90.0, 0.0),
                             view_from(UpAxis::y, 0.0, 90.0), view_from(UpAxis::y, 40.0, 25.0)}) {
        // The projected area of a box: the sum over its three directions of face area times |cosine|.
        const Eigen::Vector3d t = view.towards.cwiseAbs();
        const double area = 2.0 * 3.0 * t.x() + 1.0 * 3.0 * t.y() + 1.0 * 2.0 * t.z();
        EXPECT_NEAR(outline_areas(box, {view}).front() / area, 1.0, 0.02);
    }
}

TEST(ShapeView, AConeStandsOnItsBase) {
    TriMesh cone;  // apex up along y
    cone.vertices.resize(3, 5);
    cone.vertices << -1, 1, 1, -1, 0, 0, 0, 0, 0, 2, -1, -1, 1, 1, 0;
    cone.faces.resize(3, 6);
    cone.faces << 0, 0, 0, 1, 2, 3, 2, 3, 4, 4, 4, 4, 1, 2, 1, 2, 3, 0;
    const Eigen::Vector3d shares = standing_shares(cone);
    EXPECT_NEAR(shares.y(), 1.0, 1e-12);
    EXPECT_LT(shares.x(), 0.5);
    EXPECT_LT(shares.z(), 0.5);
    const Eigen::Vector3d differences = mirror_differences(cone);
    EXPECT_NEAR(differences.x(), 0.0, 1e-12);
    EXPECT_NEAR(differences.z(), 0.0, 1e-12);
    EXPECT_GT(differences.y(), 0.3);
}

TEST(ShapeView, MirrorDifferencesDoNotDependOnTheUnitAndVanishForABox) {
    TriMesh box = test::box(3.0, 2.0, 1.0, 6);
    EXPECT_LT(mirror_differences(box).maxCoeff(), 1e-12);
    box.vertices.row(0) = (0.5 * box.vertices.row(0)).array().exp().matrix();
    const Eigen::Vector3d differences = mirror_differences(box);
    EXPECT_GT(differences.x(), 0.05);
    EXPECT_LE(differences.x(), 1.0);
    box.vertices *= 1000.0;
    EXPECT_TRUE(mirror_differences(box).isApprox(differences, 1e-9));
    EXPECT_LT(differences.tail<2>().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace coseg
