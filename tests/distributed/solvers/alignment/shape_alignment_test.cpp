#include "solvers/alignment/shape_alignment.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstddef>

#include "solvers/alignment/linked_positions.hpp"
#include "solvers/alignment/rotation_fit.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {
namespace {

constexpr int meshes = 9;
constexpr int patches = 40;

/// A shape without symmetries, in nine orientations; shape 4 is mirrored.
struct TurnedCollection {
    std::vector<Eigen::Matrix3d> turns;
    Eigen::Matrix3Xd positions{3, meshes* patches};
    std::vector<int> mesh_of;
    std::vector<double> area = std::vector<double>(meshes * patches, 1.0 / patches);
    std::vector<std::uint64_t> keys;

    explicit TurnedCollection(bool turned) {
        SeededStream random(21);
        Eigen::Matrix3Xd shape(3, patches);
        for (int p = 0; p < patches; ++p)
            shape.col(p) = Eigen::Vector3d(1.8 * random.normal(), random.normal(),
                                           0.4 * random.normal() + random.uniform());
        turns = turned ? hashed_rotations(meshes, 9)
                       : std::vector<Eigen::Matrix3d>(meshes, Eigen::Matrix3d::Identity());
        if (turned) turns[4] = -turns[4];
        for (int m = 0; m < meshes; ++m) {
            positions.middleCols(m * patches, patches) = turns[static_cast<std::size_t>(m)] * shape;
            mesh_of.insert(mesh_of.end(), patches, m);
            keys.push_back(hash_words({5, static_cast<std::uint64_t>(m)}));
        }
    }

    /// Each patch has one link to every other mesh; four of ten lead to another patch than its own, and all
    /// of the mesh `unlike`.
    [[nodiscard]] SparseCoefficients links(const Comm& comm, int unlike = -1) const {
        SparseCoefficients w;
        w.size = meshes * patches;
        w.features = 1;
        w.columns = block_range(w.size, comm.size(), comm.rank(), coefficient_tile);
        w.offsets = {0};
        for (auto j = w.columns.begin; j < w.columns.end; ++j) {
            for (int m = 0; m < meshes; ++m) {
                if (m == static_cast<int>(j) / patches) continue;
                const std::uint64_t hash =
                    hash_words({static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(m)});
                const auto own = static_cast<int>(j) % patches;
                const bool is_wrong = hash % 10 < 4 || m == unlike || static_cast<int>(j) / patches == unlike;
                w.rows.push_back(m * patches + (is_wrong ? static_cast<int>(hash / 10 % patches) : own));
                w.values.push_back(1.0);
            }
            w.offsets.push_back(static_cast<std::int64_t>(w.rows.size()));
        }
        return w;
    }

