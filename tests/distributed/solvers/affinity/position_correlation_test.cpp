#include "solvers/affinity/position_correlation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "src/base/seeded_random.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::Edge;
using testing_graphs::graph;
using testing_graphs::owned_rows;

/// Of mean 0 and spread 1, nearly normal: the sum of twelve uniform numbers.
double normal_of(std::uint64_t seed, std::uint64_t k) {
    double sum = -6.0;
    for (std::uint64_t n = 0; n < 12; ++n) sum += uniform_of(hash_words({seed, k, n}));
    return sum;
}

/// Two meshes of `pairs` patches; patch i of one is linked to patch i of the other.
struct LinkedPairs {
    SparseRows links;
    std::vector<int> mesh_of;
    Eigen::Matrix3Xd positions;
};

/// Places that agree along `direction` with correlation r, and not at all across it.
LinkedPairs linked_pairs(int pairs, const Eigen::Vector3d& direction, double r) {
    std::vector<Edge> edges;
    LinkedPairs made;
    made.mesh_of.assign(static_cast<std::size_t>(2 * pairs), 0);
    made.positions.resize(3, 2 * pairs);
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction);
    for (int i = 0; i < pairs; ++i) {
        edges.push_back({i, pairs + i, 0.5 + uniform_of(hash_words({9, static_cast<std::uint64_t>(i)}))});
        made.mesh_of[static_cast<std::size_t>(pairs + i)] = 1;
        Eigen::Vector3d x;
        Eigen::Vector3d y;
        for (int a = 0; a < 3; ++a) {
            const auto k = static_cast<std::uint64_t>(3 * i + a);
            x[a] = normal_of(1, k);
            y[a] = normal_of(2, k);
        }
        y[2] = r * x[2] + std::sqrt(1.0 - r * r) * y[2];
        made.positions.col(i) = turn * x;
        made.positions.col(pairs + i) = turn * y;
    }
    made.links = graph(2 * pairs, edges);
    return made;
}

PositionFrame frame_of(const LinkedPairs& made) {
    return position_frame(Comm(MPI_COMM_SELF), made.links, made.positions, made.mesh_of);
}

TEST(PlaceAgreement, FindsTheDirectionAlongWhichPlacesAgree) {
    const Eigen::Vector3d up = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
    const PositionFrame frame = frame_of(linked_pairs(4000, up, 0.7));
    EXPECT_NEAR(frame.correlation[2], 0.7, 0.03);
    EXPECT_LT(frame.correlation[1], 0.06);
    EXPECT_GT(std::abs(frame.directions.col(2).normalized().dot(up)), 0.995);
    EXPECT_NEAR(frame.directions.col(2).norm(), 1.0, 0.05) << "the positions have spread 1";
}

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }

double joint_density(double x, double y, double r) {
    const double rest = 1.0 - r * r;
    return std::exp(-(x * x - 2.0 * r * x * y + y * y) / (2.0 * rest)) /
           (2.0 * std::numbers::pi * std::sqrt(rest));
}

TEST(PlaceAgreement, WeighsALinkByTheRatioOfDensities) {
    PositionFrame frame;
    frame.mean = {0.5, 0.0, 0.0};
    frame.correlation = {0.0, 0.3, 0.8};
    Eigen::Matrix3Xd positions(3, 3);
    positions << 1.0, 0.0, -2.0, 0.4, 0.5, 1.5, -1.0, -1.2, 0.9;
    SparseRows links = graph(3, {{0, 1, 2.0}, {0, 2, 3.0}, {1, 2, 5.0}});
    weigh_by_position(frame, positions, {0, 1, 1}, links);
    const auto ratio = [&](int i, int j) {
        double product = 1.0;
        for (int a = 1; a < 3; ++a) {
            const double x = positions(a, i);
            const double y = positions(a, j);
            product *= joint_density(x, y, frame.correlation[a]) / (density(x) * density(y));
        }
        return product;
    };
    const std::vector<double> expected = {
        2.0 * ratio(0, 1), 3.0 * ratio(0, 2), 2.0 * ratio(1, 0), 5.0, 3.0 * ratio(2, 0), 5.0};
    ASSERT_EQ(links.values.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_NEAR(links.values[k], expected[k], 1e-12 * expected[k]);
    EXPECT_GT(ratio(0, 1), 1.0);
    EXPECT_LT(ratio(0, 2), 1.0);
}

TEST(PlaceAgreement, ALinkNeverVanishes) {
    PositionFrame frame;
    frame.correlation = {0.0, 0.0, 0.95};
    Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 2);
    positions.row(2) << 100.0, -100.0;
    SparseRows links = graph(2, {{0, 1, 1.0}});
    weigh_by_position(frame, positions, {0, 1}, links);
    EXPECT_DOUBLE_EQ(links.values[0], std::exp(-20.0));
}

