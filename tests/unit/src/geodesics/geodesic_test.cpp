#include "src/geodesics/geodesic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/geodesics/shortest_paths.hpp"
#include "src/geodesics/surface_graph.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

/// A rhombus of n x n cells of equilateral triangles with side 1 / n, in the plane z = 0.
TriMesh equilateral_plane(int n) {
    TriMesh mesh = test::flat_square(n);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d p = mesh.vertices.col(v);
        // The diagonal of each cell runs along (1, 1), so the axes must stand at 120 degrees.
        mesh.vertices.col(v) = Eigen::Vector3d(p.x() - 0.5 * p.y(), std::sqrt(0.75) * p.y(), 0.0);
    }
    return mesh;
}

/// The dual graph with one virtual edge of ours in place of whatever joins the components.
DualGraph joined_at(const TriMesh& mesh, int face_a, int face_b) {
    DualGraph graph = dual_graph(mesh, face_geometry(mesh));
    std::erase_if(graph.edges, [](const DualEdge& e) { return e.is_virtual(); });
    DualEdge bridge{.face_a = face_a, .face_b = face_b};
    bridge.dihedral = std::numbers::pi;
    graph.edges.push_back(bridge);
    return graph;
}

/// Distance of every vertex from one vertex.
Eigen::VectorXf distances_from(const TriMesh& mesh, const DualGraph& graph, int vertex) {
    const SurfaceGraph surface = surface_graph(mesh, graph);
    std::vector<float> distance(static_cast<std::size_t>(surface.node_count()),
                                std::numeric_limits<float>::infinity());
    const std::array<PathSource, 1> source{{{vertex, 0.0F}}};
    lower_distances(surface, source, distance);
    return Eigen::Map<const Eigen::VectorXf>(distance.data(), mesh.vertex_count());
}

Eigen::VectorXf distances_from(const TriMesh& mesh, int vertex) {
    return distances_from(mesh, dual_graph(mesh, face_geometry(mesh)), vertex);
}

GeodesicTable table_of(const TriMesh& mesh, int samples) {
    const FaceGeometry geometry = face_geometry(mesh);
    return geodesic_table(mesh, geometry, dual_graph(mesh, geometry), samples, 1);
}

TEST(Geodesic, EquilateralPlaneIsWithinTwelveDirectionsOfEuclid) {
    const TriMesh mesh = equilateral_plane(24);
    for (const int source : {0, 12 * 25 + 12, 7}) {
        const Eigen::VectorXf distance = distances_from(mesh, source);
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const double truth = (mesh.vertices.col(v) - mesh.vertices.col(source)).norm();
            EXPECT_GE(distance[v], truth * (1 - 1e-5));
            EXPECT_LE(distance[v], truth / std::cos(std::numbers::pi / 12) * (1 + 1e-5));
        }
    }
}

TEST(Geodesic, RightTriangleGridIsNearEuclid) {
    const TriMesh mesh = test::flat_square(30);
    const int source = 15 * 31 + 15;
    const Eigen::VectorXf distance = distances_from(mesh, source);
    double excess = 0.0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double truth = (mesh.vertices.col(v) - mesh.vertices.col(source)).norm();
        EXPECT_GE(distance[v], truth * (1 - 1e-5));
        EXPECT_LE(distance[v], truth / std::cos(std::numbers::pi / 8) * (1 + 1e-5));
        excess += (distance[v] - truth) / std::max(truth, 1e-3) / mesh.vertex_count();
    }
    EXPECT_LT(excess, 0.04);
}

TEST(Geodesic, SphereIsNearGreatCircles) {
    const TriMesh mesh = test::sphere(4);
    const Eigen::VectorXf distance = distances_from(mesh, 100);
    double excess = 0.0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double cosine = mesh.vertices.col(v).dot(mesh.vertices.col(100));
        const double truth = std::acos(std::clamp(cosine, -1.0, 1.0));
        EXPECT_GE(distance[v], truth * 0.995);
        EXPECT_LE(distance[v], truth * 1.06 + 1e-6);
        excess += (distance[v] - truth) / std::max(truth, 1e-2) / mesh.vertex_count();
    }
    EXPECT_LT(excess, 0.03);
}