    [[nodiscard]] ShapeAlignment aligned(const Comm& comm, const SparseCoefficients& w) const {
        return align_shapes(comm, {w, positions, mesh_of, area, keys, 1});
    }
};

TEST(ShapeAlignment, FindsHowShapesWereTurnedAndWhichIsMirrored) {
    const TurnedCollection made(true);
    const Comm comm(MPI_COMM_WORLD);
    const ShapeAlignment found = made.aligned(comm, made.links(comm));
    ASSERT_TRUE(found.applied()) << found.reason;
    const Eigen::Matrix3d frame = found.shapes[0].rotation * made.turns[0];
    for (std::size_t m = 0; m < meshes; ++m) {
        const ShapePose& pose = found.shapes[m];
        EXPECT_EQ(pose.reflected, m == 4) << m;
        EXPECT_TRUE((pose.rotation * made.turns[m]).isApprox(frame, 0.05)) << m;
        EXPECT_NEAR(pose.scale, 1.0, 0.05);
        EXPECT_LT(pose.translation.norm(), 0.05);
        EXPECT_TRUE(pose.found);
    }
    EXPECT_GT(found.agreement_after, 2.0 * found.agreement_before);
}

TEST(ShapeAlignment, HasTheSameBitsAsOnOneRank) {
    const TurnedCollection made(true);
    const Comm comm(MPI_COMM_WORLD);
    const Comm alone(MPI_COMM_SELF);
    const ShapeAlignment found = made.aligned(comm, made.links(comm));
    const ShapeAlignment serial = made.aligned(alone, made.links(alone));
    ASSERT_EQ(found.shapes.size(), serial.shapes.size());
    EXPECT_EQ(found.standing_share, serial.standing_share);
    EXPECT_EQ(found.agreement_after, serial.agreement_after);
    for (std::size_t m = 0; m < found.shapes.size(); ++m) {
        EXPECT_EQ(found.shapes[m].rotation, serial.shapes[m].rotation);
        EXPECT_EQ(found.shapes[m].scale, serial.shapes[m].scale);
        EXPECT_EQ(found.shapes[m].translation, serial.shapes[m].translation);
        EXPECT_EQ(found.shapes[m].residual, serial.shapes[m].residual);
    }
}

TEST(ShapeAlignment, GivesNoPlacesToAShapeOfWhichTheLinksAgreeWithNothing) {
    const TurnedCollection made(true);
    const Comm comm(MPI_COMM_WORLD);
    constexpr std::size_t unlike = 7;
    const ShapeAlignment found = made.aligned(comm, made.links(comm, unlike));
    ASSERT_TRUE(found.applied()) << found.reason;
    const Eigen::Matrix3Xd turned = turned_positions(found, made.positions, made.mesh_of);
    for (std::size_t m = 0; m < meshes; ++m) {
        EXPECT_EQ(found.shapes[m].found, m != unlike) << m;
        const auto columns = static_cast<Eigen::Index>(m) * patches;
        const Eigen::Matrix3Xd expected = (m == unlike ? 0.0 : 1.0) * found.shapes[m].rotation *
                                          made.positions.middleCols(columns, patches);
        EXPECT_EQ(turned.middleCols(columns, patches).isZero(), m == unlike) << m;
        EXPECT_TRUE(turned.middleCols(columns, patches).isApprox(expected) || m == unlike) << m;
    }
}

TEST(ShapeAlignment, PutsPatchesOfAShapeThatIsNotFoundWhereTheyAreLinkedTo) {
    const TurnedCollection made(true);
    const Comm comm(MPI_COMM_WORLD);
    constexpr int unlike = 7;
    SparseCoefficients w = made.links(comm, unlike);
    const ShapeAlignment found = made.aligned(comm, w);
    for (std::size_t e = 0; e < w.rows.size(); ++e) w.values[e] = 1.0 + w.rows[e] % 3;
    const Eigen::Matrix3Xd turned = turned_positions(found, made.positions, made.mesh_of);
    Eigen::Matrix3Xd expected = turned;
    const SparseCoefficients all = all_gathered(comm, w);
    const std::vector<double> norms = pair_norms(all);
    for (int j = unlike * patches; j < (unlike + 1) * patches; ++j) {
        double total = 0.0;
        for (auto e = at(all.offsets[at(j)]); e < at(all.offsets[at(j) + 1]); ++e) {
            if (made.mesh_of[at(all.rows[e])] == unlike) continue;
            expected.col(j) += norms[e] * turned.col(all.rows[e]);
            total += norms[e];
        }
        ASSERT_GT(total, 0.0);
        expected.col(j) /= total;
    }
    EXPECT_EQ(linked_positions(comm, found, w, made.positions, made.mesh_of), expected);
}

TEST(ShapeAlignment, LeavesShapesThatStandAlike) {
    const TurnedCollection made(false);
    const Comm comm(MPI_COMM_WORLD);
    const ShapeAlignment found = made.aligned(comm, made.links(comm));
    EXPECT_FALSE(found.applied());
    EXPECT_EQ(found.standing_share, 1.0);
    EXPECT_EQ(found.reason, "100 % stand like the others already");
    EXPECT_EQ(turned_positions(found, made.positions, made.mesh_of), made.positions);
}

TEST(ShapeAlignment, TurnsTheOneShapeThatStandsOtherwise) {
    TurnedCollection made(false);
    const Eigen::Matrix3d turn = hashed_rotations(1, 9).front();
    made.positions.middleCols(3 * patches, patches) = turn * made.positions.middleCols(3 * patches, patches);
    const Comm comm(MPI_COMM_WORLD);
    const ShapeAlignment found = made.aligned(comm, made.links(comm));
    ASSERT_TRUE(found.applied()) << found.reason;
    EXPECT_EQ(found.reason.substr(0, 42), "1 of 9 turned to stand like the others: li");
    for (std::size_t m = 0; m < meshes; ++m) {
        if (m == 3) continue;
        EXPECT_FALSE(found.shapes[m].is_turned()) << m;
        EXPECT_TRUE(found.shapes[m].found);
    }
    EXPECT_LT(angle_between(found.shapes[3].rotation, turn.transpose()), 2.0);
    EXPECT_GT(found.agreement_after, found.agreement_before);
}

TEST(ShapeAlignment, LeavesShapesWithoutLinks) {
    const TurnedCollection made(true);
    const Comm comm(MPI_COMM_WORLD);
    SparseCoefficients none = made.links(comm);
    none.rows.clear();
    none.values.clear();
    std::fill(none.offsets.begin(), none.offsets.end(), 0);
    const ShapeAlignment found = made.aligned(comm, none);
    EXPECT_FALSE(found.applied());
    EXPECT_EQ(found.reason, "no shape has links to others");
}

}  // namespace
}  // namespace coseg
