#include "solvers/row_scope/all_pairs_pass.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "solvers/numeric/inner_product.hpp"
#include "solvers/numeric/pair_score_kernel.hpp"
#include "solvers/row_scope/pass_clock.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The number of columns that are scored together. It is large enough to pay for reading the rows once more,
/// and not larger where the rows are in the cache and the arrays of a tile are as large as they are. The
/// answer does not depend on it.
int tile_columns(const FeatureStack& stack) {
    constexpr int few_rows = 4096;
    return (stack.size <= few_rows ? 2 : 4) * static_cast<int>(coefficient_tile);
}
static_assert(coefficient_tile % group_columns == 0);
/// Pairs whose norm, with a rounding error on top, exceeds its limit by less than so many are looked at again
/// in double.
constexpr double doubtful = 5.0;

int longest_feature(const FeatureStack& stack) {
    int longest = 0;
    for (int h = 0; h < stack.features; ++h) longest = std::max(longest, stack.rows_of(h));
    return longest;
}

}  // namespace

/// The current columns, which are whole coefficient tiles, and the scores of a batch of panels of rows.
struct AllPairsPass::Tile {
    int first = 0;        ///< column
    int first_local = 0;  ///< the same, counted from this rank's first
    int width = 0;
    std::span<const RowScopeColumn> fits;
    std::vector<std::size_t> next_working;  ///< per column: the first working row not yet passed
    Eigen::MatrixXd reconstruction;         ///< D x width
    Eigen::MatrixXd exact_duals;            ///< u, D x width
    DualColumns duals;                      ///< u, with the error of a score
    std::vector<float> doubtful_square;     ///< per column: below, a pair is looked at in double
    PanelScores scores;                     ///< squares: ||(score + error - price)_+||^2
    std::vector<float> least_squares;       ///< per column: of the least score kept, rounded down
    std::vector<std::uint64_t> above;       ///< per column: the rows of the panel that need a look
};

/// A panel of rows, and its place in the batch of the tile's scores.
struct AllPairsPass::ScoredPanel {
    int begin = 0;               ///< its first row
    std::uint64_t row_bits = 0;  ///< see PanelColumns
    int place = 0;
};

AllPairsPass::AllPairsPass(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                           const PairScorerFactory& scorer)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      limit2_(static_cast<float>(problem.alpha * problem.alpha * (1.0 - 64.0 * single_rounding))),
      rounding_(single_rounding * (longest_feature(stack) + 8)),
      panels_(comm, stack, std::array{0, stack.size}),
      scorer_(scorer(stack, panels_)),
      largest_norm_(stack.largest_norms()),
      padded_rows_(at(panels_.count()) * panel_rows),
      low_prices_(at(stack.features) * padded_rows_, std::numeric_limits<float>::max()),
      tile_(std::make_unique<Tile>()),
      pair_scores_(at(stack.features)) {}

AllPairsPass::~AllPairsPass() = default;

bool AllPairsPass::better(const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.place < b.place;
}

/// `best` holds `kept` candidates, best first.
void AllPairsPass::insert(Candidate* best, const Candidate& candidate) {
    if (!better(candidate, best[kept - 1])) return;
    int place = kept - 1;
    for (; place > 0 && better(candidate, best[place - 1]); --place) best[place] = best[place - 1];
    best[place] = candidate;
}

/// An MPI reduction of blocks of `kept` candidates. The result does not depend on the order of merging.
void AllPairsPass::merge_blocks(void* in, void* inout, int* count, MPI_Datatype* /*type*/) {
    const auto* from = static_cast<const Candidate*>(in);
    auto* to = static_cast<Candidate*>(inout);
    for (int block = 0; block < *count; ++block, from += kept, to += kept) {
        for (int k = 0; k < kept && from[k].score > 0.0; ++k) insert(to, from[k]);
    }
}

void AllPairsPass::merge_row_candidates() {
    if (comm_.size() == 1) return;
    const CommunicationClock clock(cost_);
    MPI_Datatype block = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(static_cast<int>(kept * sizeof(Candidate)), MPI_BYTE, &block);
    MPI_Type_commit(&block);
    MPI_Op merge = MPI_OP_NULL;
    MPI_Op_create(&AllPairsPass::merge_blocks, 1, &merge);
    MPI_Allreduce(MPI_IN_PLACE, row_best_.data(), stack_.size, block, merge, comm_.raw());
    MPI_Op_free(&merge);
    MPI_Type_free(&block);
}

void AllPairsPass::start(const WorkingSet& working, const std::vector<double>& row_sums) {
    row_sums_ = row_sums;
    const auto n = at(stack_.size);
    const auto features = at(stack_.features);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t h = 0; h < features; ++h) {
            const double price = 2.0 * problem_.lambda * row_sums[i * features + h] + problem_.beta;
            low_prices_[h * padded_rows_ + i] = static_cast<float>(price * (1.0 - 8.0 * single_rounding));
        }
    }
    scorer_->set_prices(low_prices_);
    row_best_.assign(n * kept, {});
    row_least_.assign(padded_rows_, 0.0F);
    column_best_.assign(working.fits.size() * kept, {});
    any_violation_ = false;
}

