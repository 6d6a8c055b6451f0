// What src/repair/mesh_repair.hpp promises, on thousands of hostile meshes made from seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/repair/mesh_repair.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

using Eigen::Vector3d;

Vector3d random_point(SeededStream& random, double reach = 1.0) {
    const double x = random.uniform(-reach, reach);
    const double y = random.uniform(-reach, reach);
    return {x, y, random.uniform(-reach, reach)};
}

double power_of_ten(SeededStream& random, double low, double high) {
    return std::pow(10.0, random.uniform(low, high));
}

int below(SeededStream& random, int limit) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(limit));
}

void add_face(PolygonMesh& mesh, const std::vector<int>& corners) {
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
}

void add_triangle(PolygonMesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const int first = mesh.vertex_count();
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    add_face(mesh, {first, first + 1, first + 2});
}

void add_mesh(PolygonMesh& mesh, const PolygonMesh& other) {
    const int first = mesh.vertex_count();
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (int f = 0; f < other.face_count(); ++f) {
        std::vector<int> corners;
        for (int k = other.offsets[at(f)]; k < other.offsets[at(f) + 1]; ++k)
            corners.push_back(other.corners[at(k)] + first);
        add_face(mesh, corners);
    }
}

PolygonMesh body(SeededStream& random) {
    switch (below(random, 4)) {
        case 0:
            return test::as_polygons(test::sphere(1));
        case 1:
            return test::as_polygons(test::flat_square(3));
        case 2:
            return test::as_polygons(test::torus(1.0, 0.4, 7, 5));
        default:
            return test::as_polygons(test::box(1, 2, 3, 2));
    }
}

PolygonMesh turned(PolygonMesh mesh) {
    for (int f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.offsets[at(f)],
                     mesh.corners.begin() + mesh.offsets[at(f) + 1]);
    return mesh;
}

PolygonMesh stretched(PolygonMesh mesh, const Vector3d& scale, const Vector3d& shift) {
    for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(scale) + shift;
    return mesh;
}

PolygonMesh with_slivers(SeededStream& random) {
    PolygonMesh mesh = body(random);
    for (int k = 0; k < 10; ++k) {
        const Vector3d a = random_point(random);
        const Vector3d along = random_point(random, power_of_ten(random, -1, 3));
        const Vector3d aside = random_point(random, power_of_ten(random, -16, -1));
        add_triangle(mesh, a, a + along, a + random.uniform() * along + aside);
    }
    return mesh;
}

