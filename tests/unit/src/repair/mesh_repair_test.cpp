#include "src/repair/mesh_repair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <numeric>

#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/polygon_triangulation.hpp"
#include "src/remesh/midpoint_refinement.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

using Eigen::Vector3d;
using test::as_polygons;
using test::boundary_edges;
using test::manifold_defect;
using test::polygons_of;

void expect_sound(const RepairedMesh& repaired, const PolygonMesh& input) {
    EXPECT_EQ(manifold_defect(repaired.mesh), "");
    ASSERT_EQ(repaired.map.input_faces, input.face_count());
    ASSERT_EQ(static_cast<int>(repaired.map.input_face.size()), repaired.mesh.face_count());
    ASSERT_EQ(static_cast<int>(repaired.map.label_donor.size()), input.face_count());
    std::vector<char> has_working(static_cast<std::size_t>(input.face_count()), 0);
    for (const int f : repaired.map.input_face) {
        ASSERT_TRUE(0 <= f && f < input.face_count());
        has_working[static_cast<std::size_t>(f)] = 1;
    }
    for (int f = 0; f < input.face_count(); ++f) {
        const int label_donor = repaired.map.label_donor[static_cast<std::size_t>(f)];
        EXPECT_TRUE(has_working[static_cast<std::size_t>(label_donor)] != 0) << f;
        EXPECT_EQ(label_donor == f, has_working[static_cast<std::size_t>(f)] != 0) << f;
    }
    EXPECT_GT(face_geometry(repaired.mesh).area.minCoeff(), 0.0);
}

RepairedMesh repaired_soundly(const PolygonMesh& input) {
    RepairedMesh repaired = repair(input, "mesh");
    expect_sound(repaired, input);
    return repaired;
}

bool warns_of(const RepairedMesh& repaired, const std::string& words) {
    for (const std::string& warning : repaired.warnings) {
        if (warning.find(words) != std::string::npos && warning.rfind("mesh: ", 0) == 0) return true;
    }
    return false;
}

int components(const TriMesh& mesh) {
    const std::vector<int> component = face_components(dual_graph(mesh, face_geometry(mesh)));
    return 1 + *std::max_element(component.begin(), component.end());
}

void expect_same_mesh(const TriMesh& a, const TriMesh& b) {
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.faces, b.faces);
}

const std::vector<Vector3d> cube_corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<std::vector<int>> cube_faces{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

PolygonMesh cubes(const std::vector<Vector3d>& offsets) {
    std::vector<Vector3d> points;
    std::vector<std::vector<int>> faces;
    for (const Vector3d& offset : offsets) {
        const int base = static_cast<int>(points.size());
        for (const Vector3d& p : cube_corners) points.emplace_back(p + offset);
        for (const auto& face : cube_faces) {
            faces.emplace_back();
            for (const int v : face) faces.back().push_back(v + base);
        }
    }
    return polygons_of(points, faces);
}

/// Vertices with equal coordinates made one, whatever that does to the mesh.
PolygonMesh glued(const PolygonMesh& mesh) {
    PolygonMesh result = mesh;
    for (int& corner : result.corners) {
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (mesh.vertices[static_cast<std::size_t>(v)] != mesh.vertices[static_cast<std::size_t>(corner)])
                continue;
            corner = v;
            break;
        }
    }
    return result;
}

TEST(MeshRepair, GoodMeshesStayAsTheyAre) {
    for (const TriMesh& mesh :
         {test::sphere(3), test::box(1, 2, 3, 6), test::torus(1, 0.3, 24, 12), test::flat_square(5),
          test::disjoint_union(test::sphere(2), test::box(1, 1, 1, 3))}) {
        const RepairedMesh repaired = repaired_soundly(as_polygons(mesh));
        expect_same_mesh(repaired.mesh, mesh);
        EXPECT_TRUE(repaired.warnings.empty());
        std::vector<int> identity(static_cast<std::size_t>(mesh.face_count()));
        std::iota(identity.begin(), identity.end(), 0);
        EXPECT_EQ(repaired.map.input_face, identity);
        EXPECT_EQ(repaired.map.label_donor, identity);
    }
}

