#include "mpi_drivers/optimise/iterate_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

/// Columns begin .. end, column j with j % 3 pairs, two features.
SolveIterate made_iterate(std::int64_t begin, std::int64_t end) {
    SolveIterate iterate;
    iterate.columns = {begin, end};
    iterate.offsets = {0};
    for (std::int64_t j = begin; j < end; ++j) {
        for (std::int64_t k = 0; k < j % 3; ++k) {
            iterate.rows.push_back(static_cast<int>(100 * j + k));
            iterate.weights.insert(iterate.weights.end(),
                                   {1.0 / static_cast<double>(j), static_cast<double>(k)});
        }
        iterate.offsets.push_back(static_cast<std::int64_t>(iterate.rows.size()));
        iterate.prices.insert(iterate.prices.end(), {static_cast<double>(j), -static_cast<double>(j)});
    }
    iterate.spectral.step = 0.125;
    iterate.spectral.recent = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 1.0 / 3.0};
    iterate.spectral.count = 1234567890123;
    iterate.spectral.iterations = 15;
    iterate.inner_gap = 1e-5;
    iterate.lower_bound = 7.5;
    iterate.iterations = 40;
    iterate.passes = 3;
    iterate.proximal = {35, 250.0, 1e5, 0.03};
    iterate.history = {{1, 0, 9.5, 1.0 / 3.0, 0.9, 0}, {2, 40, 8.75, 7.5, 1.25 / 8.75, 5000000000}};
    iterate.finished = true;
    iterate.objective = 8.5;
    iterate.residual = 1e-7;
    iterate.reason = StopReason::iteration_limit;
    return iterate;
}

void expect_equal(const SolveIterate& a, const SolveIterate& b) {
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.offsets, b.offsets);
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.weights, b.weights);
    EXPECT_EQ(a.prices, b.prices);
    EXPECT_EQ(a.spectral.step, b.spectral.step);
    EXPECT_EQ(a.spectral.recent, b.spectral.recent);
    EXPECT_EQ(a.spectral.count, b.spectral.count);
    EXPECT_EQ(a.spectral.iterations, b.spectral.iterations);
    EXPECT_EQ(a.inner_gap, b.inner_gap);
    EXPECT_EQ(a.lower_bound, b.lower_bound);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.passes, b.passes);
    EXPECT_EQ(a.proximal.next, b.proximal.next);
    EXPECT_EQ(a.proximal.reach, b.proximal.reach);
    EXPECT_EQ(a.proximal.largest_reach, b.proximal.largest_reach);
    EXPECT_EQ(a.proximal.sufficient_gap, b.proximal.sufficient_gap);
    EXPECT_EQ(a.history, b.history);
    EXPECT_EQ(a.finished, b.finished);
    EXPECT_EQ(a.objective, b.objective);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.reason, b.reason);
}

TEST(IterateFile, ReturnsWhatWasWritten) {
    const test::TemporaryFolder folder;
    const SolveIterate iterate = made_iterate(32, 50);
    write_iterate(folder.path("iterate.h5"), iterate, 2);
    expect_equal(read_iterate(folder.path("iterate.h5")), iterate);
}

TEST(IterateFile, PiecesOfThreeRanksMakeThoseOfTwo) {
    const std::vector<SolveIterate> pieces = {made_iterate(0, 32), made_iterate(32, 64),
                                              made_iterate(64, 70)};
    expect_equal(cut_to(pieces, {0, 70}, 2), made_iterate(0, 70));
    expect_equal(cut_to(pieces, {30, 66}, 2), made_iterate(30, 66));
    const SolveIterate none = cut_to({pieces[0]}, {70, 70}, 2);
    EXPECT_TRUE(none.rows.empty());
    EXPECT_EQ(none.offsets, std::vector<std::int64_t>{0});
    EXPECT_EQ(none.lower_bound, 7.5);
}

TEST(IterateFile, FindsTheNewestCompleteGeneration) {
    const test::TemporaryFolder folder;
    for (const auto& [generation, begin, end] :
         {std::tuple(3, 0, 32), std::tuple(3, 32, 70), std::tuple(4, 32, 70)})
        std::ofstream(iterate_path(folder.path(), generation, {begin, end})) << "x";
    std::ofstream(folder.path("iterate-1-2-3.h5")) << "not so named";
    const std::vector<IterateFile> files = iterate_files(folder.path());
    ASSERT_EQ(files.size(), 3U);
    EXPECT_EQ(files[0].generation, 4);
    EXPECT_FALSE(is_complete({files[0]}, 70));
    EXPECT_TRUE(is_complete({files[1], files[2]}, 70));
    EXPECT_FALSE(is_complete({files[1], files[2]}, 71));
    EXPECT_FALSE(is_complete({files[1]}, 70));
}

}  // namespace
}  // namespace coseg
