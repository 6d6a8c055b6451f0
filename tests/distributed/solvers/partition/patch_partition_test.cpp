#include "solvers/partition/patch_partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "solvers/petsc/petsc_handle.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "solvers/subspace/feature_strength.hpp"
#include "src/base/seeded_random.hpp"
#include "tests/support/graphs.hpp"

namespace coseg {
namespace {

using testing_graphs::same_partition;
using testing_graphs::segment_descriptors;
using testing_graphs::segment_features;
using testing_graphs::toy_collection;
using testing_graphs::toy_input;
using testing_graphs::ToyCollection;

CutResult cut(const Comm& comm, const ToyCollection& toy, const CutOptions& options) {
    const std::vector<ChoiceDescriptor> descriptors = segment_descriptors(toy);
    return partition_patches(comm, toy_input(toy, descriptors), options);
}

CutOptions pooled(int parts) {
    CutOptions options;
    options.parts = parts;
    options.starts = pooled_starts(parts);
    options.spectral.mesh_balance = 0.3;
    return options;
}

CutOptions paper(int parts) {
    CutOptions options;
    options.parts = parts;
    options.form = AffinityForm::formula_8;
    options.drop_below = 1e-6;
    options.spectral.offset = 0.5;
    options.starts = single_start(parts, 0.0);
    return options;
}

void expect_same_result(const CutResult& a, const CutResult& b) {
    EXPECT_EQ(a.part_of_patch, b.part_of_patch);
    EXPECT_EQ(a.part_share, b.part_share);
    EXPECT_EQ(a.chosen, b.chosen);
    EXPECT_EQ(a.eigenvalues, b.eigenvalues);
    EXPECT_EQ(a.starts, b.starts);
}

class CoSegmentationCut : public testing::TestWithParam<int> {};

TEST_P(CoSegmentationCut, FindsTheSegmentsFromSeveralStarts) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    const CutResult result = cut(comm, toy, pooled(parts));
    EXPECT_TRUE(same_partition(result.part_of_patch, toy.truth));
    double shares = 0.0;
    for (std::size_t k = 0; k < result.part_share.size(); ++k) {
        shares += result.part_share[k];
        EXPECT_EQ(result.meshes_with_part[k], 6);
        EXPECT_LE(result.part_share[k], k > 0 ? result.part_share[k - 1] : 1.0);
    }
    EXPECT_NEAR(shares, 1.0, 1e-12);
}

TEST_P(CoSegmentationCut, HasTheSameBytesOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const int parts = GetParam();
    const ToyCollection shared = toy_collection(comm, 5, parts, 5, 3);
    const ToyCollection alone = toy_collection(self, 5, parts, 5, 3);
    expect_same_result(cut(comm, shared, pooled(parts)), cut(self, alone, pooled(parts)));
    expect_same_result(cut(comm, shared, paper(parts)), cut(self, alone, paper(parts)));
}

TEST_P(CoSegmentationCut, AllRanksTogetherFindWhatOneFindsAlone) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    CutOptions options = pooled(parts);
    options.starts = {{{2.0, 2.0}, 2 * parts}, {{0.0, 1.0}, 3 * parts}};
    options.starts.push_back(single_start(parts, 5.0)[0]);
    options.choice.links = 0.0;  // which nobody holds together
    options.screening = {.meshes = 3, .graphs = 2};
    const CutResult dealt = cut(comm, toy, options);
    EXPECT_EQ(dealt.starts_left_out, 1);
    options.one_rank_entries = 0;
    CutResult together = cut(comm, toy, options);
    const Comm self(MPI_COMM_SELF);
    expect_same_result(together, cut(self, toy_collection(self, 6, parts, 6, 77), options));
    // One rank alone sums in another way than all together: eigenvalues differ by rounding, all else agrees.
    ASSERT_EQ(together.eigenvalues.size(), dealt.eigenvalues.size());
    for (std::size_t k = 0; k < dealt.eigenvalues.size(); ++k)
        EXPECT_NEAR(together.eigenvalues[k], dealt.eigenvalues[k], 1e-12) << k;
    together.eigenvalues = dealt.eigenvalues;
    expect_same_result(together, dealt);
}