TEST(Geodesic, UnfoldsAcrossABentEdgeOnly) {
    // Two right triangles hinged along the diagonal of the unit square, folded by 90 degrees; the far corners
    // stay 2 * sqrt(1/2) apart on the surface.
    TriMesh mesh;
    const double h = std::sqrt(0.5);
    mesh.vertices.resize(3, 4);
    mesh.vertices << 0, std::sqrt(2.0), h, h, 0, 0, h, 0, 0, 0, 0, h;
    mesh.faces.resize(3, 2);
    mesh.faces << 0, 1, 1, 0, 2, 3;
    const Eigen::VectorXf distance = distances_from(mesh, 2);
    EXPECT_NEAR(distance[3], 2 * h, 1e-6);
    EXPECT_NEAR(distance[0], 1.0, 1e-6);
    // Apexes beyond the end of the edge: the unfolded line misses it and no shortcut may be taken.
    mesh.vertices << 0, 1, 3, 3, 0, 0, 1, 0, 0, 0, 0, 1;
    EXPECT_NEAR(distances_from(mesh, 2)[3], 2 * std::sqrt(5.0), 1e-5);
}

TEST(Geodesic, IsSymmetricAndKeepsTheTriangleInequality) {
    const TriMesh mesh = test::torus(1, 0.4, 30, 16);
    const std::vector<int> vertices{0, 17, 101, 260, 333, 479};
    std::vector<Eigen::VectorXf> from;
    for (const int v : vertices) from.push_back(distances_from(mesh, v));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        EXPECT_EQ(from[i][vertices[i]], 0.0F);
        for (std::size_t j = 0; j < vertices.size(); ++j) {
            EXPECT_NEAR(from[i][vertices[j]], from[j][vertices[i]], 1e-5);
            for (int v = 0; v < mesh.vertex_count(); ++v) {
                EXPECT_LE(from[i][v], from[i][vertices[j]] + from[j][v] + 1e-5F);
            }
        }
    }
}

TEST(Geodesic, VirtualEdgesCarryDistancesFromCentroidToCentroid) {
    TriMesh far = test::sphere(2);
    far.vertices.row(0).array() += 5.0;
    const TriMesh near = test::sphere(2);
    const TriMesh mesh = test::disjoint_union(near, far);
    const int a = 3;
    const int b = near.face_count() + 20;
    const DualGraph graph = joined_at(mesh, a, b);
    const FaceGeometry geometry = face_geometry(mesh);
    const Eigen::VectorXf distance = distances_from(mesh, graph, 40);
    const Eigen::VectorXf beyond = distances_from(mesh, graph, near.vertex_count() + 50);
    const auto to_centroid = [&](const Eigen::VectorXf& d, int face) {
        double best = std::numeric_limits<double>::infinity();
        for (const int v : mesh.faces.col(face)) {
            best = std::min(best, d[v] + (mesh.vertices.col(v) - geometry.centroid.col(face)).norm());
        }
        return best;
    };
    const double bridge = (geometry.centroid.col(a) - geometry.centroid.col(b)).norm();
    EXPECT_NEAR(distance[near.vertex_count() + 50],
                to_centroid(distance, a) + bridge + to_centroid(beyond, b), 1e-4);
    const GeodesicTable table = geodesic_table(mesh, geometry, graph, 40, 1);
    EXPECT_TRUE(table.distance.allFinite());
    EXPECT_GT(table.distance.maxCoeff(), bridge);
}

TEST(Geodesic, ComponentsThatNothingJoinsAreRefused) {
    const TriMesh mesh = test::disjoint_union(test::sphere(1), test::sphere(1));
    const FaceGeometry geometry = face_geometry(mesh);
    DualGraph graph = dual_graph(mesh, geometry);
    std::erase_if(graph.edges, [](const DualEdge& e) { return e.is_virtual(); });
    EXPECT_THROW((void)geodesic_table(mesh, geometry, graph, 5, 1), Error);
}

