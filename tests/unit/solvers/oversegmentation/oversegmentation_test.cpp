#include "solvers/oversegmentation/oversegmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/connected_pieces.hpp"
#include "src/mesh/dihedral_cost.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/revolution.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

struct Prepared {
    TriMesh mesh;
    FaceGeometry geometry;
    DualGraph graph;
};

Prepared prepared(TriMesh mesh) {
    scale_to_unit_area(mesh);
    FaceGeometry geometry = face_geometry(mesh);
    DualGraph graph = dual_graph(mesh, geometry);
    return {std::move(mesh), std::move(geometry), std::move(graph)};
}

int count_of(const std::vector<int>& patch) { return *std::max_element(patch.begin(), patch.end()) + 1; }

void expect_valid(const std::vector<int>& patch, const DualGraph& graph, int expected_patches) {
    ASSERT_EQ(static_cast<int>(patch.size()), graph.face_count);
    // Pieces are numbered by lowest face, as patches are: equal numbers mean connected, non-empty and in
    // order.
    EXPECT_EQ(connected_pieces(graph, patch), patch);
    EXPECT_EQ(count_of(patch), expected_patches);
}

/// Share of the area in the best overlaps: every patch of a counts with the patch of b it shares most
/// with.
double agreement(const FaceGeometry& geometry, const std::vector<int>& a, const std::vector<int>& b) {
    std::map<int, std::map<int, double>> shared;
    for (std::size_t f = 0; f < a.size(); ++f)
        shared[a[f]][b[f]] += geometry.area[static_cast<Eigen::Index>(f)];
    double sum = 0.0;
    for (const auto& [patch, others] : shared) {
        sum += std::max_element(others.begin(), others.end(), [](auto& x, auto& y) {
                   return x.second < y.second;
               })->second;
    }
    return sum / geometry.total_area;
}

TEST(Oversegmentation, FiftyConnectedPatchesOnSimpleShapes) {
    for (const TriMesh& mesh : {test::sphere(3), test::box(1, 2, 3, 20), test::torus(1, 0.3, 48, 20),
                                test::flat_square(30), test::dumbbell(40, 24)}) {
        const Prepared p = prepared(mesh);
        for (const double noise : {0.0, 0.3}) {
            expect_valid(oversegment(p.geometry, p.graph, {.noise = noise}, 7), p.graph, 50);
        }
    }
}

/// A flat grid of unit faces, and on 100 of them a crumb of an area of .01 that hangs by a thread.
Prepared grid_with_crumbs(int cells) {
    Prepared p;
    p.graph.face_count = cells * cells + 100;
    p.geometry.area = Eigen::VectorXd::Ones(p.graph.face_count);
    p.geometry.area.tail(100).setConstant(0.01);
    p.geometry.total_area = p.geometry.area.sum();
    const auto join = [&](int a, int b, double length) {
        const int vertex = 2 * static_cast<int>(p.graph.edges.size());
        p.graph.edges.push_back({a, b, vertex, vertex + 1, length, std::numbers::pi});
    };
    for (int face = 0; face < cells * cells; ++face) {
        if (face % cells + 1 < cells) join(face, face + 1, 1.0);
        if (face + cells < cells * cells) join(face, face + cells, 1.0);
    }
    for (int crumb = 0; crumb < 100; ++crumb) join(7 * crumb, cells * cells + crumb, 1e-5);
    std::sort(p.graph.edges.begin(), p.graph.edges.end(), [](const DualEdge& a, const DualEdge& b) {
        return std::pair(a.face_a, a.face_b) < std::pair(b.face_a, b.face_b);
    });
    index_incidence(p.graph);
    return p;
}

TEST(Oversegmentation, CrumbsAreNoPatchesWhereTheyWouldUseThemUp) {
    const Prepared p = grid_with_crumbs(40);
    const std::vector<int> patch = oversegment(p.geometry, p.graph, {.patches = 20}, 7);
    expect_valid(patch, p.graph, 20);
    std::vector<double> area(20, 0.0);
    for (std::size_t f = 0; f < patch.size(); ++f)
        area[static_cast<std::size_t>(patch[f])] += p.geometry.area[static_cast<Eigen::Index>(f)];
    EXPECT_GT(*std::min_element(area.begin(), area.end()), 0.05 * p.geometry.total_area / 20);
    EXPECT_LT(*std::max_element(area.begin(), area.end()), 8.0 * p.geometry.total_area / 20);
}

