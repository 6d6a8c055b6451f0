#include "solvers/all_pairs_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "solvers/blas.hpp"
#include "solvers/coefficients.hpp"
#include "solvers/excess_squares.hpp"
#include "solvers/pass_clock.hpp"

namespace coseg {

namespace {

constexpr int chunk_rows = 256;
/// Columns of a matrix product: four coefficient tiles. Products always have this width, whatever of it this rank
/// owns, so that their bits are the same on any number of ranks; twice as fast as one tile at a time.
constexpr int product_columns = 4 * static_cast<int>(coefficient_tile);
constexpr int scan_block = 64;
constexpr double single_rounding = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
/// Pairs whose norm exceeds its limit by less than this many rounding errors are looked at again in double.
constexpr double doubtful = 4.0;

}  // namespace

/// The columns at hand, whole coefficient tiles within one product, and the scores of one chunk of rows.
struct AllPairsPass::Tile {
    int first = 0;        ///< column
    int first_local = 0;  ///< the same, counted from this rank's first
    int width = 0;
    int shift = 0;  ///< of the first column within its product
    std::span<const ColumnFit> fits;
    std::vector<std::size_t> next_working;  ///< per column: the first working row not yet passed
    Eigen::MatrixXd reconstruction;         ///< D x width
    Eigen::MatrixXd exact_duals;            ///< u, D x width
    Eigen::MatrixXf duals;                  ///< u, D x product_columns; 0 for the columns of others
    Eigen::MatrixXd error;                  ///< H x width: of a score
    std::vector<float> scores;              ///< H blocks of chunk_rows x product_columns
    std::vector<float> squares;             ///< of one column: ||(score + error - price)_+||^2
};

AllPairsPass::AllPairsPass(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      limit2_(static_cast<float>(problem.alpha * problem.alpha * (1.0 - 64.0 * single_rounding))),
      single_columns_(comm, stack),
      low_prices_(static_cast<std::size_t>(stack.features) * static_cast<std::size_t>(stack.size)),
      pair_scores_(static_cast<std::size_t>(stack.features)) {
    for (int h = 0; h < stack.features; ++h) {
        double largest = 0.0;
        for (Eigen::Index i = 0; i < stack.size; ++i) largest = std::max(largest, stack.norm(h, i));
        largest_norm_.push_back(largest);
    }
}

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

/// An MPI reduction of blocks of `kept` candidates; the result does not depend on the order of merging.
void AllPairsPass::merge_blocks(void* in, void* inout, int* count, MPI_Datatype* /*type*/) {
    const auto* from = static_cast<const Candidate*>(in);
    auto* to = static_cast<Candidate*>(inout);
    for (int block = 0; block < *count; ++block, from += kept, to += kept) {
        for (int k = 0; k < kept && from[k].score > 0.0; ++k) insert(to, from[k]);
    }
}

void AllPairsPass::merge_row_candidates() {
    if (comm_.size() == 1) return;
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
    const auto n = static_cast<std::size_t>(stack_.size);
    const auto features = static_cast<std::size_t>(stack_.features);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t h = 0; h < features; ++h) {
            const double price = 2.0 * problem_.lambda * row_sums[i * features + h] + problem_.beta;
            low_prices_[h * n + i] = static_cast<float>(price * (1.0 - 8.0 * single_rounding));
        }
    }
    row_best_.assign(n * kept, {});
    row_least_.assign(n, 0.0F);
    column_best_.assign(working.fits.size() * kept, {});
    any_violation_ = false;
}

AllPairsPass::Tile AllPairsPass::start_tile(const WorkingSet& working, std::int64_t begin) const {
    Tile tile;
    tile.first = static_cast<int>(working.columns.begin + begin);
    tile.first_local = static_cast<int>(begin);
    tile.shift = tile.first % product_columns;
    tile.width = static_cast<int>(
        std::min<std::int64_t>(product_columns - tile.shift, working.columns.size() - begin));
    tile.fits = std::span(working.fits)
                    .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(tile.width));
    tile.next_working.assign(tile.fits.size(), 0);
    tile.reconstruction.resize(stack_.dimension, tile.width);
    tile.exact_duals.resize(stack_.dimension, tile.width);
    tile.duals = Eigen::MatrixXf::Zero(stack_.dimension, product_columns);
    tile.error.resize(stack_.features, tile.width);
    for (int c = 0; c < tile.width; ++c) {
        const ColumnFit& fit = tile.fits[static_cast<std::size_t>(c)];
        reconstruct(stack_, fit, fit.weights.data(), tile.reconstruction.col(c).data());
        for (int h = 0; h < stack_.features; ++h) {
            const int from = stack_.offset[static_cast<std::size_t>(h)];
            double squares = 0.0;
            for (int k = from; k < from + stack_.rows_of(h); ++k) {
                const double u = 2.0 * (stack_.columns(k, tile.first + c) - tile.reconstruction(k, c));
                tile.exact_duals(k, c) = u;
                tile.duals(k, tile.shift + c) = static_cast<float>(u);
                squares += u * u;
            }
            tile.error(h, c) = single_rounding * (stack_.dimension + 8) * std::sqrt(squares) *
                               largest_norm_[static_cast<std::size_t>(h)];
        }
    }
    tile.scores.resize(static_cast<std::size_t>(chunk_rows * product_columns * stack_.features));
    tile.squares.resize(chunk_rows);
    return tile;
}

