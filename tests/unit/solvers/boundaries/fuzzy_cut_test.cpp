#include "solvers/boundaries/fuzzy_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/connected_pieces.hpp"
#include "src/mesh/face_geometry.hpp"
#include "tests/support/generated_shapes.hpp"
#include "tests/support/read_off.hpp"
#include "tests/support/revolution.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

struct CutInput {
    FaceGeometry geometry;
    DualGraph graph;
};

CutInput cut_input(const TriMesh& mesh) {
    FaceGeometry geometry = face_geometry(mesh);
    DualGraph graph = dual_graph(mesh, geometry);
    return {std::move(geometry), std::move(graph)};
}

std::vector<int> below(const FaceGeometry& geometry, double z) {
    std::vector<int> label;
    for (Eigen::Index f = 0; f < geometry.area.size(); ++f)
        label.push_back(geometry.centroid(2, f) < z ? 0 : 1);
    return label;
}

/// Steps over dual edges to the nearest face of another label, 1 beside it.
std::vector<int> triangles_to_boundary(const DualGraph& graph, const std::vector<int>& label) {
    std::vector<int> distance(label.size(), 1 << 20);
    for (const DualEdge& e : graph.edges) {
        const auto a = static_cast<std::size_t>(e.face_a), b = static_cast<std::size_t>(e.face_b);
        if (label[a] != label[b]) distance[a] = distance[b] = 1;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const DualEdge& e : graph.edges) {
            const auto a = static_cast<std::size_t>(e.face_a), b = static_cast<std::size_t>(e.face_b);
            if (std::abs(distance[a] - distance[b]) <= 1) continue;
            (distance[a] > distance[b] ? distance[a] : distance[b]) = std::min(distance[a], distance[b]) + 1;
            changed = true;
        }
    }
    return distance;
}

TEST(FuzzyCut, AMisplacedBoundaryMovesToTheWaist) {
    const CutInput p = cut_input(test::dumbbell(40, 24));  // rings 0.075 apart, two triangles each
    const std::vector<int> waist = below(p.geometry, 0.0);
    for (const double z : {-0.3, -0.15, 0.0, 0.15, 0.3}) {
        EXPECT_EQ(fuzzy_cut(p.graph, below(p.geometry, z), {.strip_width = 10}), waist) << z;
    }
}

TEST(FuzzyCut, ABoundaryFartherThanTheStripStaysAwayFromTheWaist) {
    const CutInput p = cut_input(test::dumbbell(40, 24));
    const std::vector<int> start = below(p.geometry, 0.6);
    const std::vector<int> cut = fuzzy_cut(p.graph, start, {.strip_width = 4});
    const std::vector<int> distance = triangles_to_boundary(p.graph, start);
    for (std::size_t f = 0; f < cut.size(); ++f) {
        if (distance[f] > 4) {
            EXPECT_EQ(cut[f], start[f]) << f;
        }
    }
    EXPECT_NE(cut, below(p.geometry, 0.0));
}

TEST(FuzzyCut, NoStripChangesNothing) {
    const CutInput p = cut_input(test::dumbbell(20, 12));
    const std::vector<int> start = below(p.geometry, 0.3);
    EXPECT_EQ(fuzzy_cut(p.graph, start, {.strip_width = 0}), start);
    EXPECT_EQ(fuzzy_cut(p.graph, std::vector<int>(start.size(), 3)), std::vector<int>(start.size(), 3));
}

TEST(FuzzyCut, CapacityNeverRisesAndNoRegionVanishes) {
    const CutInput p = cut_input(test::torus(1, 0.4, 40, 20));
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        // Voronoi-like labels of random sites: ragged regions of all sizes.
        SeededStream random(seed);
        std::vector<int> sites;
        for (int k = 0; k < 12; ++k)
            sites.push_back(static_cast<int>(random() % static_cast<std::uint64_t>(p.graph.face_count)));
        std::vector<int> label;
        for (int f = 0; f < p.graph.face_count; ++f) {
            const auto nearer = [&](int s, int t) {
                return (p.geometry.centroid.col(f) - p.geometry.centroid.col(s)).norm() <
                       (p.geometry.centroid.col(f) - p.geometry.centroid.col(t)).norm();
            };
            label.push_back(
                static_cast<int>(std::min_element(sites.begin(), sites.end(), nearer) - sites.begin()) % 5);
        }
        for (const int width : {1, 3, 10, 1000}) {
            const FuzzyCutOptions options{.strip_width = width};
            const std::vector<int> cut = fuzzy_cut(p.graph, label, options);
            const std::vector<double> capacity = fuzzy_cut_capacities(p.graph, options);
            EXPECT_LE(boundary_capacity(p.graph, capacity, cut), boundary_capacity(p.graph, capacity, label));
            EXPECT_EQ(std::set<int>(cut.begin(), cut.end()), std::set<int>(label.begin(), label.end()));
            const std::vector<int> region = connected_pieces(p.graph, label);
            std::vector<char> survives(
                static_cast<std::size_t>(*std::max_element(region.begin(), region.end())) + 1, 0);
            for (std::size_t f = 0; f < cut.size(); ++f) {
                if (cut[f] == label[f]) survives[static_cast<std::size_t>(region[f])] = 1;
            }
            EXPECT_EQ(std::count(survives.begin(), survives.end(), 0), 0);
        }
    }
}

