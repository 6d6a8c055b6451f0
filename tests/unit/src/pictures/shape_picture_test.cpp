#include "src/pictures/shape_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

constexpr Color blue = {40, 80, 200};
constexpr Color orange = {220, 140, 30};

PictureMesh in_one_color(const TriMesh& mesh, const Color& color) {
    return picture_mesh(mesh, std::vector<Color>(static_cast<std::size_t>(mesh.face_count()), color));
}

bool is_background(const std::uint8_t* pixel) {
    return std::equal(pixel, pixel + 3, picture_background.begin());
}

int covered_pixels(const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) count += is_background(image.pixel(x, y)) ? 0 : 1;
    }
    return count;
}

PictureOptions of_size(int size) {
    PictureOptions options;
    options.size = size;
    return options;
}

TEST(ShapePicture, ASphereIsADiscOfTheSizeAskedFor) {
    const Image image =
        shape_picture(in_one_color(test::sphere(4), blue), view_from(UpAxis::y, 30.0, 20.0), of_size(200));
    const double radius = 0.5 * 200 * (1.0 - 2.0 * 0.06);
    // Pixels that the rim merely touches count too: half a pixel more of radius.
    EXPECT_NEAR(covered_pixels(image), std::numbers::pi * std::pow(radius + 0.5, 2), 300.0);
    EXPECT_TRUE(is_background(image.pixel(3, 100)));
    EXPECT_TRUE(is_background(image.pixel(100, 3)));
}

TEST(ShapePicture, LightComesFromTheUpperLeft) {
    const Image image =
        shape_picture(in_one_color(test::sphere(4), blue), view_from(UpAxis::y, 0.0, 0.0), of_size(120));
    EXPECT_GT(image.pixel(40, 35)[2], image.pixel(80, 85)[2] + 30);
    EXPECT_GT(image.pixel(80, 85)[2], 40) << "no side is black";
}

TEST(ShapePicture, TheColourOfTheSideThatFacesTheEye) {
    TriMesh mesh = test::box(1.0, 1.0, 1.0, 2);
    std::vector<Color> colors;
    for (int f = 0; f < mesh.face_count(); ++f) {
        double low = 1.0;
        for (int k = 0; k < 3; ++k) low = std::min(low, mesh.vertices(2, mesh.faces(k, f)));
        colors.push_back(low > 0.99 ? orange : blue);  // the side z = 1
    }
    const PictureMesh picture = picture_mesh(mesh, colors);
    const Image front = shape_picture(picture, view_from(UpAxis::y, 0.0, 0.0), of_size(64));
    EXPECT_GT(front.pixel(32, 32)[0], front.pixel(32, 32)[2]);
    const Image back = shape_picture(picture, view_from(UpAxis::y, 180.0, 0.0), of_size(64));
    EXPECT_LT(back.pixel(32, 32)[0], back.pixel(32, 32)[2]);
}

TEST(ShapePicture, ACornerBetweenWallsIsDarkerThanAnOpenFloor) {
    // Floor, and two walls that meet at its far corner, seen from above.
    TriMesh room;
    room.vertices.resize(3, 7);
    room.vertices << 0, 1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 0, 0, 1;
    room.faces.resize(3, 6);
    room.faces << 0, 0, 0, 0, 0, 0, 2, 3, 1, 5, 4, 6, 1, 2, 5, 4, 6, 3;
    const Image image = shape_picture(in_one_color(room, {200, 200, 200}),
                                      named_view("top", UpAxis::y).value(), of_size(100));
    EXPECT_LT(image.pixel(12, 12)[1] + 25, image.pixel(80, 80)[1]);
}

TEST(ShapePicture, TheSameBytesTwiceAndWhateverTheUnit) {
    TriMesh mesh = test::torus(1.0, 0.4, 24, 12);
    const View view = view_from(UpAxis::y, 30.0, 35.0);
    const Image image = shape_picture(in_one_color(mesh, orange), view, of_size(80));
    EXPECT_EQ(image.bytes, shape_picture(in_one_color(mesh, orange), view, of_size(80)).bytes);
    mesh.vertices *= 1024.0;  // a power of two: the same mantissas
    EXPECT_EQ(image.bytes, shape_picture(in_one_color(mesh, orange), view, of_size(80)).bytes);
}

TEST(ShapePicture, AMeshThatShowsNothingIsBackground) {
    EXPECT_EQ(covered_pixels(shape_picture(PictureMesh(), View(), of_size(20))), 0);
}

TEST(PictureMesh, NormalsAreSmoothOnASphereAndSharpOnABox) {
    const TriMesh sphere = test::sphere(3);
    const Eigen::Matrix3Xf smooth = corner_normals(sphere, 40.0);
    for (int f = 0; f < sphere.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f outward =
                sphere.vertices.col(sphere.faces(k, f)).normalized().cast<float>();
            EXPECT_GT(smooth.col(3 * f + k).dot(outward), 0.999F);
        }
    }
    const Eigen::Matrix3Xf sharp = corner_normals(test::box(1.0, 2.0, 3.0, 4), 40.0);
    for (Eigen::Index c = 0; c < sharp.cols(); ++c)
        EXPECT_NEAR(sharp.col(c).cwiseAbs().maxCoeff(), 1.0F, 1e-6F);
}

TEST(PictureMesh, PolygonsKeepTheirColourAndRepeatedVerticesAreSmooth) {
    PolygonMesh square;  // a quad and a triangle beside it with vertices of its own
    square.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0.1}, {1, 1, 0}};
    square.offsets = {0, 4, 7};
    square.corners = {0, 1, 2, 3, 4, 5, 6};
    const PictureMesh picture = picture_mesh(square, {blue, orange});
    ASSERT_EQ(picture.mesh.face_count(), 3);
    EXPECT_EQ(picture.colors, (std::vector<Color>{blue, blue, orange}));
    EXPECT_EQ(picture.mesh.faces(0, 2), 1) << "the triangle shares the quad's vertices";
    EXPECT_NEAR(picture.mesh.vertices.colwise().norm().maxCoeff(), 1.0, 1e-12);
}

}  // namespace
}  // namespace coseg