/// Fails unless every row of the table has the bits of one search on its own.
void expect_rows_of_single_searches(const TriMesh& mesh, int samples) {
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph dual = dual_graph(mesh, geometry);
    const GeodesicTable table = geodesic_table(mesh, geometry, dual, samples, 1);
    const SurfaceGraph graph = surface_graph(mesh, dual);
    for (int k = 0; k < samples; ++k) {
        const int face = table.sample_face[std::size_t(k)];
        std::vector<PathSource> sources;
        for (const int v : mesh.faces.col(face)) {
            sources.push_back({v, float((mesh.vertices.col(v) - geometry.centroid.col(face)).norm())});
        }
        std::vector<float> distance(std::size_t(graph.node_count()), std::numeric_limits<float>::infinity());
        lower_distances(graph, sources, distance);
        for (int f = 0; f < mesh.face_count(); ++f) {
            const auto at = [&](int corner) { return distance[std::size_t(mesh.faces(corner, f))]; };
            const float mean = f == face ? 0.0F : (at(0) + at(1) + at(2)) * (1.0F / 3.0F);
            ASSERT_EQ(table.distance(k, f), mean) << k << " " << f;
        }
    }
}

TEST(GeodesicTable, LanesHaveTheBitsOfSingleSearches) {
    TriMesh mesh = test::torus(1, 0.4, 40, 20);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) {
            mesh.vertices(k, v) += 0.02 * normal_of(hash_words({5, std::uint64_t(v), std::uint64_t(k)}));
        }
    }
    expect_rows_of_single_searches(mesh, 37);
    expect_rows_of_single_searches(test::box(10, 0.3, 0.1, 60), 20);
}

TEST(GeodesicTable, PathsThatWindAgainstTheOrderHaveTheBitsOfSingleSearches) {
    constexpr int nodes = 4000;
    SurfaceGraph chain{.vertex_count = nodes, .offsets = {0}, .arcs = {}};
    for (int v = 0; v < nodes; ++v) {
        if (v > 0) chain.arcs.push_back({v - 1, 1.0F / static_cast<float>(v)});
        if (v + 1 < nodes) chain.arcs.push_back({v + 1, 1.0F / static_cast<float>(v + 1)});
        chain.offsets.push_back(static_cast<int>(chain.arcs.size()));
    }
    std::vector<int> order(nodes);  // strides through the chain: a pass gets few nodes further
    for (int v = 0; v < nodes; ++v) order[static_cast<std::size_t>(v)] = (v * 1597) % nodes;
    std::array<std::vector<PathSource>, path_lanes> sources;
    for (int lane = 0; lane + 1 < path_lanes; ++lane)
        sources[static_cast<std::size_t>(lane)] = {{lane * 200, 0.25F}, {nodes - 1, 9.0F}};
    std::vector<PathLanes> distance;
    path_distances(chain, sources, order, distance);
    for (int lane = 0; lane < path_lanes; ++lane) {
        std::vector<float> single(nodes, std::numeric_limits<float>::infinity());
        lower_distances(chain, sources[static_cast<std::size_t>(lane)], single);
        for (int v = 0; v < nodes; ++v)
            ASSERT_EQ(distance[static_cast<std::size_t>(v)][lane], single[static_cast<std::size_t>(v)]);
    }
}

TEST(GeodesicTable, MeasuredMeshHasTheBitsOfSingleSearches) {
    const std::filesystem::path path = test::data_folder() / "psb_airplane" / "61.off";
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "set COSEG_DATA to the folder that holds psb_airplane";
    TriMesh mesh = test::read_off(path);
    scale_to_unit_area(mesh);
    expect_rows_of_single_searches(mesh, 40);
}