PolygonMesh fan(SeededStream& random) {
    PolygonMesh mesh;
    mesh.offsets = {0};
    const int n = 3 + below(random, 60);
    mesh.vertices.emplace_back(0.0, 0.0, random.uniform(-1.0, 1.0));
    for (int k = 0; k < n; ++k) {
        const double angle = 6.28318 * k / n;
        mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    for (int k = 0; k < n; ++k) {
        const int next = 1 + (k + 1) % n;
        add_face(mesh,
                 random() % 4 == 0 ? std::vector<int>{0, next, 1 + k} : std::vector<int>{0, 1 + k, next});
        if (random() % 5 == 0) add_face(mesh, {0, 1 + below(random, n), 1 + below(random, n)});
    }
    return mesh;
}

PolygonMesh with_doubles(SeededStream& random) {
    PolygonMesh mesh = body(random);
    const PolygonMesh once = mesh;
    if (random() % 2 == 0) {
        add_mesh(mesh, random() % 2 == 0 ? once : turned(once));
    } else {
        for (int f = 0; f < once.face_count(); ++f) {
            if (random() % 3 == 0) continue;
            std::vector<int> corners(once.corners.begin() + once.offsets[at(f)],
                                     once.corners.begin() + once.offsets[at(f) + 1]);
            if (random() % 2 == 0) std::reverse(corners.begin(), corners.end());
            add_face(mesh, corners);
        }
    }
    return mesh;
}

PolygonMesh dust(SeededStream& random) {
    PolygonMesh mesh = body(random);
    const double size = power_of_ten(random, -12, -1);
    for (int k = 0; k < 40; ++k) {
        const Vector3d centre = random_point(random);
        add_triangle(mesh, centre + random_point(random, size), centre + random_point(random, size),
                     centre + random_point(random, size));
    }
    return mesh;
}

PolygonMesh nested_shells(SeededStream& random) {
    PolygonMesh mesh = body(random);
    const PolygonMesh first = mesh;
    for (int k = 1; k < 2 + below(random, 4); ++k) {
        const double scale = random() % 2 == 0 ? 1.0 - k * 1e-6 : std::pow(0.5, k);
        const PolygonMesh shell = stretched(first, Vector3d::Constant(scale), Vector3d::Zero());
        add_mesh(mesh, random() % 2 == 0 ? shell : turned(shell));
    }
    return mesh;
}

PolygonMesh extreme(SeededStream& random) {
    constexpr double scales[] = {1e30, 1e-30, 1e150, 1e-150, 1e300, 1e-300};
    PolygonMesh mesh = body(random);
    const double scale = scales[random() % 6];
    const double shift = random() % 2 == 0 ? 0.0 : scale * power_of_ten(random, 0, 6);
    return stretched(std::move(mesh), Vector3d::Constant(scale), Vector3d::Constant(shift));
}

PolygonMesh squeezed(SeededStream& random) {
    const double x = power_of_ten(random, -9, 9);
    const double y = power_of_ten(random, -9, 9);
    return stretched(body(random), {x, y, power_of_ten(random, -9, 9)}, Vector3d::Zero());
}

/// Polygons over any vertices, many of them at the same place.
PolygonMesh soup(SeededStream& random) {
    PolygonMesh mesh;
    mesh.offsets = {0};
    const int points = 4 + below(random, 20);
    for (int v = 0; v < points; ++v)
        mesh.vertices.emplace_back(below(random, 4), below(random, 4), below(random, 3));
    for (int f = 0; f < 50; ++f) {
        std::vector<int> corners(random() % 7);
        for (int& corner : corners) corner = below(random, points);
        add_face(mesh, corners);
    }
    add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return mesh;
}

struct Kind {
    const char* name;
    PolygonMesh (*make)(SeededStream&);
    int least_closed;  ///< of 150 meshes, how many are closed after the repair
};
constexpr Kind kinds[] = {{"slivers", with_slivers, 0},  {"fan", fan, 0},
                          {"doubled", with_doubles, 50}, {"dust", dust, 0},
                          {"shells", nested_shells, 90}, {"extreme", extreme, 80},
                          {"squeezed", squeezed, 10},    {"soup", soup, 0}};

void expect_face_map(const RepairedMesh& repaired, const PolygonMesh& input) {
    const FaceMap& map = repaired.map;
    ASSERT_EQ(map.input_faces, input.face_count());
    ASSERT_EQ(static_cast<int>(map.input_face.size()), repaired.mesh.face_count());
    std::vector<char> has_working(at(input.face_count()), 0);
    for (const int f : map.input_face) {
        ASSERT_TRUE(f >= 0 && f < input.face_count());
        has_working[at(f)] = 1;
    }
    ASSERT_EQ(static_cast<int>(map.label_donor.size()), input.face_count());
    for (int f = 0; f < input.face_count(); ++f) {
        const int donor = map.label_donor[at(f)];
        ASSERT_TRUE(donor >= 0 && donor < input.face_count());
        ASSERT_NE(has_working[at(donor)], 0);
        ASSERT_EQ(donor == f, has_working[at(f)] != 0);
    }
}

/// A triangle of a polygon's corners each, and what splitting neighbours of flat triangles adds.
void expect_bounded(const RepairedMesh& repaired, const PolygonMesh& input) {
    ASSERT_LE(repaired.mesh.face_count(), 2 * static_cast<int>(input.corners.size()));
    ASSERT_LE(repaired.mesh.vertex_count(), 3 * repaired.mesh.face_count());
}

/// A closed manifold comes back as it is, unless it is so flat that it has no outside. True if this is one.
bool stays_if_closed(const RepairedMesh& repaired) {
    const double reach = repaired.mesh.vertices.cwiseAbs().maxCoeff();
    if (test::boundary_edges(repaired.mesh) > 0) return false;
    if (test::signed_volume(repaired.mesh) < 1e-6 * reach * reach * reach) return false;
    const RepairedMesh again = repair(test::as_polygons(repaired.mesh), "mesh");
    EXPECT_EQ(again.mesh.faces, repaired.mesh.faces);
    EXPECT_EQ(again.mesh.vertices, repaired.mesh.vertices);
    return true;
}

class MeshRepairProperties : public testing::TestWithParam<Kind> {};

TEST_P(MeshRepairProperties, HoldOnHostileMeshes) {
    constexpr BorderLimits weldings[] = {BorderLimits{}, no_border_welding, border_welding_within(1e-2)};
    int used = 0;
    int closed = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        SeededStream random(hash_words({hash_text(GetParam().name), seed}));
        const PolygonMesh input = GetParam().make(random);
        try {
            const RepairedMesh repaired = repair(input, "mesh", weldings[seed % 3]);
            ++used;
            ASSERT_EQ(test::manifold_defect(repaired.mesh), "");
            ASSERT_TRUE(repaired.mesh.vertices.allFinite());
            ASSERT_NO_FATAL_FAILURE(expect_face_map(repaired, input));
            ASSERT_NO_FATAL_FAILURE(expect_bounded(repaired, input));
            closed += stays_if_closed(repaired) ? 1 : 0;
            ASSERT_FALSE(HasFailure());
        } catch (const Error& error) {
            ASSERT_EQ(std::string(error.what()),
                      "mesh: no face has an area; check the coordinates and the faces");
        }
    }
    EXPECT_GE(used, 140) << "hardly any of these meshes can be used";
    EXPECT_GE(closed, GetParam().least_closed);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MeshRepairProperties, testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace coseg