/// The dual of the tile's column, as it is and in single precision.
void AllPairsPass::set_column(Tile& tile, int column) const {
    double errors2 = 0.0;
    std::vector<double> errors(at(stack_.features));
    const double* x = stack_.columns.col(tile.first + column).data();
    const double* z = tile.reconstruction.col(column).data();
    double* u = tile.exact_duals.col(column).data();
    for (int k = 0; k < stack_.dimension; ++k) u[k] = 2.0 * (x[k] - z[k]);
    for (int h = 0; h < stack_.features; ++h) {
        const double* dual = u + stack_.offset[at(h)];
        const double error =
            rounding_ * std::sqrt(inner_product(dual, dual, stack_.rows_of(h))) * largest_norm_[at(h)];
        errors2 += error * error;
        errors[at(h)] = error;
    }
    tile.duals.set(column, u, errors.data());
    const double enough = problem_.alpha + doubtful * std::sqrt(errors2);
    tile.doubtful_square[at(column)] = static_cast<float>(enough * enough);
}

void AllPairsPass::start_tile(const WorkingSet& working, std::int64_t begin, Tile& tile) const {
    tile.first = static_cast<int>(working.columns.begin + begin);
    tile.first_local = static_cast<int>(begin);
    tile.width =
        static_cast<int>(std::min<std::int64_t>(tile_columns(stack_), working.columns.size() - begin));
    tile.fits = std::span(working.fits).subspan(at(begin), at(tile.width));
    tile.next_working.assign(tile.fits.size(), 0);
    tile.reconstruction.resize(stack_.dimension, tile.width);
    tile.exact_duals.resize(stack_.dimension, tile.width);
    tile.duals.reset(stack_, tile.width);
    const auto columns = at(tile.duals.columns());
    tile.scores.resize(scorer_->batch_panels(), stack_.features, tile.duals.columns());
    tile.least_squares.resize(columns);
    tile.doubtful_square.resize(columns);
    tile.above.resize(columns);
    for (int c = 0; c < tile.width; ++c) {
        const RowScopeColumn& fit = tile.fits[at(c)];
        reconstruct(stack_, fit, fit.weights.data(), tile.reconstruction.col(c).data());
        set_column(tile, c);
    }
}

/// Scores the rows of all panels against the tile's columns, batch by batch, and looks at each panel while
/// its scores are there. Squares have the error of a score on top, so that no violation is missed for
/// rounding.
template <class Look>
void AllPairsPass::for_each_scored_panel(Tile& tile, const Look& look) {
    scorer_->set_columns(tile.duals);
    score_in_batches(*scorer_, 0, panels_.count(), tile.scores, [&](int panel, int place) {
        look(ScoredPanel{panels_.first_row(panel), panels_.row_bits(panel), place});
    });
}

void AllPairsPass::keep(const Tile& tile, int column, int row, double norm) {
    Candidate* row_best = row_best_.data() + static_cast<std::int64_t>(row) * kept;
    Candidate* column_best =
        column_best_.data() + static_cast<std::int64_t>(tile.first_local + column) * kept;
    insert(row_best, {norm, tile.first + column});
    insert(column_best, {norm, row});
    row_least_[at(row)] = static_cast<float>(row_best[kept - 1].score * row_best[kept - 1].score);
}

/// W = 0: nothing is in the working set, and no bound is sought but that of W = 0.
void AllPairsPass::look_first(Tile& tile, const ScoredPanel& panel) {
    const int begin = panel.begin;
    const auto least_of = [&](int c) {
        return column_best_[at(tile.first_local + c) * kept + kept - 1].score;
    };
    for (int c = 0; c < tile.width; ++c) {
        // Rounded down, so that no pair is left out that the exact comparison would keep.
        const double least = least_of(c);
        tile.least_squares[at(c)] = static_cast<float>(least * least * (1.0 - 4.0 * single_rounding));
    }
    find_above(tile.scores.squares(panel.place, 0), tile.width, limit2_, row_least_.data() + begin,
               tile.least_squares.data(), tile.above.data());
    for (int c = 0; c < tile.width; ++c) {
        const float* squares = tile.scores.squares(panel.place, c);
        for (std::uint64_t rows = tile.above[at(c)] & panel.row_bits; rows != 0; rows &= rows - 1) {
            const int r = std::countr_zero(rows);
            const int i = begin + r;
            if (i == tile.first + c) continue;
            // The first of all violations is kept, so none is missed by what find_above leaves out.
            any_violation_ = true;
            const double least = least_of(c);
            if (squares[r] < row_least_[at(i)] && static_cast<double>(squares[r]) < least * least) continue;
            keep(tile, c, i, std::sqrt(static_cast<double>(squares[r])));
        }
    }
}