TEST_P(CoSegmentationCut, FinishesOnlyTheStartsThatDoWellOnASampleOfTheMeshes) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 8, parts, 6, 77);
    CutOptions options = pooled(parts);
    const std::size_t all = options.starts.size();
    options.screening = {.meshes = 5, .graphs = 2};
    const CutResult none_left_out = cut(comm, toy, options);
    EXPECT_EQ(none_left_out.starts.size(), all) << "8 meshes are less than twice the sample";
    EXPECT_EQ(none_left_out.starts_left_out, 0);
    options.screening.meshes = 4;
    const CutResult screened = cut(comm, toy, options);
    EXPECT_TRUE(same_partition(screened.part_of_patch, toy.truth));
    ASSERT_EQ(screened.starts.size(), all / 3) << "2 of 6 graphs";
    EXPECT_EQ(screened.starts_left_out, static_cast<int>(all - all / 3));
    std::size_t k = 0;
    for (const CutStart& start : options.starts) {
        if (k < screened.starts.size() && start == screened.starts[k].start) ++k;
    }
    EXPECT_EQ(k, screened.starts.size()) << "in the order in which they were asked for";
    expect_same_result(screened, cut(self, toy_collection(self, 8, parts, 6, 77), options));
}

TEST_P(CoSegmentationCut, TakesAnotherStartWhereAdjacencyCutsShapesApart) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    // Nothing tells where segments meet.
    for (GlobalPatchNeighbors& pair : toy.neighbors) pair.concavity = 0.0;
    CutOptions options;
    options.parts = parts;
    options.starts = single_start(parts, 1000.0);
    EXPECT_FALSE(same_partition(cut(comm, toy, options).part_of_patch, toy.truth)) << "shapes, not parts";
    const std::vector<CutStart> more = pooled_starts(parts);
    options.starts.insert(options.starts.end(), more.begin(), more.end());
    const CutResult result = cut(comm, toy, options);
    EXPECT_GE(result.chosen, 1);
    EXPECT_TRUE(same_partition(result.part_of_patch, toy.truth));
    EXPECT_FALSE(result.starts[static_cast<std::size_t>(result.chosen)].degenerate);
}

TEST_P(CoSegmentationCut, TheChosenStartHasTheBestScoreOfThoseThatAreNotDegenerate) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 5, parts, 5, 3);
    const CutResult result = cut(comm, toy, pooled(parts));
    const StartOutcome& chosen = result.starts[static_cast<std::size_t>(result.chosen)];
    for (const StartOutcome& start : result.starts) {
        EXPECT_EQ(start.parts_found, parts);
        if (!start.degenerate) {
            EXPECT_LE(start.score, chosen.score);
        }
    }
}

/// The segments of mesh 0 are given, numbered the other way round.
ExampleLabels labels_of_the_first_mesh(const ToyCollection& toy, int parts) {
    ExampleLabels examples{Eigen::MatrixXd::Zero(parts, toy.patches)};
    for (int i = 0; i < toy.patches; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (toy.mesh_of[k] == 0) examples.area(parts - 1 - toy.truth[k], i) = toy.area[k];
    }
    return examples;
}

CutResult cut_by_example(const Comm& comm, const ToyCollection& toy, int parts, const ExampleLabels& examples,
                         std::int64_t one_rank_entries = 1'000'000) {
    const std::vector<ChoiceDescriptor> descriptors = segment_descriptors(toy);
    const SinglePrecisionFeatures features = segment_features(toy);
    CutInput input = toy_input(toy, descriptors, &features);
    input.examples = &examples;
    CutOptions options = pooled(parts);
    options.one_rank_entries = one_rank_entries;
    return partition_patches(comm, input, options);
}

TEST_P(CoSegmentationCut, GivesAllMeshesTheLabelsOfTheExample) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    const ExampleLabels examples = labels_of_the_first_mesh(toy, parts);
    const CutResult result = cut_by_example(comm, toy, parts, examples);
    std::vector<int> expected;
    for (const int segment : toy.truth) expected.push_back(parts - 1 - segment);
    EXPECT_EQ(result.part_of_patch, expected);
    const ToyCollection alone = toy_collection(self, 6, parts, 6, 77);
    expect_same_result(result, cut_by_example(self, alone, parts, examples));
    EXPECT_EQ(cut_by_example(comm, toy, parts, examples, 0).part_of_patch, expected)
        << "where all ranks share each graph";
}