TEST(MeshRepair, SameAtAnyScaleAndPlace) {
    for (const double scale : {1e-8, 1.0, 1e8}) {
        TriMesh mesh = test::torus(1, 0.3, 24, 12);
        mesh.vertices *= scale;
        mesh.vertices.colwise() += Vector3d(10 * scale, 0, 0);
        const RepairedMesh repaired = repaired_soundly(as_polygons(mesh));
        expect_same_mesh(repaired.mesh, mesh);
        EXPECT_TRUE(repaired.warnings.empty());
    }
}

TEST(MeshRepair, CubeOfQuads) {
    const RepairedMesh repaired = repaired_soundly(cubes({Vector3d::Zero()}));
    EXPECT_EQ(repaired.mesh.face_count(), 12);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_NEAR(test::signed_volume(repaired.mesh), 1.0, 1e-15);
    EXPECT_EQ(repaired.map.input_face, (std::vector<int>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
    EXPECT_TRUE(repaired.warnings.empty());
}

TEST(MeshRepair, ConcavePolygonsKeepTheirArea) {
    // An L, a dart, a comb, and a regular polygon, in a tilted plane.
    std::vector<std::vector<Eigen::Vector2d>> shapes{
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
        {{0, 0}, {2, 1}, {0, 2}, {0.5, 1}},
        {{0, 0}, {5, 0}, {5, 2}, {4, 2}, {4, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
        {}};
    for (int k = 0; k < 40; ++k)
        shapes.back().emplace_back(std::cos(2 * std::numbers::pi * k / 40),
                                   std::sin(2 * std::numbers::pi * k / 40));
    const Vector3d u = Vector3d(1, 2, -1).normalized();
    const Vector3d v = u.unitOrthogonal();
    for (const auto& shape : shapes) {
        std::vector<Vector3d> corners;
        for (const auto& p : shape) corners.emplace_back(Vector3d(3, 4, 5) + p.x() * u + p.y() * v);
        double area = 0.0;
        const Vector3d normal = polygon_area_vector(corners);
        for (const Eigen::Vector3i& t : triangulate_polygon(corners)) {
            const auto corner = [&](int k) { return corners[static_cast<std::size_t>(t[k])]; };
            const Vector3d part = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0));
            EXPECT_GT(part.dot(normal), 0.0);
            area += part.norm();
        }
        EXPECT_EQ(triangulate_polygon(corners).size(), corners.size() - 2);
        EXPECT_NEAR(area, normal.norm(), 1e-12);
    }
}

TEST(MeshRepair, PolygonsThatCrossThemselvesAndHugeOnesEnd) {
    SeededStream random(3);
    for (const int corners : {5, 17, 400, 100000}) {
        std::vector<Vector3d> points;
        for (int k = 0; k < corners; ++k)
            points.emplace_back(random.uniform(), random.uniform(), 0.1 * random.uniform());
        EXPECT_EQ(triangulate_polygon(points).size(), points.size() - 2);
    }
}

TEST(MeshRepair, SoupIsWelded) {
    const TriMesh sphere = test::sphere(2);
    const RepairedMesh repaired = repaired_soundly(test::soup_of(as_polygons(sphere)));
    EXPECT_EQ(repaired.mesh.vertex_count(), sphere.vertex_count());
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_TRUE(warns_of(repaired, "798 repeated vertices are welded"));
}

TEST(MeshRepair, SeamIsWelded) {
    TriMesh tube = test::torus(1, 0.3, 24, 12);
    PolygonMesh input = as_polygons(tube);  // the faces of the last ring get their own copies of ring 0
    for (int v = 0; v < 12; ++v) input.vertices.push_back(input.vertices[static_cast<std::size_t>(v)]);
    for (std::size_t k = 3 * 2 * 12 * 23; k < input.corners.size(); ++k) {
        if (input.corners[k] < 12) input.corners[k] += 24 * 12;
    }
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_TRUE(warns_of(repaired, "12 repeated vertices are welded"));
}

TEST(MeshRepair, ClosedPartsThatTouchStayApart) {
    const PolygonMesh input = cubes({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(components(repaired.mesh), 3);
    EXPECT_EQ(repaired.mesh.vertex_count(), 24);
    EXPECT_TRUE(repaired.warnings.empty());
}

TEST(MeshRepair, TwoCubesOnOneEdgeComeApartAsTwoSolids) {
    const PolygonMesh input = glued(cubes({{0, 0, 0}, {1, 1, 0}}));
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_EQ(components(repaired.mesh), 2);
    EXPECT_NEAR(test::signed_volume(repaired.mesh), 2.0, 1e-14);
    EXPECT_TRUE(warns_of(repaired, "1 edge has three or more faces"));
}

TEST(MeshRepair, TwoCubesOnOneCornerComeApart) {
    const PolygonMesh input = glued(cubes({{0, 0, 0}, {1, 1, 1}}));
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(components(repaired.mesh), 2);
    EXPECT_EQ(repaired.mesh.vertex_count(), 16);
    EXPECT_TRUE(warns_of(repaired, "1 copy of a vertex"));
}

TEST(MeshRepair, CubesStackedOnAFaceKeepAllFaces) {
    const RepairedMesh repaired = repaired_soundly(glued(cubes({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}})));
    EXPECT_EQ(repaired.mesh.face_count(), 36);
    EXPECT_NEAR(test::signed_volume(repaired.mesh), 3.0, 1e-14);
}

TEST(MeshRepair, DuplicateFacesAreKept) {
    PolygonMesh input = as_polygons(test::sphere(1));
    for (int k = 0; k < 6; ++k) input.corners.push_back(input.corners[static_cast<std::size_t>(k)]);
    input.offsets.push_back(static_cast<int>(input.corners.size()) - 3);
    input.offsets.push_back(static_cast<int>(input.corners.size()));
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(repaired.mesh.face_count(), 82);
    EXPECT_TRUE(warns_of(repaired, "2 faces lie upon others and share their parts"));
    // Both doubles have working faces, and the labels of these are counted for both.
    EXPECT_EQ(std::count(repaired.map.input_face.begin(), repaired.map.input_face.end(), 0), 2);
    EXPECT_EQ(repaired.map.label_donor[80], 0);
}

TEST(MeshRepair, TwoSidedSheetIsOneSheet) {
    PolygonMesh input = as_polygons(test::flat_square(4));
    const std::size_t corners = input.corners.size();
    for (std::size_t k = 0; k < corners; k += 3) {
        for (const std::size_t c : {k, k + 2, k + 1}) input.corners.push_back(input.corners[c]);
        input.offsets.push_back(static_cast<int>(input.corners.size()));
    }
    const RepairedMesh repaired = repaired_soundly(input);
    expect_same_mesh(repaired.mesh, test::flat_square(4));
    EXPECT_TRUE(warns_of(repaired, "32 faces lie upon others and share their parts"));
}

TEST(MeshRepair, FinIsCutOff) {
    PolygonMesh input = as_polygons(test::flat_square(4));
    input.vertices.emplace_back(0.5, 0.5, 1.0);
    input.corners.insert(input.corners.end(), {12, 17, 25});
    input.offsets.push_back(static_cast<int>(input.corners.size()));
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(repaired.mesh.face_count(), 33);
    EXPECT_TRUE(warns_of(repaired, "1 edge has three or more faces"));
}

TEST(MeshRepair, OrientationIsMadeConsistentAndOutward) {
    TriMesh mesh = test::disjoint_union(test::sphere(2), test::box(1, 2, 3, 4));
    PolygonMesh input = as_polygons(mesh);
    SeededStream random(11);
    for (std::size_t k = 0; k < input.corners.size(); k += 3) {
        if (random() % 2 == 0) std::swap(input.corners[k], input.corners[k + 1]);
    }
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_NEAR(test::signed_volume(repaired.mesh), test::signed_volume(mesh), 1e-12);
    EXPECT_TRUE(warns_of(repaired, "triangles are turned to face outward"));
}

TEST(MeshRepair, SolidsWithHolesFaceOutward) {
    const TriMesh ball = test::sphere(2);
    const auto part_of_ball = [&](const auto& has) {
        std::vector<std::vector<int>> faces;
        for (int f = 0; f < ball.face_count(); ++f) {
            const Vector3d centre =
                (ball.vertices.col(ball.faces(0, f)) + ball.vertices.col(ball.faces(1, f)) +
                 ball.vertices.col(ball.faces(2, f))) /
                3.0;
            if (has(f, centre)) faces.push_back({ball.faces(1, f), ball.faces(0, f), ball.faces(2, f)});
        }
        std::vector<Vector3d> points;
        for (int v = 0; v < ball.vertex_count(); ++v) points.emplace_back(ball.vertices.col(v));
        return polygons_of(points, faces);
    };
    for (const PolygonMesh& inside_out :
         {part_of_ball([](int f, const Vector3d&) { return f != 0; }),
          part_of_ball([](int, const Vector3d&c) { return c.z() > 0.0; }),
          part_of_ball([](int, const Vector3d&c) { return std::abs(c.z()) < 0.6; })}) {
        const RepairedMesh repaired = repaired_soundly(inside_out);
        EXPECT_TRUE(warns_of(repaired, "triangles are turned to face outward"));
        const Eigen::Matrix3Xd normals = face_normals(repaired.mesh);
        for (int f = 0; f < repaired.mesh.face_count(); ++f)
            EXPECT_GT(normals.col(f).dot(repaired.mesh.vertices.col(repaired.mesh.faces(0, f))), 0.0);
    }
}

TEST(MeshRepair, OpenSurfaceKeepsTheSideOfItsLargerPart) {
    PolygonMesh input = as_polygons(test::flat_square(4));
    std::swap(input.corners[0], input.corners[1]);
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_GT(face_normals(repaired.mesh).row(2).minCoeff(), 0.99);
}

TEST(MeshRepair, MoebiusStripIsCutOnce) {
    std::vector<Vector3d> points;
    std::vector<std::vector<int>> faces;
    const int n = 30;
    for (int i = 0; i < n; ++i) {
        const double t = 2 * std::numbers::pi * i / n;
        for (const double s : {-0.3, 0.0, 0.3}) {
            const double r = 1 + s * std::cos(t / 2);
            points.emplace_back(r * std::cos(t), r * std::sin(t), s * std::sin(t / 2));
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2; ++j) {
            const bool last = i + 1 == n;
            const auto next = [&](int k) { return last ? 2 - k : 3 * (i + 1) + k; };
            faces.push_back({3 * i + j, next(j), next(j + 1), 3 * i + j + 1});
        }
    }
    const PolygonMesh input = polygons_of(points, faces);
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(repaired.mesh.face_count(), 4 * n);
    EXPECT_TRUE(warns_of(repaired, "cannot be oriented alike"));
    EXPECT_EQ(components(repaired.mesh), 1);
}

TEST(MeshRepair, KleinBottleIsCutOpen) {
    std::vector<std::vector<int>> faces;
    std::vector<Vector3d> points;
    const int n = 8;
    SeededStream random(5);
    for (int i = 0; i < n * n; ++i) points.emplace_back(random.uniform(), random.uniform(), random.uniform());
    const auto vertex = [&](int i, int j) { return i < n ? i * n + j % n : (n - j % n) % n; };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
    const PolygonMesh input = polygons_of(points, faces);
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(repaired.mesh.face_count(), 2 * n * n);
    EXPECT_TRUE(warns_of(repaired, "cannot be oriented alike"));
}

TEST(MeshRepair, DegenerateFacesGetTheNeighbourThatSharesMost) {
    PolygonMesh input = as_polygons(test::flat_square(2));  // face 0 = (0, 3, 4)
    input.corners.insert(input.corners.end(), {0, 3, 3, 4, 4, 4, 8});
    input.offsets.insert(input.offsets.end(), {27, 30, 31});
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(repaired.mesh.face_count(), 8);
    EXPECT_EQ(repaired.map.label_donor[8], 0);
    EXPECT_EQ(repaired.map.label_donor[10], 6);
    EXPECT_TRUE(warns_of(repaired, "3 faces without area"));
}

TEST(MeshRepair, LonelyDegenerateFaceTakesTheNearest) {
    PolygonMesh input = as_polygons(test::sphere(1));
    input.vertices.emplace_back(3.0 * input.vertices[0]);
    const int v = input.vertex_count() - 1;
    input.corners.insert(input.corners.end(), {v, v, v});
    input.offsets.push_back(static_cast<int>(input.corners.size()));
    const RepairedMesh repaired = repaired_soundly(input);
    const int label_donor = repaired.map.label_donor.back();
    const FaceGeometry geometry = face_geometry(repaired.mesh);
    const Vector3d target = input.vertices.back();
    for (int f = 0; f < 80; ++f) {
        EXPECT_LE((geometry.centroid.col(label_donor) - target).norm(),
                  (geometry.centroid.col(f) - target).norm() + 1e-12);
    }
}

TEST(MeshRepair, FlatTriangleInAClosedMeshLeavesNoGap) {
    // The top of a box has a vertex on its edge: triangle (4, 8, 5) has no area, its neighbour (0 1 5 4) is
    // split.
    std::vector<Vector3d> points = cube_corners;
    points.emplace_back(0.5, 0, 1);
    const PolygonMesh input = polygons_of(points, {{3, 2, 1, 0},
                                                   {4, 8, 5, 6, 7},
                                                   {0, 1, 5},
                                                   {0, 5, 4},
                                                   {4, 5, 8},
                                                   {1, 2, 6, 5},
                                                   {2, 3, 7, 6},
                                                   {3, 0, 4, 7}});
    const RepairedMesh repaired = repaired_soundly(input);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
    EXPECT_NEAR(test::signed_volume(repaired.mesh), 1.0, 1e-14);
    EXPECT_EQ(repaired.map.input_face.back(), 3);  // the second half of the split neighbour
    EXPECT_TRUE(warns_of(repaired, "1 face without area"));
}

TEST(MeshRepair, EdgeWithoutLengthInAClosedMeshIsClosedUp) {
    TriMesh mesh = test::sphere(2);
    const int moved = mesh.faces(0, 10);
    mesh.vertices.col(moved) = Vector3d(mesh.vertices.col(mesh.faces(1, 10)));
    const RepairedMesh repaired = repaired_soundly(as_polygons(mesh));
    EXPECT_EQ(repaired.mesh.face_count(), mesh.face_count() - 2);
    EXPECT_EQ(boundary_edges(repaired.mesh), 0);
}

TEST(MeshRepair, UnusedVerticesAreLeftOut) {
    PolygonMesh input = as_polygons(test::sphere(1));
    input.vertices.insert(input.vertices.begin(), Vector3d(9, 9, 9));
    for (int& corner : input.corners) ++corner;
    const RepairedMesh repaired = repaired_soundly(input);
    expect_same_mesh(repaired.mesh, test::sphere(1));
    EXPECT_TRUE(warns_of(repaired, "1 vertex belongs to no face"));
}

TEST(MeshRepair, RandomTriangleSoupBecomesManifold) {
    SeededStream random(17);
    for (int round = 0; round < 300; ++round) {
        const int vertices = 4 + static_cast<int>(random() % 12);
        std::vector<Vector3d> points;
        for (int v = 0; v < vertices; ++v) points.emplace_back(random() % 4, random() % 4, random() % 3);
        std::vector<std::vector<int>> faces{{0, 1, 2}};
        points[0] = {0, 0, 0}, points[1] = {1, 0, 0}, points[2] = {0, 1, 0};
        for (int f = 0; f < 60; ++f) {
            faces.emplace_back();
            for (std::size_t k = 0; k < 3 + random() % 3; ++k)
                faces.back().push_back(static_cast<int>(random() % static_cast<unsigned>(vertices)));
        }
        const PolygonMesh input = polygons_of(points, faces);
        const RepairedMesh once = repaired_soundly(input);
        const RepairedMesh again = repair(input, "mesh");
        expect_same_mesh(once.mesh, again.mesh);
        EXPECT_EQ(once.warnings, again.warnings);
        RepairedMesh refined = once;
        refine_to_face_count(refined.mesh, refined.map, 2 * once.mesh.face_count());
        EXPECT_EQ(manifold_defect(refined.mesh), "");
    }
}

TEST(MeshRepair, RefusesWhatHasNoArea) {
    const PolygonMesh line = polygons_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
    const test::Caught no_area = test::error_of([&] { repair(line, "mesh"); });
    EXPECT_EQ(no_area.code, ExitCode::input);
    EXPECT_NE(no_area.sentence.find("mesh: no face has an area"), std::string::npos);
    const PolygonMesh bad = polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}});
    EXPECT_NE(test::error_of([&] { repair(bad, "mesh"); }).sentence.find("face 0 refers to vertex 3"),
              std::string::npos);
    const PolygonMesh nan = polygons_of({{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}}, {{0, 1, 2}});
    EXPECT_NE(test::error_of([&] { repair(nan, "mesh"); }).sentence.find("vertex 2"), std::string::npos);
}

