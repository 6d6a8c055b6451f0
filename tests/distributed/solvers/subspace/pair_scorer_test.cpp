#include "solvers/subspace/pair_scorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "solvers/numeric/pair_score_kernel.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "tests/support/subspace_problems.hpp"

namespace coseg {
namespace {

constexpr double single_rounding = 0x1p-24;

/// What a scorer was asked for.
struct Calls {
    int scored_panels = 0;
    int largest_batch = 0;
    int prices = 0;
    int columns = 0;
};

/// Another implementation of the seam: plain loops that sum from the last product to the first, which likes
/// several panels at a time, as a graphics card would.
class BackwardScorer final : public PairScorer {
  public:
    BackwardScorer(const FeatureStack& stack, const PanelColumns& panels, Calls& calls)
        : stack_(stack), panels_(panels), calls_(calls) {}

    [[nodiscard]] int batch_panels() const override { return 3; }
    void set_prices(const std::vector<float>& prices) override {
        prices_ = prices;
        ++calls_.prices;
    }
    void set_columns(const DualColumns& columns) override {
        columns_ = &columns;
        ++calls_.columns;
    }
    void score(int first, int count, PanelScores& to) override {
        calls_.scored_panels += count;
        calls_.largest_batch = std::max(calls_.largest_batch, count);
        for (int p = 0; p < count; ++p) {
            for (int c = 0; c < columns_->columns(); ++c) {
                for (int r = 0; r < panels_.row_count(first + p); ++r) score_pair(first, p, r, c, to);
            }
        }
    }

  private:
    void score_pair(int first, int p, int r, int c, PanelScores& to) const {
        float squares = 0.0F;
        for (int h = 0; h < stack_.features; ++h) {
            const int depth = stack_.rows_of(h);
            const float* rows = panels_.values(first + p, stack_.offset[at(h)]);
            const float* duals = columns_->values(h) +
                                 static_cast<std::ptrdiff_t>(c / group_columns) * depth * group_columns +
                                 c % group_columns;
            float score = 0.0F;
            for (int k = depth - 1; k >= 0; --k)
                score += rows[k * panel_rows + r] * duals[static_cast<std::ptrdiff_t>(k) * group_columns];
            to.scores(p, h, c)[r] = score;
            const float price = prices_[at((h * panels_.count() + first + p) * panel_rows + r)];
            const float excess = std::max(score + columns_->errors(h)[c] - price, 0.0F);
            squares += excess * excess;
        }
        to.squares(p, c)[r] = squares;
    }

    const FeatureStack& stack_;
    const PanelColumns& panels_;
    Calls& calls_;
    std::vector<float> prices_;
    const DualColumns* columns_ = nullptr;
};

PairScorerFactory backward_scorer(Calls& calls) {
    return [&calls](const FeatureStack& stack, const PanelColumns& panels) {
        return std::make_unique<BackwardScorer>(stack, panels, calls);
    };
}

TEST(PanelColumns, HoldRowsOfOneGroupEach) {
    const Comm world(MPI_COMM_WORLD);
    const FeatureStack stack = stack_features(random_subspace_problem(2, 7, 155, 5, 41));
    const std::array groups{0, 1, 49, 97, 155};
    const PanelColumns panels(world, stack, groups);
    ASSERT_EQ(panels.count(), 5);
    const std::array first{0, 1, 49, 97, 145};
    const std::array count{1, 48, 48, 48, 10};
    for (int p = 0; p < panels.count(); ++p) {
        EXPECT_EQ(panels.first_row(p), first[at(p)]);
        EXPECT_EQ(panels.row_count(p), count[at(p)]);
        for (int r = 0; r < panel_rows; ++r) {
            const bool is_row = r < panels.row_count(p);
            const double value = is_row ? stack.columns(stack.offset[1] + 2, first[at(p)] + r) : 0.0;
            EXPECT_EQ(panels.values(p, stack.offset[1])[2 * panel_rows + r], static_cast<float>(value));
        }
    }
    EXPECT_EQ(panels.first_panel(3), 3);
    EXPECT_EQ(panels.first_panel(4), 5);
}

/// Scores of all panels by a scorer, for columns and prices of a seed.
class ScorerOnUnevenGroups : public testing::Test {
  protected:
    ScorerOnUnevenGroups()
        : panels_(Comm(MPI_COMM_WORLD), stack_, std::array{0, 5, 22, 55, 96, 140, 188}),
          exact_(stack_.dimension, columns_),
          prices_(at(stack_.features * panels_.count() * panel_rows)) {
        SeededStream random(9);
        for (double& u : exact_.reshaped()) u = random.uniform(-1.0, 1.0);
        for (float& price : prices_) price = static_cast<float>(random.uniform(0.0, 0.5));
        duals_.reset(stack_, columns_);
        for (int c = 0; c < columns_; ++c)
            duals_.set(c, exact_.col(c).data(), std::array{0.0, 0.01 * c, 0.02}.data());
    }