TEST_P(CoSegmentationCut, KeepsWhatAnExampleSaysAgainstAllElse) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    ExampleLabels examples = labels_of_the_first_mesh(toy, parts);
    // One patch is said to be what it is not, and of another one nothing is said.
    const int wrong = (toy.truth[3] + 1) % parts;
    examples.area.col(3).setZero();
    examples.area(parts - 1 - wrong, 3) = toy.area[3];
    examples.area.col(8).setZero();
    const CutResult result = cut_by_example(comm, toy, parts, examples);
    EXPECT_EQ(result.part_of_patch[3], parts - 1 - wrong);
    EXPECT_EQ(result.part_of_patch[8], parts - 1 - toy.truth[8]);
}

TEST_P(CoSegmentationCut, ALabelWithoutExampleGoesToThePartThatNoExampleShows) {
    const Comm comm(MPI_COMM_WORLD);
    const int parts = GetParam();
    if (parts == 2) return;  // one label alone says nothing of where the other one begins
    const ToyCollection toy = toy_collection(comm, 6, parts, 6, 77);
    ExampleLabels examples = labels_of_the_first_mesh(toy, parts);
    examples.area.row(parts - 1).setZero();  // of segment 0
    const CutResult result = cut_by_example(comm, toy, parts, examples);
    std::vector<int> expected;
    for (const int segment : toy.truth) expected.push_back(parts - 1 - segment);
    EXPECT_EQ(result.part_of_patch, expected);
}

INSTANTIATE_TEST_SUITE_P(Parts, CoSegmentationCut, testing::Values(2, 3, 5));

/// Two parts of eight patches in each of five meshes, one above the other. Patches are linked to all of the
/// other meshes: those of mesh 0 more to the wrong part, the others to their own.
struct MisleadingLinks {
    static constexpr int meshes = 5;
    static constexpr int patches = meshes * 16;
    std::vector<int> mesh_of;
    std::vector<int> truth;
    std::vector<double> area = std::vector<double>(patches, 1.0 / 16.0);
    Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, patches);
    SparseCoefficients coefficients;

    explicit MisleadingLinks(const Comm& comm) {
        for (int i = 0; i < patches; ++i) {
            mesh_of.push_back(i / 16);
            truth.push_back(i % 16 / 8);
            const auto random = [&](std::uint64_t k) {
                return uniform_of(hash_words({static_cast<std::uint64_t>(i), k})) - 0.5;
            };
            positions.col(i) << random(1), random(2), (truth.back() == 0 ? -1.0 : 1.0) + random(3);
        }
        coefficients.size = patches;
        coefficients.features = 1;
        coefficients.columns = block_range(patches, comm.size(), comm.rank(), coefficient_tile);
        coefficients.offsets = {0};
        for (auto j = static_cast<int>(coefficients.columns.begin); j < coefficients.columns.end; ++j) {
            for (int i = 0; i < patches; ++i) add(i, j);
            coefficients.offsets.push_back(static_cast<std::int64_t>(coefficients.rows.size()));
        }
    }

    void add(int row, int column) {
        const auto i = static_cast<std::size_t>(row);
        const auto j = static_cast<std::size_t>(column);
        if (mesh_of[i] == mesh_of[j]) return;
        const bool misled = mesh_of[i] == 0 || mesh_of[j] == 0;
        coefficients.rows.push_back(row);
        coefficients.values.push_back(truth[i] == truth[j] ? (misled ? 0.4 : 1.0) : (misled ? 0.6 : 0.1));
    }

    [[nodiscard]] CutInput input(const std::vector<GlobalPatchNeighbors>& neighbors,
                                 const std::vector<GlobalPatchOverlap>& overlaps) const {
        return {coefficients, neighbors, overlaps, mesh_of, area, {}, &positions};
    }
};

TEST(CoSegmentationCutByPlace, PlacesSetRightWhatLinksAloneMislead) {
    const Comm comm(MPI_COMM_WORLD);
    const MisleadingLinks toy(comm);
    CutOptions options;
    options.choice.links = 0.0;  // which nobody holds together
    options.starts = single_start(2, 0.0);
    const CutResult misled = partition_patches(comm, toy.input({}, {}), options);
    std::vector<int> swapped = toy.truth;
    for (std::size_t i = 0; i < 16; ++i) swapped[i] = 1 - swapped[i];
    EXPECT_TRUE(same_partition(misled.part_of_patch, swapped));
    EXPECT_TRUE(misled.frame.correlation.isZero()) << "nothing asked for it";
    options.starts[0].graph.placed = true;
    const CutResult placed = partition_patches(comm, toy.input({}, {}), options);
    EXPECT_TRUE(same_partition(placed.part_of_patch, toy.truth));
    EXPECT_GT(placed.frame.correlation[2], 0.3);
    options.one_rank_entries = 0;
    expect_same_result(partition_patches(comm, toy.input({}, {}), options), placed);
    const Comm self(MPI_COMM_SELF);
    const MisleadingLinks alone(self);
    expect_same_result(partition_patches(self, alone.input({}, {}), options), placed);
}