void expect_stays_as_it_is(const PolygonMesh& input, const std::string& name) {
    const RepairedMesh repaired = repair(input, name);
    const Eigen::Matrix3Xi& faces = repaired.mesh.faces;
    EXPECT_EQ(std::vector<int>(faces.data(), faces.data() + faces.size()), input.corners) << name;
    EXPECT_EQ(repaired.mesh.vertex_count(), input.vertex_count()) << name;
    EXPECT_TRUE(repaired.warnings.empty()) << repaired.warnings[0];
}

TEST(MeshRepair, GeneratedMeshesStayAsTheyAre) {
    for (const auto& [name, shape] : test::generated_shapes())
        expect_stays_as_it_is(as_polygons(shape.mesh), name);
}

TEST(MeshRepair, RealMeshesStayAsTheyAre) {
    const std::vector<std::string> meshes = test::real_meshes();
    if (meshes.empty()) GTEST_SKIP() << "no real meshes; set COSEG_DATA";
    std::vector<std::string> clean;  // as those of the Princeton Segmentation Benchmark are
    for (const std::string& mesh : meshes) {
        if (mesh.find("/psb_") != std::string::npos) clean.push_back(mesh);
    }
    for (std::size_t i = 0; i < clean.size(); i += 5) expect_stays_as_it_is(read_mesh(clean[i]), clean[i]);
}