TEST(Oversegmentation, AnyNumberOfPatchesIsMetExactly) {
    const Prepared p = prepared(test::sphere(2));  // 320 faces
    for (const int patches : {1, 2, 3, 49, 200, 319, 320}) {
        expect_valid(oversegment(p.geometry, p.graph, {.patches = patches, .super_faces = 10}, 1), p.graph,
                     patches);
    }
}

TEST(Oversegmentation, FewerFacesThanPatchesGiveOneFaceEach) {
    const Prepared p = prepared(test::sphere(0));
    const std::vector<int> patch = oversegment(p.geometry, p.graph, {}, 1);
    for (std::size_t f = 0; f < 20; ++f) EXPECT_EQ(patch[f], static_cast<int>(f));
}

TEST(Oversegmentation, TwoPatchesMeetAtTheWaist) {
    const Prepared p = prepared(test::dumbbell(40, 24));
    for (const int super_faces : {200, 100000}) {
        const std::vector<int> patch =
            oversegment(p.geometry, p.graph, {.patches = 2, .super_faces = super_faces}, 5);
        for (std::size_t f = 0; f < patch.size(); ++f) {
            EXPECT_EQ(patch[f], p.geometry.centroid(2, static_cast<Eigen::Index>(f)) < 0.0 ? 0 : 1) << f;
        }
    }
}

TEST(Oversegmentation, SeedsDifferOnlyWithNoise) {
    const Prepared p = prepared(test::dumbbell(40, 24));
    EXPECT_EQ(oversegment(p.geometry, p.graph, {}, 3), oversegment(p.geometry, p.graph, {}, 3));
    EXPECT_NE(oversegment(p.geometry, p.graph, {}, 3), oversegment(p.geometry, p.graph, {}, 4));
    EXPECT_EQ(oversegment(p.geometry, p.graph, {.noise = 0}, 3),
              oversegment(p.geometry, p.graph, {.noise = 0}, 4));
}

TEST(Oversegmentation, IsFreeOfScale) {
    TriMesh mesh = test::torus(1, 0.3, 30, 12);
    const FaceGeometry small = face_geometry(mesh);
    const std::vector<int> expected = oversegment(small, dual_graph(mesh, small), {}, 2);
    for (const double scale : {0x1p-30, 0x1p+30}) {  // powers of two: the same digits
        TriMesh scaled = mesh;
        scaled.vertices *= scale;
        const FaceGeometry geometry = face_geometry(scaled);
        EXPECT_EQ(oversegment(geometry, dual_graph(scaled, geometry), {}, 2), expected);
    }
}