TEST(CoSegmentationCutByPlace, WithoutPlacesIsAnInternalError) {
    const Comm comm(MPI_COMM_WORLD);
    const ToyCollection toy = toy_collection(comm, 2, 2, 3, 1);
    CutOptions options;
    options.starts = pooled_starts(2, true);
    try {
        cut(comm, toy, options);
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::internal);
    }
}

TEST(CoSegmentationCutEdges, OnePartNeedsNoCut) {
    const Comm comm(MPI_COMM_WORLD);
    const ToyCollection toy = toy_collection(comm, 2, 2, 3, 1);
    CutOptions options = pooled(1);
    options.starts = single_start(1, 5.0);
    const CutResult result = cut(comm, toy, options);
    EXPECT_EQ(result.part_of_patch, std::vector<int>(static_cast<std::size_t>(toy.patches), 0));
    EXPECT_NEAR(result.part_share[0], 1.0, 1e-12);
}

TEST(CoSegmentationCutEdges, MorePartsThanPatchesIsAUsageError) {
    const Comm comm(MPI_COMM_WORLD);
    const ToyCollection toy = toy_collection(comm, 2, 2, 3, 1);
    try {
        cut(comm, toy, pooled(toy.patches + 1));
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("there are 24 patches"), std::string::npos) << error.what();
    }
}

TEST(CoSegmentationCutEdges, ASingleMeshIsCutByItsAdjacencyAlone) {
    const Comm comm(MPI_COMM_WORLD);
    const ToyCollection toy = toy_collection(comm, 1, 3, 8, 1);
    EXPECT_TRUE(toy.coefficients.rows.empty());
    EXPECT_TRUE(same_partition(cut(comm, toy, pooled(3)).part_of_patch, toy.truth));
}

TEST(CoSegmentationCutEdges, WithoutAnyLinkThereIsNothingToCut) {
    const Comm comm(MPI_COMM_WORLD);
    const ToyCollection toy = toy_collection(comm, 1, 3, 8, 1);
    try {
        cut(comm, toy, paper(3));
        FAIL() << "no throw";
    } catch (const AgreedError& error) {
        EXPECT_EQ(error.code(), ExitCode::input);
    }
}

TEST(CoSegmentationCutEdges, PatchesWithoutMatchesFollowTheirNeighbours) {
    const Comm comm(MPI_COMM_WORLD);
    ToyCollection toy = toy_collection(comm, 6, 3, 6, 5);
    // The coefficients of every ninth patch vanish, as column and as row.
    SparseCoefficients thinned = toy.coefficients;
    thinned.rows.clear();
    thinned.values.clear();
    thinned.offsets.assign(1, 0);
    for (std::size_t c = 0; c + 1 < toy.coefficients.offsets.size(); ++c) {
        const auto column = static_cast<int>(toy.coefficients.columns.begin) + static_cast<int>(c);
        for (auto k = static_cast<std::size_t>(toy.coefficients.offsets[c]);
             k < static_cast<std::size_t>(toy.coefficients.offsets[c + 1]); ++k) {
            if (column % 9 == 4 || toy.coefficients.rows[k] % 9 == 4) continue;
            thinned.rows.push_back(toy.coefficients.rows[k]);
            thinned.values.push_back(toy.coefficients.values[k]);
        }
        thinned.offsets.push_back(static_cast<std::int64_t>(thinned.rows.size()));
    }
    toy.coefficients = thinned;
    CutOptions options = paper(3);
    options.spectral.offset = 0.0;
    const CutResult result = cut(comm, toy, options);
    EXPECT_EQ(result.starts[0].set_aside, 24);
    EXPECT_EQ(result.starts[0].unreached, 0);
    EXPECT_TRUE(same_partition(result.part_of_patch, toy.truth));
}