TEST(FuzzyCut, CapacitiesFollowTheFormula) {
    DualGraph graph{.face_count = 4, .edges = {}, .offsets = {}, .incident = {}};
    const double pi = std::numbers::pi;
    for (const double dihedral : {pi, 0.5 * pi, 1.5 * pi}) {
        graph.edges.push_back({.face_a = 0,
                               .face_b = 1,
                               .vertex_a = 0,
                               .vertex_b = 1,
                               .length = dihedral / pi,
                               .dihedral = dihedral});
    }
    graph.edges.push_back({.face_a = 2, .face_b = 3, .length = 7.0, .dihedral = pi});
    const std::vector<double> capacity = fuzzy_cut_capacities(graph, {.convex_weight = 0.2});
    const double mean = (0.0 + 1.0 + 0.2) / 3.0;  // 1 - cos of 0, 90 (concave) and 90 degrees (convex)
    EXPECT_NEAR(capacity[0], 1.0, 1e-12);         // lengths 1, .5, 1.5: mean 1
    EXPECT_NEAR(capacity[1], 0.5 / (1.0 + 1.0 / mean), 1e-12);
    EXPECT_NEAR(capacity[2], 1.5 / (1.0 + 0.2 / mean), 1e-12);
    EXPECT_EQ(capacity[3], 0.0);
}

TEST(FuzzyCut, FlatMeshesHaveTheirLengthsAsCapacities) {
    const CutInput p = cut_input(test::flat_square(4));
    const std::vector<double> capacity = fuzzy_cut_capacities(p.graph, {});
    for (std::size_t e = 0; e < capacity.size(); ++e) {
        EXPECT_NEAR(capacity[e] / capacity[0], p.graph.edges[e].length / p.graph.edges[0].length, 1e-9);
    }
}

TEST(FuzzyCut, RejectsImpossibleOptions) {
    const CutInput p = cut_input(test::sphere(0));
    EXPECT_THROW(fuzzy_cut(p.graph, std::vector<int>(20, 0), {.strip_width = -1}), Error);
    EXPECT_THROW(fuzzy_cut(p.graph, std::vector<int>(20, 0), {.convex_weight = 0.0}), Error);
}

/// The fuzzy cut of true labels keeps 97 % of the area, and its boundaries cost less than the true ones.
void expect_truth_barely_moves(const TriMesh& mesh, const std::vector<int>& truth) {
    const CutInput p = cut_input(mesh);
    const std::vector<int> cut = fuzzy_cut(p.graph, truth);
    double same = 0.0;
    for (std::size_t f = 0; f < cut.size(); ++f)
        same += cut[f] == truth[f] ? p.geometry.area[static_cast<Eigen::Index>(f)] : 0.0;
    EXPECT_GT(same / p.geometry.total_area, 0.97);
    const std::vector<double> capacity = fuzzy_cut_capacities(p.graph, {});
    EXPECT_LT(boundary_capacity(p.graph, capacity, cut), boundary_capacity(p.graph, capacity, truth));
}

TEST(FuzzyCut, TruthOfAGeneratedShapeBarelyMoves) {
    for (const auto& [name, shape] : test::generated_shapes()) {
        SCOPED_TRACE(name);
        expect_truth_barely_moves(shape.mesh, shape.face_label);
    }
}

TEST(FuzzyCut, TruthOfARealShapeBarelyMoves) {
    const std::filesystem::path data = test::data_folder();
    if (data.empty()) GTEST_SKIP() << "no labelled shapes: set COSEG_DATA to their folder";
    const std::filesystem::path off = test::off_files(data / "psb_plier").front();
    const std::vector<int> truth = test::read_seg(std::filesystem::path(off).replace_extension(".seg"));
    expect_truth_barely_moves(test::read_off(off), truth);
}

TEST(FuzzyCut, HeldBoundariesGoNoFartherThanTheirReach) {
    const CutInput p = cut_input(test::dumbbell(40, 24));
    const std::vector<int> waist = below(p.geometry, 0.0);
    const std::vector<int> start = below(p.geometry, 0.16);
    ASSERT_NE(start, waist);
    ASSERT_EQ(fuzzy_cut(p.graph, start), waist);
    const Eigen::MatrixXd loose = holding_costs(p.graph, p.geometry, start, 2, 10.0);
    const Eigen::MatrixXd tight = holding_costs(p.graph, p.geometry, start, 2, 0.01);
    EXPECT_EQ(fuzzy_cut(p.graph, start, {}, loose), waist);
    EXPECT_EQ(fuzzy_cut(p.graph, start, {}, tight), start);
}