TEST(Oversegmentation, FollowsTheSurfaceNotTheOrderOfFaces) {
    const Prepared p = prepared(test::dumbbell(40, 24));
    const std::vector<int> patch = oversegment(p.geometry, p.graph, {}, 9);
    std::vector<int> order;
    const Prepared q = prepared(test::shuffled_faces(p.mesh, 4, order));
    const std::vector<int> of_shuffled = oversegment(q.geometry, q.graph, {}, 9);
    std::vector<int> carried(patch.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        carried[static_cast<std::size_t>(order[k])] = of_shuffled[k];
    EXPECT_GT(agreement(p.geometry, patch, carried), 0.95);
}

TEST(Oversegmentation, FacesWithoutAreaAreCoveredToo) {
    TriMesh mesh = test::torus(1, 0.3, 24, 12);
    for (int v = 0; v < 60; v += 4) mesh.vertices.col(v) = mesh.vertices.col(v + 1);  // edges of length 0
    const Prepared p = prepared(mesh);
    expect_valid(oversegment(p.geometry, p.graph, {}, 1), p.graph, 50);
}

TEST(Oversegmentation, VirtualEdgesJoinComponents) {
    Prepared p = prepared(test::disjoint_union(test::sphere(2), test::box(4, 1, 1, 8)));
    expect_valid(oversegment(p.geometry, p.graph, {}, 1), p.graph, 50);
    std::erase_if(p.graph.edges, [](const DualEdge& e) { return e.is_virtual(); });
    DualGraph joined{
        .face_count = p.graph.face_count, .edges = p.graph.edges, .offsets = {0}, .incident = {}};
    joined.edges.push_back(
        {.face_a = 0, .face_b = p.graph.face_count - 1, .length = 0.01, .dihedral = std::numbers::pi});
    for (int f = 0; f < joined.face_count; ++f) {
        for (std::size_t e = 0; e < joined.edges.size(); ++e) {
            if (joined.edges[e].face_a == f || joined.edges[e].face_b == f)
                joined.incident.push_back(static_cast<int>(e));
        }
        joined.offsets.push_back(static_cast<int>(joined.incident.size()));
    }
    expect_valid(oversegment(p.geometry, joined, {.patches = 1}, 1), joined, 1);
    const std::vector<int> two = oversegment(p.geometry, joined, {.patches = 2}, 1);
    // The virtual edge is the cheapest cut.
    for (std::size_t f = 0; f < two.size(); ++f) EXPECT_EQ(two[f], f < 320 ? 0 : 1);
}

TEST(Oversegmentation, RejectsImpossibleOptions) {
    const Prepared p = prepared(test::sphere(1));
    EXPECT_THROW(oversegment(p.geometry, p.graph, {.patches = 0}, 1), Error);
    EXPECT_THROW(oversegment(p.geometry, p.graph, {.noise = -1}, 1), Error);
}

TEST(DihedralCost, FallsFromFlatToConcaveAndStaysOneWhenConvex) {
    const auto cost = [](double theta) { return dihedral_cost({.dihedral = theta}); };
    EXPECT_DOUBLE_EQ(cost(std::numbers::pi), 1.0);
    EXPECT_DOUBLE_EQ(cost(1.5 * std::numbers::pi), 1.0);
    EXPECT_NEAR(cost(0.5 * std::numbers::pi), std::pow(0.5, 10), 1e-12);
    EXPECT_DOUBLE_EQ(cost(0.1), 1e-4);
}

/// Share of the area that is right if every patch takes the true label with the largest area in it.
double majority_bound(const FaceGeometry& geometry, const std::vector<int>& patch,
                      const std::vector<int>& truth) {
    return agreement(geometry, patch, truth);
}

/// The majority bound of the mesh's fifty patches.
double bound_of_fifty_patches(const TriMesh& mesh, const std::string& name, const std::vector<int>& truth) {
    const Prepared p = prepared(mesh);
    const std::vector<int> patch = oversegment(p.geometry, p.graph, {}, hash_text(name));
    expect_valid(patch, p.graph, 50);
    return majority_bound(p.geometry, patch, truth);
}

TEST(Oversegmentation, GeneratedShapesAreFiftyPatchesThatFollowTheTruth) {
    for (const auto& [name, shape] : test::generated_shapes()) {
        const double found = bound_of_fifty_patches(shape.mesh, name, shape.face_label);
        EXPECT_GT(found, 0.97) << name;
        RecordProperty(name, std::to_string(found));
    }
}

TEST(Oversegmentation, RealShapesAreFiftyPatchesThatFollowTheTruth) {
    const std::filesystem::path data = test::data_folder();
    if (data.empty()) GTEST_SKIP() << "no labelled shapes: set COSEG_DATA to their folder";
    const std::map<std::string, double> lowest{
        {"psb_airplane", 0.92}, {"psb_plier", 0.93}, {"coseg_chairs", 0.97}, {"humans_adobe", 0.88}};
    for (const auto& [set, bound] : lowest) {
        const std::filesystem::path off = test::off_files(data / set).front();
        const std::vector<int> truth = test::read_seg(std::filesystem::path(off).replace_extension(".seg"));
        const double found = bound_of_fifty_patches(test::read_off(off), off.stem().string(), truth);
        EXPECT_GT(found, bound) << off;
        RecordProperty(set, std::to_string(found));
    }
}

}  // namespace
}  // namespace coseg