TEST(CoSegmentationCutEdges, ThePapersTextIgnoresAdjacencyAndOverlap) {
    const Comm comm(MPI_COMM_WORLD);
    ToyCollection toy = toy_collection(comm, 6, 3, 6, 77);
    const CutResult with = cut(comm, toy, paper(3));
    for (GlobalPatchNeighbors& pair : toy.neighbors) pair.boundary_length *= 1.0 + pair.patch_a % 3;
    for (GlobalPatchOverlap& pair : toy.overlaps) pair.intersection_over_union *= 0.5;
    const CutResult changed = cut(comm, toy, paper(3));
    EXPECT_EQ(with.eigenvalues, changed.eigenvalues);
    EXPECT_EQ(with.part_of_patch, changed.part_of_patch);
}

TEST(FeatureStrength, CountsPairsAndSharesByDefinition) {
    const Comm comm(MPI_COMM_WORLD);
    SparseCoefficients w;
    w.size = 4;
    w.columns = block_range(4, comm.size(), comm.rank(), coefficient_tile);
    w.features = 2;
    w.offsets.assign(1, 0);
    if (comm.is_root()) {  // parts {0, 1} and {2, 3}; w_01 = (1, 3), w_23 = (2, 0), w_03 = (0, 2)
        w.offsets = {0, 0, 1, 1, 3};
        w.rows = {0, 0, 2};
        w.values = {1.0, 3.0, 0.0, 2.0, 2.0, 0.0};
    }
    const FeatureStrength s = feature_strength(comm, w, {0, 0, 1, 1}, 2);
    EXPECT_EQ(s.pairs_by_features, (std::vector<std::int64_t>{0, 2, 1}));
    EXPECT_EQ(s.of_part[0], (std::vector<double>{0.25, 0.75}));
    EXPECT_EQ(s.of_part[1], (std::vector<double>{1.0, 0.0}));
    EXPECT_EQ(s.overall, (std::vector<double>{0.375, 0.625}));
    EXPECT_EQ(s.inside, (std::vector<double>{1.0, 0.5}));
    const double total = std::sqrt(10.0) + 2.0 + 2.0;  // norms of the pairs
    EXPECT_DOUBLE_EQ(s.blocks[0][0], std::sqrt(10.0) / total);
    EXPECT_DOUBLE_EQ(s.blocks[0][1], 2.0 / total);
    EXPECT_EQ(s.blocks[1][0], 0.0);
    EXPECT_DOUBLE_EQ(s.blocks[1][1], 2.0 / total);
}

TEST(FeatureStrength, HasTheSameBitsOnAnyNumberOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    const Comm self(MPI_COMM_SELF);
    std::vector<int> parts;
    for (int i = 0; i < 150; ++i) parts.push_back(i % 3);
    const auto shared =
        feature_strength(comm, testing_graphs::random_coefficients(comm, 150, 5, 8, 4), parts, 3);
    const auto alone =
        feature_strength(self, testing_graphs::random_coefficients(self, 150, 5, 8, 4), parts, 3);
    EXPECT_EQ(shared.of_part, alone.of_part);
    EXPECT_EQ(shared.overall, alone.overall);
    EXPECT_EQ(shared.inside, alone.inside);
    EXPECT_EQ(shared.blocks, alone.blocks);
    EXPECT_EQ(shared.pairs_by_features, alone.pairs_by_features);
}

TEST(PetscSession, ReportsOptionsThatNobodyAskedFor) {
    const Comm comm(MPI_COMM_WORLD);
    check(PetscOptionsSetValue(nullptr, "-eps_ncw", "90"), "PetscOptionsSetValue");
    check(PetscOptionsSetValue(nullptr, "-eps_ncv", "90"), "PetscOptionsSetValue");
    EXPECT_EQ(unused_petsc_options(), std::vector<std::string>{"-eps_ncw 90"}) << "before a run";
    cut(comm, toy_collection(comm, 6, 3, 6, 77), pooled(3));
    EXPECT_EQ(unused_petsc_options(), std::vector<std::string>{"-eps_ncw 90"})
        << "on ranks with and without a solve";
    check(PetscOptionsClearValue(nullptr, "-eps_ncw"), "PetscOptionsClearValue");
    check(PetscOptionsClearValue(nullptr, "-eps_ncv"), "PetscOptionsClearValue");
}

}  // namespace
}  // namespace coseg
