#pragma once
// The seam between the passes over all pairs and what computes their scores. The processor's kernel is behind
// it; a graphics card could be.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/panel_columns.hpp"

namespace coseg {

/// The columns that rows are scored against, in single precision and in the groups of pair_score_kernel.hpp.
class DualColumns {
  public:
    /// Makes room for `columns` columns and sets them to zero.
    void reset(const FeatureStack& stack, int columns);
    /// u, D values, and for each feature what is added to its score before the price is taken off.
    void set(int column, const double* dual, const double* errors);

    [[nodiscard]] int groups() const noexcept { return groups_; }
    /// Whole groups of columns.
    [[nodiscard]] int columns() const noexcept;
    /// The values of feature h: group by group and d_h times, group_columns values together.
    [[nodiscard]] const float* values(int h) const;
    /// One for each column.
    [[nodiscard]] const float* errors(int h) const;

  private:
    int groups_ = 0;
    std::vector<int> offset_;
    std::vector<float> values_;
    std::vector<float> errors_;
};

/// The scores of some panels: for panel p of them, counted from 0, and column c, panel_rows values together.
class PanelScores {
  public:
    /// Keeps its memory where there is enough. Values are undefined.
    void resize(int panels, int features, int columns);
    /// x_hi . u_hj, one array of columns after the other.
    [[nodiscard]] float* scores(int panel, int h, int column) {
        return scores_.data() + scores_place(panel, h, column);
    }
    [[nodiscard]] const float* scores(int panel, int h, int column) const {
        return scores_.data() + scores_place(panel, h, column);
    }
    /// sum_h (x_hi . u_hj + error_hj - price_hi)_+^2
    [[nodiscard]] float* squares(int panel, int column) {
        return squares_.data() + squares_place(panel, column);
    }
    [[nodiscard]] const float* squares(int panel, int column) const {
        return squares_.data() + squares_place(panel, column);
    }
    /// From the scores of one feature to those of the next, of the same panel, row and column.
    [[nodiscard]] std::int64_t feature_stride() const noexcept;

  private:
    [[nodiscard]] std::int64_t scores_place(int panel, int h, int column) const noexcept;
    [[nodiscard]] std::int64_t squares_place(int panel, int column) const noexcept;

    int features_ = 0;
    int columns_ = 0;
    std::vector<float> scores_;
    std::vector<float> squares_;
};

/// Computes scores and their squares in single precision. Each score is a sum of products of single precision
/// in any order, with or without fused multiply-adds, so that its rounding error is at most
/// eps (d_h + 2) ||x_h|| ||u_h|| with eps = 2^-24. The passes look again in double precision at what this
/// leaves in doubt, and the certificate holds whoever computes. Where results are to have the same bytes on
/// any number of ranks, all ranks use the same kind of scorer, and a score must not depend on what is
/// computed beside it.
class PairScorer {
  public:
    PairScorer() = default;
    virtual ~PairScorer() = default;
    PairScorer(const PairScorer&) = delete;
    PairScorer& operator=(const PairScorer&) = delete;

    /// How many panels it likes to be given at a time, at least 1.
    [[nodiscard]] virtual int batch_panels() const = 0;
    /// For each feature, one price for each place of each panel. Stays as it is until the next call, where it
    /// lies.
    virtual void set_prices(const std::vector<float>& prices) = 0;
    /// The columns of the calls of score() that follow. They stay as they are until the next call.
    virtual void set_columns(const DualColumns& columns) = 0;
    /// Scores the rows of the panels first .. first + count - 1. Places of a panel that have no row may have
    /// any value.
    virtual void score(int first, int count, PanelScores& to) = 0;
};

/// Scores the panels begin .. end - 1 in batches, and calls look(panel, place) for each while its scores are
/// at this place.
template <class Look>
void score_in_batches(PairScorer& scorer, int begin, int end, PanelScores& scores, const Look& look) {
    const int batch = scorer.batch_panels();
    for (int first = begin; first < end; first += batch) {
        const int count = std::min(batch, end - first);
        scorer.score(first, count, scores);
        for (int p = 0; p < count; ++p) look(first + p, p);
    }
}

/// The rounding of a number to single precision, relative to it.
inline constexpr double single_rounding = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());

/// Makes a scorer of the rows of `panels`, which outlive it, as does the stack.
using PairScorerFactory =
    std::function<std::unique_ptr<PairScorer>(const FeatureStack& stack, const PanelColumns& panels)>;

/// The processor's: score_pairs, one panel at a time, so that its scores are still in the cache when they are
/// looked at.
std::unique_ptr<PairScorer> processor_pair_scorer(const FeatureStack& stack, const PanelColumns& panels);

}  // namespace coseg