    void expect_scores_of(PairScorer& scorer) {
        PanelScores scores;
        scores.resize(scorer.batch_panels(), stack_.features, duals_.columns());
        scorer.set_prices(prices_);
        scorer.set_columns(duals_);
        for (int first = 0; first < panels_.count(); first += scorer.batch_panels()) {
            const int count = std::min(scorer.batch_panels(), panels_.count() - first);
            scorer.score(first, count, scores);
            for (int p = 0; p < count; ++p) expect_panel(first + p, p, scores);
        }
    }

    void expect_panel(int panel, int place, const PanelScores& scores) const {
        for (int c = 0; c < columns_; ++c) {
            for (int r = 0; r < panels_.row_count(panel); ++r) {
                double squares = 0.0;
                for (int h = 0; h < stack_.features; ++h) {
                    const auto x =
                        stack_.columns.col(panels_.first_row(panel) + r).segment(stack_.offset[at(h)], 9);
                    const auto u = exact_.col(c).segment(stack_.offset[at(h)], 9);
                    const double allowed = single_rounding * 11 * x.norm() * u.norm();
                    EXPECT_NEAR(scores.scores(place, h, c)[r], x.dot(u), allowed);
                    const double error = std::array{0.0, 0.01 * c, 0.02}[at(h)];
                    const double price = prices_[at((h * panels_.count() + panel) * panel_rows + r)];
                    squares += std::pow(std::max(x.dot(u) + error - price, 0.0), 2);
                }
                EXPECT_NEAR(scores.squares(place, c)[r], squares, 1e-5);
            }
        }
    }

    static constexpr int columns_ = 13;
    FeatureStack stack_ = stack_features(random_subspace_problem(3, 9, 188, 4, 42));
    PanelColumns panels_;
    Eigen::MatrixXd exact_;
    std::vector<float> prices_;
    DualColumns duals_;
};

TEST_F(ScorerOnUnevenGroups, OfTheProcessorIsTheProductWithinItsRounding) {
    expect_scores_of(*processor_pair_scorer(stack_, panels_));
}

TEST_F(ScorerOnUnevenGroups, OfAnotherKindIsToo) {
    Calls calls;
    expect_scores_of(*backward_scorer(calls)(stack_, panels_));
    EXPECT_EQ(calls.scored_panels, panels_.count());
    EXPECT_EQ(calls.largest_batch, 3);
}

class SolveByAnyScorer : public testing::TestWithParam<PenaltyScope> {};

TEST_P(SolveByAnyScorer, IsCertifiedToTheSameOptimum) {
    const Comm world(MPI_COMM_WORLD);
    SubspaceProblem problem = random_subspace_problem(3, 12, 330, 60, 43);
    problem.scope = GetParam();
    SolveOptions options{.gap = 1e-5, .solver = SolverChoice::working_set};
    const SolveResult usual = solve_subspace(world, problem, options);
    Calls calls;
    options.pair_scorer = backward_scorer(calls);
    const SolveResult other = solve_subspace(world, problem, options);
    EXPECT_LE(other.relative_gap, 1e-5);
    EXPECT_LE(other.lower_bound, usual.objective);
    EXPECT_LE(usual.lower_bound, other.objective);
    EXPECT_GT(calls.scored_panels, 0);
    EXPECT_GT(calls.prices, 0);
    EXPECT_GE(calls.columns, calls.prices);
    EXPECT_GT(calls.largest_batch, 1);
}

INSTANTIATE_TEST_SUITE_P(Scopes, SolveByAnyScorer, testing::Values(PenaltyScope::rows, PenaltyScope::meshes));

}  // namespace
}  // namespace coseg