TEST(GeodesicTable, SamplesAreFarApartAndCoverTheSurface) {
    const TriMesh mesh = test::box(1, 2, 3, 24);
    const GeodesicTable table = table_of(mesh, 60);
    ASSERT_EQ(table.sample_face.size(), 60U);
    EXPECT_EQ(std::set<int>(table.sample_face.begin(), table.sample_face.end()).size(), 60U);
    const float covering = table.distance.colwise().minCoeff().maxCoeff();
    float closest = std::numeric_limits<float>::infinity();
    for (Eigen::Index k = 0; k < 60; ++k) {
        for (Eigen::Index l = 0; l < 60; ++l) {
            if (k != l) closest = std::min(closest, table.distance(k, table.sample_face[std::size_t(l)]));
        }
    }
    const float face_size = 3.0F / 24.0F;
    EXPECT_GE(closest, covering - face_size);
}

TEST(GeodesicTable, WeightsAreTheAreaNearestToEachSample) {
    const TriMesh mesh = test::box(1, 2, 3, 12);
    const FaceGeometry geometry = face_geometry(mesh);
    const GeodesicTable table = table_of(mesh, 25);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(25);
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
        Eigen::Index nearest = 0;
        table.distance.col(f).minCoeff(&nearest);
        expected[nearest] += geometry.area[f] / geometry.total_area;
    }
    EXPECT_NEAR(table.sample_weight.sum(), 1.0, 1e-12);
    EXPECT_LT((table.sample_weight - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GT(table.sample_weight.minCoeff(), 0.0);
}

TEST(GeodesicTable, ScalesWithTheMesh) {
    TriMesh mesh = test::torus(1, 0.4, 24, 12);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.vertices(2, v) += 0.3 * mesh.vertices(0, v) * mesh.vertices(1, v);
    TriMesh large = mesh;
    large.vertices *= 1024.0;
    const GeodesicTable table = table_of(mesh, 30);
    const GeodesicTable large_table = table_of(large, 30);
    EXPECT_EQ(table.sample_face, large_table.sample_face);
    EXPECT_EQ(Eigen::MatrixXf(table.distance * 1024.0F), large_table.distance);
}

TEST(GeodesicTable, MoreSamplesThanFacesTakesEveryFaceOnce) {
    const GeodesicTable table = table_of(test::sphere(0), 300);
    EXPECT_EQ(std::set<int>(table.sample_face.begin(), table.sample_face.end()).size(), 20U);
    EXPECT_LT((table.sample_weight.array() - 0.05).abs().maxCoeff(), 1e-12);
}

TEST(GeodesicTable, SingleTriangle) {
    TriMesh mesh;
    mesh.vertices.resize(3, 3);
    mesh.vertices << 0, 1, 0, 0, 0, 1, 0, 0, 0;
    mesh.faces.resize(3, 1);
    mesh.faces << 0, 1, 2;
    const GeodesicTable table = table_of(mesh, 300);
    EXPECT_EQ(table.sample_face, std::vector<int>{0});
    EXPECT_EQ(table.distance(0, 0), 0.0F);
    EXPECT_EQ(table.sample_weight[0], 1.0);
    EXPECT_THROW((void)table_of(mesh, 0), Error);
}

TEST(GeodesicTable, FacesWithoutAreaAndCoincidentVerticesStayFinite) {
    TriMesh mesh = test::flat_square(6);
    mesh.vertices.col(10) = mesh.vertices.col(11);
    mesh.vertices.col(30) = 0.5 * (mesh.vertices.col(29) + mesh.vertices.col(31));
    mesh.vertices.col(25) = mesh.vertices.col(24);
    const GeodesicTable table = table_of(mesh, 20);
    EXPECT_TRUE(table.distance.allFinite());
    EXPECT_GE(table.distance.minCoeff(), 0.0F);
    EXPECT_NEAR(table.sample_weight.sum(), 1.0, 1e-12);
    mesh.vertices.setZero();
    const GeodesicTable point = table_of(mesh, 20);
    EXPECT_EQ(point.distance.cwiseAbs().maxCoeff(), 0.0F);
    EXPECT_NEAR(point.sample_weight.sum(), 1.0, 1e-12);
}

}  // namespace
}  // namespace coseg
