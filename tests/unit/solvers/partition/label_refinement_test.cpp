#include "solvers/partition/label_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/mesh/connected_pieces.hpp"
#include "src/mesh/face_geometry.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

struct Problem {
    Eigen::MatrixXd cost;
    std::vector<WeightedEdge> contacts;
    std::vector<int> start;
};

Problem random_problem(int labels, int pieces, std::uint64_t seed) {
    SeededStream random(seed);
    Problem problem{.cost = Eigen::MatrixXd(labels, pieces), .contacts = {}, .start = {}};
    for (int p = 0; p < pieces; ++p) {
        for (int l = 0; l < labels; ++l) problem.cost(l, p) = random.uniform();
        problem.start.push_back(static_cast<int>(random() % static_cast<std::uint64_t>(labels)));
        for (int q = 0; q < p; ++q) {
            if (random.uniform() < 0.4) problem.contacts.push_back({q, p, random.uniform()});
        }
    }
    return problem;
}

/// No area: the guard against withering labels never acts.
Eigen::VectorXd no_area(const Problem& problem) { return Eigen::VectorXd::Zero(problem.cost.cols()); }

double least_energy(const Problem& problem, double smoothness) {
    const auto labels = static_cast<int>(problem.cost.rows());
    std::vector<int> trial(problem.start.size(), 0);
    double least = std::numeric_limits<double>::infinity();
    while (true) {
        least = std::min(least, label_energy(problem.cost, problem.contacts, smoothness, trial));
        std::size_t digit = 0;
        while (digit < trial.size() && ++trial[digit] == labels) trial[digit++] = 0;
        if (digit == trial.size()) return least;
    }
}

TEST(LabelRefinement, TwoLabelsReachTheLeastEnergy) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Problem problem = random_problem(2, 8, seed);
        const auto labels =
            refine_labels(problem.cost, problem.contacts, 0.3, no_area(problem), problem.start);
        EXPECT_NEAR(label_energy(problem.cost, problem.contacts, 0.3, labels), least_energy(problem, 0.3),
                    1e-9);
    }
}

TEST(LabelRefinement, ManyLabelsNeverRiseAndStayWithinTwiceTheLeast) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Problem problem = random_problem(4, 6, seed);
        for (const double smoothness : {0.05, 0.5, 5.0}) {
            const auto labels =
                refine_labels(problem.cost, problem.contacts, smoothness, no_area(problem), problem.start);
            const double energy = label_energy(problem.cost, problem.contacts, smoothness, labels);
            EXPECT_LE(energy,
                      label_energy(problem.cost, problem.contacts, smoothness, problem.start) + 1e-12);
            EXPECT_LE(energy, 2.0 * least_energy(problem, smoothness));
            EXPECT_EQ(refine_labels(problem.cost, problem.contacts, smoothness, no_area(problem), labels),
                      labels);
        }
    }
}

TEST(LabelRefinement, WithoutSmoothnessEveryPieceTakesItsCheapestLabel) {
    const Problem problem = random_problem(5, 40, 1);
    const auto labels = refine_labels(problem.cost, problem.contacts, 0.0, no_area(problem), problem.start);
    for (std::size_t p = 0; p < labels.size(); ++p) {
        Eigen::Index cheapest = 0;
        problem.cost.col(static_cast<Eigen::Index>(p)).minCoeff(&cheapest);
        EXPECT_EQ(labels[p], cheapest);
    }
}

TEST(LabelRefinement, ALoneWrongPieceFollowsItsNeighbours) {
    Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(2, 5);
    cost.row(1).setConstant(1.0);
    cost(0, 2) = 0.4;  // piece 2 would rather be 1, but not for two boundaries of .3
    cost(1, 2) = 0.0;
    const std::vector<WeightedEdge> row{{0, 1, 1}, {1, 2, 1}, {2, 3, 1}, {3, 4, 1}};
    EXPECT_EQ(refine_labels(cost, row, 0.3, Eigen::VectorXd::Zero(5), {0, 0, 1, 0, 0}),
              (std::vector<int>{0, 0, 0, 0, 0}));
    EXPECT_EQ(refine_labels(cost, row, 0.1, Eigen::VectorXd::Zero(5), {0, 0, 1, 0, 0}),
              (std::vector<int>{0, 0, 1, 0, 0}));
}

TEST(LabelRefinement, WitheredLabelsGetTheirPiecesBack) {
    Eigen::MatrixXd cost(2, 4);
    cost << 0, 0, 0, 0, 1, 1, 1, 0.5;  // label 0 is cheaper everywhere
    Eigen::VectorXd area(4);
    area << 1, 1, 1, 1;
    EXPECT_EQ(refine_labels(cost, {}, 1.0, area, {0, 0, 1, 1}), (std::vector<int>{0, 0, 1, 1}));
    cost(1, 3) = -1.0;  // now label 1 keeps half its area by itself
    EXPECT_EQ(refine_labels(cost, {}, 1.0, area, {0, 0, 1, 1}), (std::vector<int>{0, 0, 0, 1}));
}

TEST(LabelRefinement, RestoringOneLabelMayRequireAnother) {
    // Label 2 takes everything of 1, label 1 everything of 0: giving 0 back its pieces leaves 1 with nothing.
    Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(3, 2, 5.0);
    cost(1, 0) = 0.0;
    cost(2, 1) = 0.0;
    EXPECT_EQ(refine_labels(cost, {}, 1.0, Eigen::VectorXd::Ones(2), {0, 1}), (std::vector<int>{0, 1}));
}

TEST(LabelRefinement, ContactsAddLengthTimesDihedralCost) {
    const TriMesh mesh = test::flat_square(6);
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph graph = dual_graph(mesh, geometry);
    std::vector<int> thirds;
    for (int f = 0; f < mesh.face_count(); ++f)
        thirds.push_back(static_cast<int>(geometry.centroid(0, f) * 3.0));
    const auto contacts = piece_contacts(graph, thirds);
    ASSERT_EQ(contacts.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(contacts[k].node_a, static_cast<int>(k));
        EXPECT_EQ(contacts[k].node_b, static_cast<int>(k) + 1);
        EXPECT_NEAR(contacts[k].weight, 1.0, 1e-12);  // flat: cost 1 on a boundary of length 1
    }
}

TEST(LabelRefinement, RejectsWhatDoesNotFit) {
    const Problem problem = random_problem(2, 4, 1);
    const Eigen::VectorXd area = no_area(problem);
    EXPECT_THROW(refine_labels(problem.cost, {}, 1.0, area, {0, 1, 0}), Error);
    EXPECT_THROW(refine_labels(problem.cost, {}, 1.0, area, {0, 1, 0, 2}), Error);
    EXPECT_THROW(refine_labels(problem.cost, {}, -1.0, area, {0, 1, 0, 1}), Error);
    EXPECT_THROW(refine_labels(problem.cost, {{0, 4, 1.0}}, 1.0, area, {0, 1, 0, 1}), Error);
    Eigen::MatrixXd infinite = problem.cost;
    infinite(0, 0) = std::numeric_limits<double>::infinity();
    EXPECT_THROW(refine_labels(infinite, {}, 1.0, area, {0, 1, 0, 1}), Error);
}

}  // namespace
}  // namespace coseg