/// Scores of the rows [begin, end) against the tile's columns.
void AllPairsPass::score_chunk(Tile& tile, int begin, int end) const {
    const int rows = stack_.dimension;
    for (int h = 0; h < stack_.features; ++h) {
        const int from = stack_.offset[static_cast<std::size_t>(h)];
        multiply_transposed(end - begin, product_columns, stack_.rows_of(h),
                            single_columns_.data() + static_cast<std::int64_t>(begin) * rows + from, rows,
                            tile.duals.data() + from, rows, 0.0F,
                            tile.scores.data() + static_cast<std::int64_t>(h) * chunk_rows * product_columns,
                            chunk_rows);
    }
}

/// ||(score + error - price)_+||^2 of one column, so that no violation is missed for rounding.
void AllPairsPass::sum_squares(Tile& tile, int column, int begin, int end) const {
    const auto count = static_cast<std::size_t>(end - begin);
    float* squares = tile.squares.data();
    std::fill_n(squares, count, 0.0F);
    for (int h = 0; h < stack_.features; ++h) {
        const float* score =
            tile.scores.data() +
            (static_cast<std::int64_t>(h) * product_columns + tile.shift + column) * chunk_rows;
        const float* price = low_prices_.data() + static_cast<std::int64_t>(h) * stack_.size + begin;
        const auto error = static_cast<float>(tile.error(h, column));
        add_excess_squares(score, price, error, count, squares);
    }
}

/// Calls scan(column, begin, end) for each column and chunk of rows, with the squares in place.
template <class Scan>
void AllPairsPass::score_tile(Tile& tile, Scan&& scan) {
    for (int begin = 0; begin < stack_.size; begin += chunk_rows) {
        const int end = std::min(begin + chunk_rows, stack_.size);
        score_chunk(tile, begin, end);
        for (int c = 0; c < tile.width; ++c) {
            sum_squares(tile, c, begin, end);
            scan(c, begin, end);
        }
    }
}

void AllPairsPass::keep(const Tile& tile, int column, int row, double norm) {
    Candidate* row_best = row_best_.data() + static_cast<std::int64_t>(row) * kept;
    Candidate* column_best =
        column_best_.data() + static_cast<std::int64_t>(tile.first_local + column) * kept;
    insert(row_best, {norm, tile.first + column});
    insert(column_best, {norm, row});
    row_least_[static_cast<std::size_t>(row)] =
        static_cast<float>(row_best[kept - 1].score * row_best[kept - 1].score);
}

/// A column's pair with itself is none.
bool AllPairsPass::any_other_above(const float* squares, int begin, int end, int column) const {
    if (any_violation_) return true;
    for (int i = begin; i < end; ++i) {
        if (squares[i - begin] > limit2_ && i != column) return true;
    }
    return false;
}

/// W = 0: nothing is in the working set, and no bound is sought but that of W = 0.
void AllPairsPass::scan_first(const Tile& tile, int column, int begin, int end) {
    const Candidate* column_best =
        column_best_.data() + static_cast<std::int64_t>(tile.first_local + column) * kept;
    // Rounded down, so that what the exact comparison keeps is looked at.
    const auto least_square = [&] {
        const double least = column_best[kept - 1].score;
        return static_cast<float>(least * least * (1.0 - 4.0 * single_rounding));
    };
    for (int block = begin; block < end; block += scan_block) {
        const int stop = std::min(block + scan_block, end);
        const float* squares = tile.squares.data() + (block - begin);
        if (!any_above(squares, limit2_, row_least_.data() + block, least_square(),
                       static_cast<std::size_t>(stop - block))) {
            any_violation_ = any_violation_ || any_other_above(squares, block, stop, tile.first + column);
            continue;
        }
        for (int i = block; i < stop; ++i) {
            const float square = squares[i - block];
            if (square <= limit2_ || i == tile.first + column) continue;
            any_violation_ = true;
            const double least = column_best[kept - 1].score;
            if (square < row_least_[static_cast<std::size_t>(i)] &&
                static_cast<double>(square) < least * least)
                continue;
            keep(tile, column, i, std::sqrt(static_cast<double>(square)));
        }
    }
}

/// Fills pair_scores_ in double.
void AllPairsPass::exact_scores(const Tile& tile, int column, int row) {
    feature_products(stack_, row, tile.exact_duals.col(column).data(), pair_scores_.data());
}

