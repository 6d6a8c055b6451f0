#include "src/repair/doubled_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "src/base/index.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/repair/mesh_repair.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

enum class Copy { same_vertices, own_vertices };
enum class Side { same, turned };

/// Every face of the mesh a second time; with `interleaved` a copy stands before its original every other
/// time.
PolygonMesh every_face_twice(const TriMesh& mesh, Copy copy, Side side, bool interleaved = false) {
    PolygonMesh twice = test::as_polygons(mesh);
    const int shift = copy == Copy::own_vertices ? mesh.vertex_count() : 0;
    if (shift > 0) {
        for (int v = 0; v < shift; ++v) twice.vertices.push_back(Eigen::Vector3d(twice.vertices[at(v)]));
    }
    twice.corners.clear();
    twice.offsets = {0};
    const auto add = [&](int f, bool is_copy) {
        const bool turns = is_copy && side == Side::turned;
        const int first = is_copy ? shift : 0;
        for (const int k : {0, turns ? 2 : 1, turns ? 1 : 2})
            twice.corners.push_back(mesh.faces(k, f) + first);
        twice.offsets.push_back(static_cast<int>(twice.corners.size()));
    };
    if (interleaved) {
        for (int f = 0; f < mesh.face_count(); ++f) add(f, f % 2 == 0), add(f, f % 2 == 1);
    } else {
        for (const bool is_copy : {false, true}) {
            for (int f = 0; f < mesh.face_count(); ++f) add(f, is_copy);
        }
    }
    return twice;
}

/// Labels that differ from working face to working face, carried back to the faces of the input.
std::vector<int> carried_labels(const RepairedMesh& repaired) {
    std::vector<int> labels(repaired.map.input_face.size());
    std::iota(labels.begin(), labels.end(), 0);
    return carry_labels_back(repaired.map, labels, face_geometry(repaired.mesh).area);
}

TEST(DoubledFaces, AMeshWhoseFacesAllComeTwiceIsThatMesh) {
    for (const TriMesh& mesh : {test::sphere(2), test::flat_square(6), test::torus(1.0, 0.3, 12, 8)}) {
        for (const Copy copy : {Copy::same_vertices, Copy::own_vertices}) {
            for (const Side side : {Side::same, Side::turned}) {
                const RepairedMesh repaired = repair(every_face_twice(mesh, copy, side), "mesh");
                EXPECT_EQ(repaired.mesh.vertices, mesh.vertices);
                EXPECT_EQ(repaired.mesh.faces, mesh.faces);
                const std::vector<int> labels = carried_labels(repaired);
                for (int f = 0; f < mesh.face_count(); ++f)
                    ASSERT_EQ(labels[at(f)], labels[at(f + mesh.face_count())]);
            }
        }
    }
}

TEST(DoubledFaces, CopiesMayStandAnywhere) {
    const TriMesh mesh = test::sphere(2);
    for (const Side side : {Side::same, Side::turned}) {
        const RepairedMesh repaired = repair(every_face_twice(mesh, Copy::own_vertices, side, true), "mesh");
        EXPECT_EQ(repaired.mesh.face_count(), mesh.face_count());
        EXPECT_EQ(test::manifold_defect(repaired.mesh), "");
        EXPECT_EQ(test::boundary_edges(repaired.mesh), 0);
        const std::vector<int> labels = carried_labels(repaired);
        for (int f = 0; f < mesh.face_count(); ++f) ASSERT_EQ(labels[at(2 * f)], labels[at(2 * f + 1)]);
    }
}

TEST(DoubledFaces, AStickerTakesTheLabelsBelow) {
    const TriMesh sphere = test::sphere(2);
    PolygonMesh mesh = test::as_polygons(sphere);
    const int faces = mesh.face_count();
    std::vector<int> below;
    for (int f = 0; f < faces; f += 1) {
        double z = 0.0;
        for (int k = 0; k < 3; ++k) z += sphere.vertices(2, sphere.faces(k, f));
        if (z < 2.0) continue;
        below.push_back(f);
        for (int k = 0; k < 3; ++k) {
            mesh.corners.push_back(mesh.vertex_count());
            mesh.vertices.emplace_back(sphere.vertices.col(sphere.faces(k, f)));
        }
        mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
    }
    ASSERT_GT(below.size(), 5U);
    const RepairedMesh repaired = repair(mesh, "mesh");
    EXPECT_EQ(repaired.mesh.faces, sphere.faces);
    const std::vector<int> labels = carried_labels(repaired);
    for (std::size_t k = 0; k < below.size(); ++k)
        EXPECT_EQ(labels[static_cast<std::size_t>(faces) + k], labels[at(below[k])]);
}

TEST(DoubledFaces, SolidsThatTouchStayWhole) {
    const TriMesh box = test::box(1, 1, 1, 2);
    TriMesh beside = box;
    beside.vertices.row(0).array() += 1.0;
    const PolygonMesh mesh = test::as_polygons(test::disjoint_union(box, beside));
    const DoubledFaces doubles = find_doubled_faces(mesh, test::each_its_own(mesh));
    EXPECT_EQ(doubles.count, 0);
    EXPECT_EQ(std::count(doubles.left_out.begin(), doubles.left_out.end(), 1), 0);
    EXPECT_EQ(doubles.vertex_of, test::each_its_own(mesh));
}

TEST(DoubledFaces, AFinStaysAtItsBodyAndHasOneLabelAFace) {
    // A closed sphere with a fin of one triangle, given for both sides.
    PolygonMesh mesh = test::as_polygons(test::sphere(2));
    const int tip = mesh.vertex_count();
    mesh.vertices.push_back(2.0 * mesh.vertices[at(mesh.corners[0])]);
    mesh.corners.insert(mesh.corners.end(),
                        {mesh.corners[0], mesh.corners[1], tip, mesh.corners[1], mesh.corners[0], tip});
    const int corners = static_cast<int>(mesh.corners.size());
    mesh.offsets.insert(mesh.offsets.end(), {corners - 3, corners});
    const DoubledFaces doubles = find_doubled_faces(mesh, test::each_its_own(mesh));
    EXPECT_EQ(std::count(doubles.left_out.begin(), doubles.left_out.end(), 1), 0);
    EXPECT_EQ(doubles.count, 1);
    const RepairedMesh repaired = repair(mesh, "mesh");
    EXPECT_EQ(repaired.mesh.face_count(), mesh.face_count());
    const std::vector<int> labels = carried_labels(repaired);
    EXPECT_EQ(labels[labels.size() - 1], labels[labels.size() - 2]);
}

TEST(DoubledFaces, NegativeZerosAreZeros) {
    const PolygonMesh mesh = test::polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 1, -0.0}},
                                               {{0, 1, 2}, {1, 3, 0}, {0, 0, 0}, {0, 0, 0}});
    const DoubledFaces doubles = find_doubled_faces(mesh, test::each_its_own(mesh));
    EXPECT_EQ(doubles.left_out[1], 1);
    EXPECT_EQ(doubles.label_of[1], 0);
}

}  // namespace
}  // namespace coseg