TEST(FaceMap, LargestAreaWinsTiesGoToTheLowestLabel) {
    FaceMap map;
    map.input_faces = 4;
    map.input_face = {0, 0, 0, 1, 1, 0};
    map.label_donor = {0, 1, 3, 1};
    Eigen::VectorXd area(6);
    area << 1, 2, 1.5, 1, 1, 1;
    EXPECT_EQ(carry_labels_back(map, {7, 4, 7, 5, 3, 9}, area), (std::vector<int>{7, 3, 3, 3}));
}

TEST(FaceMap, ImpossibleMapsAreRefused) {
    FaceMap map;
    map.input_faces = 3;
    map.input_face = {0};
    map.label_donor = {0, 2, 1};
    EXPECT_EQ(test::error_of([&] { carry_labels_back(map, {1}, Eigen::VectorXd::Ones(1)); }).code,
              ExitCode::internal);
    map.label_donor = {0, 0, 1};
    EXPECT_EQ(carry_labels_back(map, {6}, Eigen::VectorXd::Ones(1)), (std::vector<int>{6, 6, 6}));
    EXPECT_EQ(test::error_of([&] {
                  carry_labels_back(map, {1, 2}, Eigen::VectorXd::Ones(1));
              }).code,
              ExitCode::internal);
}

}  // namespace
}  // namespace coseg