/// Fills pair_scores_ in double.
void AllPairsPass::exact_scores(const Tile& tile, int column, int row) {
    feature_products(stack_, row, tile.exact_duals.col(column).data(), pair_scores_.data());
}

/// Looks at a pair that may violate its limit according to its scores in single precision.
void AllPairsPass::inspect_pair(const Tile& tile, const ScoredPanel& panel, int column, int row,
                                PaperDualBound& bound) {
    const int r = row - panel.begin;
    double rounding = rounding_;
    if (tile.scores.squares(panel.place, column)[r] < tile.doubtful_square[at(column)]) {
        exact_scores(tile, column, row);
        rounding = stack_.inner_product_error();
    } else {
        for (int h = 0; h < stack_.features; ++h)
            pair_scores_[at(h)] = static_cast<double>(tile.scores.scores(panel.place, h, column)[r]);
    }
    const double norm = bound.check_pair(column, row, pair_scores_.data(), rounding);
    if (norm > problem_.alpha) keep(tile, column, row, norm);
}

void AllPairsPass::scan(Tile& tile, const ScoredPanel& panel, PaperDualBound& bound) {
    find_above(tile.scores.squares(panel.place, 0), tile.width, limit2_, tile.above.data());
    for (int c = 0; c < tile.width; ++c) {
        const std::vector<int>& working = tile.fits[at(c)].rows;
        std::size_t& next = tile.next_working[at(c)];
        for (std::uint64_t rows = tile.above[at(c)] & panel.row_bits; rows != 0; rows &= rows - 1) {
            const int i = panel.begin + std::countr_zero(rows);
            if (i == tile.first + c) continue;
            while (next < working.size() && working[next] < i) ++next;
            if (next < working.size() && working[next] == i) continue;
            inspect_pair(tile, panel, c, i, bound);
        }
    }
}

void AllPairsPass::check_working_pairs(const Tile& tile, PaperDualBound& bound) {
    for (int c = 0; c < tile.width; ++c) {
        for (const int row : tile.fits[at(c)].rows) {
            exact_scores(tile, c, row);
            bound.check_pair(c, row, pair_scores_.data(), stack_.inner_product_error());
        }
    }
}

std::int64_t AllPairsPass::sum_over_ranks(std::int64_t local) {
    const CommunicationClock clock(cost_);
    return all_sum(comm_, local);
}

double AllPairsPass::finish(PaperDualBound& bound) {
    const CommunicationClock clock(cost_);
    return bound.finish(comm_);
}

PassFindings AllPairsPass::first(const WorkingSet& working) {
    const PassClock clock(cost_);
    start(working, std::vector<double>(at(stack_.size) * pair_scores_.size(), 0.0));
    Tile& tile = *tile_;
    for (std::int64_t begin = 0; begin < working.columns.size(); begin += tile.width) {
        start_tile(working, begin, tile);
        for_each_scored_panel(tile, [&](const ScoredPanel& panel) { look_first(tile, panel); });
    }
    const bool optimal = sum_over_ranks(any_violation_ ? 1 : 0) == 0;
    const double at_zero = stack_.squared_norm * (1.0 - stack_.inner_product_error());
    return collect(working, optimal ? at_zero : 0.0);
}

PassFindings AllPairsPass::run(const WorkingSet& working, const std::vector<double>& row_sums) {
    const PassClock clock(cost_);
    start(working, row_sums);
    PaperDualBound bound(stack_, problem_.alpha, problem_.beta, problem_.lambda, row_sums_);
    Tile& tile = *tile_;
    for (std::int64_t begin = 0; begin < working.columns.size(); begin += tile.width) {
        start_tile(working, begin, tile);
        bound.begin_tile(tile.first, tile.width, tile.reconstruction.data());
        check_working_pairs(tile, bound);
        for_each_scored_panel(tile, [&](const ScoredPanel& panel) { scan(tile, panel, bound); });
        bound.end_tile();
    }
    const double lower_bound = finish(bound);
    return collect(working, lower_bound);
}

PassFindings AllPairsPass::collect(const WorkingSet& working, double lower_bound) {
    merge_row_candidates();
    PassFindings findings;
    findings.lower_bound = lower_bound;
    findings.entering.resize(working.fits.size());
    for (std::size_t entry = 0; entry < row_best_.size(); ++entry) {
        const std::int64_t column = row_best_[entry].place;
        if (!working.columns.contains(column)) continue;
        findings.entering[at(column - working.columns.begin)].push_back(static_cast<int>(entry / kept));
    }
    std::int64_t pairs = 0;
    for (std::size_t c = 0; c < findings.entering.size(); ++c) {
        std::vector<int>& rows = findings.entering[c];
        for (int k = 0; k < kept; ++k) {
            const Candidate& candidate = column_best_[c * kept + at(k)];
            if (candidate.place >= 0) rows.push_back(static_cast<int>(candidate.place));
        }
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        pairs += static_cast<std::int64_t>(rows.size());
    }
    findings.entering_pairs = sum_over_ranks(pairs);
    return findings;
}

}  // namespace coseg