TEST(FuzzyCut, HoldingAStripCostsItsLengthTimesTheSquareOfItsShareOfTheReach) {
    const CutInput p = cut_input(test::flat_square(40));
    std::vector<int> left;
    for (Eigen::Index f = 0; f < p.geometry.area.size(); ++f)
        left.push_back(p.geometry.centroid(0, f) < 0.5 ? 0 : 1);
    const double reach = 0.2;
    const Eigen::MatrixXd cost = holding_costs(p.graph, p.geometry, left, 2, reach);
    double length = 0.0;
    for (const DualEdge& e : p.graph.edges) length += e.length / static_cast<double>(p.graph.edges.size());
    double strip = 0.0;  // the faces up to 0.1 to the right of the boundary, which is 1 long
    for (Eigen::Index f = 0; f < p.geometry.area.size(); ++f) {
        const double x = p.geometry.centroid(0, f) - 0.5;
        if (x > 0.0 && x < 0.1) strip += cost(0, f) * length;
    }
    // Distances over the triangles' centroids are up to a third longer than straight ones.
    EXPECT_GT(strip, 0.25);
    EXPECT_LT(strip, 0.25 * 1.5);
}

TEST(FuzzyCut, HeldCutsNeverRaiseTheSumOfCapacityAndHolding) {
    const CutInput p = cut_input(test::dumbbell(30, 18));
    const std::vector<double> capacity = fuzzy_cut_capacities(p.graph, {});
    for (unsigned seed = 0; seed < 5; ++seed) {
        std::vector<int> label(p.graph.offsets.size() - 1);
        for (std::size_t f = 0; f < label.size(); ++f)
            label[f] =
                (p.geometry.centroid(2, static_cast<Eigen::Index>(f)) < 0.3 * normal_of(seed) ? 0 : 1) +
                (p.geometry.centroid(0, static_cast<Eigen::Index>(f)) < 0.0 ? 0 : 2);
        const Eigen::MatrixXd holding = holding_costs(p.graph, p.geometry, label, 4, 0.15);
        const std::vector<int> cut = fuzzy_cut(p.graph, label, {}, holding);
        double left = 0.0;
        for (std::size_t f = 0; f < label.size(); ++f) left += holding(cut[f], static_cast<Eigen::Index>(f));
        EXPECT_LE(boundary_capacity(p.graph, capacity, cut) + left,
                  boundary_capacity(p.graph, capacity, label) + 1e-9);
    }
}

TEST(FuzzyCut, ScoresMoveABoundaryToWhereTheyChange) {
    const CutInput p = cut_input(test::flat_square(40));
    const auto left_of = [&](double x) {
        std::vector<int> label;
        for (Eigen::Index f = 0; f < p.geometry.area.size(); ++f)
            label.push_back(p.geometry.centroid(0, f) < x ? 0 : 1);
        return label;
    };
    const std::vector<int> wanted = left_of(0.6);
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(2, p.geometry.area.size());
    for (Eigen::Index f = 0; f < scores.cols(); ++f) scores(wanted[static_cast<std::size_t>(f)], f) = 1.0;
    const std::vector<int> start = left_of(0.5);
    const FuzzyCutOptions wide{.strip_width = 60};
    const auto moved = [&](double reach, double weight) {
        return fuzzy_cut(p.graph, start, wide,
                         holding_costs(p.graph, p.geometry, start, 2, reach) +
                             weight * score_costs(p.graph, p.geometry, scores));
    };
    EXPECT_EQ(moved(0.2, 50.0), wanted);  // a gain of 50 against a hold of at most 2 x .1 / .2^2 = 5
    EXPECT_EQ(moved(0.2, 0.0), start);
    EXPECT_EQ(moved(0.01, 50.0), start);  // past .0025 the hold of 2 d / .01^2 is more than 50
    // The costs of all faces make the share of the area that has its score, times sqrt(area) over mean
    // length.
    double length = 0.0;
    for (const DualEdge& e : p.graph.edges) length += e.length / static_cast<double>(p.graph.edges.size());
    const Eigen::MatrixXd costs = score_costs(p.graph, p.geometry, scores);
    EXPECT_NEAR(costs.row(0).sum(), -0.6 / length, 0.02 / length);
}

TEST(FuzzyCut, RefusesCostsThatDoNotFit) {
    const CutInput p = cut_input(test::sphere(0));
    const std::vector<int> label(20, 0);
    EXPECT_THROW(fuzzy_cut(p.graph, label, {}, Eigen::MatrixXd::Zero(1, 3)), Error);
    EXPECT_THROW(holding_costs(p.graph, p.geometry, label, 1, 0.0), Error);
}

}  // namespace
}  // namespace coseg