TEST(PlaceAgreement, WithoutCorrelationNothingChanges) {
    // Each patch is linked as much to a place as to its mirror image.
    Eigen::Matrix3Xd positions(3, 4);
    positions << 1.0, -1.0, 1.0, -1.0, 2.0, -2.0, 2.0, -2.0, 0.5, -0.5, 0.5, -0.5;
    SparseRows links = graph(4, {{0, 2, 1.0}, {0, 3, 1.0}, {1, 2, 1.0}, {1, 3, 1.0}});
    const std::vector<int> mesh_of = {0, 0, 1, 1};
    const PositionFrame frame = position_frame(Comm(MPI_COMM_SELF), links, positions, mesh_of);
    EXPECT_LT(frame.correlation.maxCoeff(), 1e-9);
    weigh_by_position(frame, positions, mesh_of, links);
    for (const double value : links.values) EXPECT_NEAR(value, 1.0, 1e-9);
}

TEST(PlaceAgreement, ACommonAffineMapChangesNothing) {
    LinkedPairs made = linked_pairs(50, Eigen::Vector3d::UnitX(), 0.6);
    LinkedPairs mapped = made;
    Eigen::Matrix3d map;
    map << 2.0, 0.3, 0.0, -0.5, 0.7, 0.1, 0.2, 0.0, 5.0;
    mapped.positions = (map * made.positions).colwise() + Eigen::Vector3d(1.0, 2.0, -3.0);
    const PositionFrame a = frame_of(made);
    const PositionFrame b = frame_of(mapped);
    EXPECT_LT((a.correlation - b.correlation).norm(), 1e-7);
    weigh_by_position(a, made.positions, made.mesh_of, made.links);
    weigh_by_position(b, mapped.positions, mapped.mesh_of, mapped.links);
    for (std::size_t k = 0; k < made.links.values.size(); ++k)
        EXPECT_NEAR(made.links.values[k], mapped.links.values[k], 1e-6 * made.links.values[k]);
}

TEST(PlaceAgreement, HasTheSameBitsOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    LinkedPairs made = linked_pairs(150, Eigen::Vector3d(1.0, 1.0, 0.0).normalized(), 0.8);
    SparseRows owned = owned_rows(comm, made.links);
    const PositionFrame alone = frame_of(made);
    const PositionFrame shared = position_frame(comm, owned, made.positions, made.mesh_of);
    EXPECT_EQ(shared.mean, alone.mean);
    EXPECT_EQ(shared.directions, alone.directions);
    EXPECT_EQ(shared.correlation, alone.correlation);
    weigh_by_position(shared, made.positions, made.mesh_of, owned);
    weigh_by_position(alone, made.positions, made.mesh_of, made.links);
    EXPECT_EQ(gather_rows(comm, owned).values, made.links.values);
}

TEST(PlaceAgreement, FlatShapesAndShapesWithoutLinksAreLeftAlone) {
    LinkedPairs flat = linked_pairs(50, Eigen::Vector3d::UnitZ(), 0.9);
    flat.positions.row(0).setZero();
    flat.positions.row(1).setZero();
    const PositionFrame frame = frame_of(flat);
    EXPECT_TRUE(frame.directions.allFinite());
    EXPECT_NEAR(frame.correlation[2], 0.9, 0.1);
    EXPECT_LT(frame.correlation[1], 1e-6);
    const PositionFrame none =
        position_frame(Comm(MPI_COMM_SELF), graph(2, {{0, 1, 1.0}}), Eigen::Matrix3Xd::Random(3, 2), {0, 0});
    EXPECT_TRUE(none.correlation.isZero());
}

}  // namespace
}  // namespace coseg