/// A pair that may violate its limit, going by its scores in single precision.
void AllPairsPass::inspect_pair(const Tile& tile, int column, int row, int begin, PaperDualBound& bound) {
    const auto features = pair_scores_.size();
    double squares = 0.0;
    for (std::size_t h = 0; h < features; ++h) {
        const std::size_t block =
            h * static_cast<std::size_t>(product_columns) + static_cast<std::size_t>(tile.shift + column);
        pair_scores_[h] =
            static_cast<double>(tile.scores[block * chunk_rows + static_cast<std::size_t>(row - begin)]);
        const double price = 2.0 * problem_.lambda * row_sums_[static_cast<std::size_t>(row) * features + h];
        const double excess = std::max(pair_scores_[h] - price - problem_.beta, 0.0);
        squares += excess * excess;
    }
    double rounding = single_rounding * (stack_.dimension + 8);
    if (std::sqrt(squares) < problem_.alpha + doubtful * tile.error.col(column).norm()) {
        exact_scores(tile, column, row);
        rounding = stack_.inner_product_error();
    }
    const double norm = bound.check_pair(column, row, pair_scores_.data(), rounding);
    if (norm > problem_.alpha) keep(tile, column, row, norm);
}

void AllPairsPass::scan_column(Tile& tile, int column, int begin, int end, PaperDualBound& bound) {
    const std::vector<int>& working = tile.fits[static_cast<std::size_t>(column)].rows;
    std::size_t& next = tile.next_working[static_cast<std::size_t>(column)];
    for (int block = begin; block < end; block += scan_block) {
        const int stop = std::min(block + scan_block, end);
        const float* squares = tile.squares.data() + (block - begin);
        if (!any_above(squares, limit2_, static_cast<std::size_t>(stop - block))) continue;
        for (int i = block; i < stop; ++i) {
            if (squares[i - block] <= limit2_ || i == tile.first + column) continue;
            while (next < working.size() && working[next] < i) ++next;
            if (next < working.size() && working[next] == i) continue;
            inspect_pair(tile, column, i, begin, bound);
        }
    }
}

void AllPairsPass::check_working_pairs(const Tile& tile, PaperDualBound& bound) {
    for (int c = 0; c < tile.width; ++c) {
        for (const int row : tile.fits[static_cast<std::size_t>(c)].rows) {
            exact_scores(tile, c, row);
            bound.check_pair(c, row, pair_scores_.data(), stack_.inner_product_error());
        }
    }
}

PassFindings AllPairsPass::first(const WorkingSet& working) {
    const PassClock clock(cost_);
    start(working, std::vector<double>(low_prices_.size(), 0.0));
    for (std::int64_t begin = 0; begin < working.columns.size();) {
        Tile tile = start_tile(working, begin);
        begin += tile.width;
        score_tile(tile, [&](int c, int from, int to) { scan_first(tile, c, from, to); });
    }
    const bool optimal = all_sum(comm_, std::int64_t{any_violation_ ? 1 : 0}) == 0;
    const double at_zero = stack_.squared_norm * (1.0 - stack_.inner_product_error());
    return collect(working, optimal ? at_zero : 0.0);
}

PassFindings AllPairsPass::run(const WorkingSet& working, const std::vector<double>& row_sums) {
    const PassClock clock(cost_);
    start(working, row_sums);
    PaperDualBound bound(stack_, problem_.alpha, problem_.beta, problem_.lambda, row_sums_);
    for (std::int64_t begin = 0; begin < working.columns.size();) {
        Tile tile = start_tile(working, begin);
        begin += tile.width;
        bound.begin_tile(tile.first, tile.width, tile.reconstruction.data());
        check_working_pairs(tile, bound);
        score_tile(tile, [&](int c, int from, int to) { scan_column(tile, c, from, to, bound); });
        bound.end_tile();
    }
    const double before = MPI_Wtime();
    const double lower_bound = bound.finish(comm_);
    cost_.communication_seconds += MPI_Wtime() - before;
    return collect(working, lower_bound);
}

PassFindings AllPairsPass::collect(const WorkingSet& working, double lower_bound) {
    const double before = MPI_Wtime();
    merge_row_candidates();
    cost_.communication_seconds += MPI_Wtime() - before;
    PassFindings findings;
    findings.lower_bound = lower_bound;
    findings.entering.resize(working.fits.size());
    for (std::size_t at = 0; at < row_best_.size(); ++at) {
        const std::int64_t column = row_best_[at].place;
        if (!working.columns.contains(column)) continue;
        findings.entering[static_cast<std::size_t>(column - working.columns.begin)].push_back(
            static_cast<int>(at / kept));
    }
    std::int64_t pairs = 0;
    for (std::size_t c = 0; c < findings.entering.size(); ++c) {
        std::vector<int>& rows = findings.entering[c];
        for (int k = 0; k < kept; ++k) {
            const Candidate& candidate = column_best_[c * kept + static_cast<std::size_t>(k)];
            if (candidate.place >= 0) rows.push_back(static_cast<int>(candidate.place));
        }
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        pairs += static_cast<std::int64_t>(rows.size());
    }
    findings.entering_pairs = all_sum(comm_, pairs);
    return findings;
}

}  // namespace coseg
