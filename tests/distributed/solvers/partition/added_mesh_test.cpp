#include "solvers/partition/added_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "src/base/index.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::segment_descriptors;
using testing_graphs::toy_collection;
using testing_graphs::ToyCollection;

constexpr int five_meshes = 5;
constexpr int three_parts = 3;

/// The last mesh of five joins the other four.
struct LastMesh {
    ToyCollection toy = toy_collection(Comm(MPI_COMM_SELF), five_meshes, three_parts, 6, 77);
    std::vector<ChoiceDescriptor> descriptors = segment_descriptors(toy);
    int known = static_cast<int>(std::count_if(toy.mesh_of.begin(), toy.mesh_of.end(),
                                               [](int mesh) { return mesh < five_meshes - 1; }));
    int count = toy.patches - known;

    [[nodiscard]] AddedMesh added(double weight_of_links) const {
        AddedMesh mesh;
        for (const GlobalPatchNeighbors& pair : toy.neighbors) {
            if (pair.patch_a >= known) mesh.neighbors.push_back(pair);
        }
        for (const GlobalPatchOverlap& pair : toy.overlaps) {
            if (pair.patch_a >= known) mesh.overlaps.push_back(pair);
        }
        mesh.descriptors = descriptors;
        mesh.mesh_of = toy.mesh_of;
        mesh.patch_area = toy.area;
        mesh.links = links(weight_of_links);
        mesh.known_parts.assign(toy.truth.begin(), toy.truth.begin() + known);
        mesh.scores = Eigen::MatrixXd::Constant(three_parts, count, 1.0 / three_parts);
        mesh.said = Eigen::MatrixXd::Zero(three_parts, count);
        return mesh;
    }

    /// Between the last mesh and the others.
    [[nodiscard]] SparseRows links(double weight) const {
        const SparseRows all = normalized_links(Comm(MPI_COMM_SELF), toy.coefficients);
        std::vector<SparseEntry> entries;
        for (int i = 0; i < toy.patches && weight > 0.0; ++i) {
            for (auto k = at(all.offsets[at(i)]); k < at(all.offsets[at(i) + 1]); ++k) {
                if ((i < known) != (all.columns[k] < known))
                    entries.push_back({i, all.columns[k], weight * all.values[k]});
            }
        }
        return rows_from_entries(toy.patches, {0, toy.patches}, std::move(entries));
    }

    [[nodiscard]] std::vector<int> truth() const { return {toy.truth.begin() + known, toy.truth.end()}; }
};

std::vector<int> parts_of(const AddedMesh& mesh) { return added_parts(mesh, {}, {}).parts; }

TEST(AddedMesh, HasThePartsThatItsLinksLeadTo) {
    const LastMesh last;
    const AddedParts found = added_parts(last.added(1.0), {}, {});
    EXPECT_EQ(found.parts, last.truth());
    ASSERT_EQ(found.confidence.size(), at(last.count));
    for (const double c : found.confidence) EXPECT_TRUE(c > 0.0 && c <= 1.0) << c;
}

TEST(AddedMesh, WithoutLinksHasThePartsWithTheBestScores) {
    const LastMesh last;
    AddedMesh mesh = last.added(0.0);
    for (int i = 0; i < last.count; ++i) mesh.scores(last.truth()[at(i)], i) += 0.6;
    EXPECT_EQ(parts_of(mesh), last.truth());
}

TEST(AddedMesh, ScoresMendWhatALinkHasWrong) {
    const LastMesh last;
    AddedMesh mesh = last.added(1.0);
    mesh.links = rows_from_entries(last.toy.patches, {0, last.toy.patches}, {});
    for (int i = 0; i < last.count; ++i) {
        mesh.scores.col(i).setZero();
        mesh.scores(last.truth()[at(i)], i) = i % 5 == 0 ? 0.3 : 1.0;
        mesh.scores((last.truth()[at(i)] + 1) % three_parts, i) = i % 5 == 0 ? 0.4 : 0.0;
    }
    EXPECT_EQ(parts_of(mesh), last.truth()) << "every fifth score is wrong by little, and ties say so";
}

TEST(AddedMesh, KeepsWhatIsSaid) {
    const LastMesh last;
    for (int patch = 0; patch < last.count; patch += 7) {
        AddedMesh mesh = last.added(1.0);
        const int other = (last.truth()[at(patch)] + 1) % three_parts;
        mesh.said(other, patch) = last.toy.area[at(last.known + patch)];
        EXPECT_EQ(parts_of(mesh)[at(patch)], other);
        mesh.said(other, patch) *= 0.3;  // less than half of the patch
        EXPECT_EQ(parts_of(mesh), last.truth());
    }
}

TEST(AddedMesh, OtherNumbersOfThePartsGiveTheSamePartsInThese) {
    const LastMesh last;
    AddedMesh mesh = last.added(1.0);
    const std::vector<int> renamed = {2, 0, 1};
    for (int& part : mesh.known_parts) part = renamed[at(part)];
    std::vector<int> expected;
    for (const int part : last.truth()) expected.push_back(renamed[at(part)]);
    EXPECT_EQ(parts_of(mesh), expected);
}

TEST(AddedMesh, HasTheOnlyPartThatThereIs) {
    const LastMesh last;
    AddedMesh mesh = last.added(1.0);
    std::fill(mesh.known_parts.begin(), mesh.known_parts.end(), 0);
    mesh.scores = Eigen::MatrixXd::Ones(1, last.count);
    mesh.said = Eigen::MatrixXd::Zero(1, last.count);
    EXPECT_EQ(parts_of(mesh), std::vector<int>(at(last.count), 0));
}

TEST(AddedMesh, RefusesWhatDoesNotFitTogether) {
    const LastMesh last;
    AddedMesh mesh = last.added(1.0);
    mesh.patch_area.pop_back();
    EXPECT_THROW(parts_of(mesh), Error);
    mesh = last.added(1.0);
    mesh.scores.resize(three_parts, 0);
    EXPECT_THROW(parts_of(mesh), Error);
}

}  // namespace
}  // namespace coseg
