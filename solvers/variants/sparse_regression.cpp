#include "solvers/variants/sparse_regression.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/numeric/blas.hpp"
#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/row_scope_column.hpp"
#include "src/base/index.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

constexpr int chunk_rows = 1024;
constexpr int entering_at_once = 16;
constexpr int sweeps_between_checks = 4;
constexpr std::size_t largest_support = 400;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Gaps below this share of a column's squared norm are rounding.
constexpr double negligible = 1e-15;

/// The state of a column that is being solved: its working set with a Gram matrix of its own, its point and
/// both ends of its gap.
struct Column {
    int column = 0;
    std::vector<int> rows;  ///< in the order in which they entered
    std::vector<double> weights;
    std::vector<std::vector<double>> gram;  ///< row by row of the lower triangle
    std::vector<double> linear;             ///< x_i . x_j
    std::vector<double> residual;           ///< x_j - X w
    double squared_norm = 0.0;
    double objective = 0.0;
    double lower_bound = 0.0;
    double inner_change = 1e-3;  ///< the sweeps end when no step decreases by more than this share of the gap
    int sweeps = 0;
    bool open = true;
    bool limited = false;
    bool stalled = false;
    std::vector<ColumnRound> rounds;
};

/// A row outside the working set of a column that violates optimality.
struct Pull {
    double strength = 0.0;
    int row = -1;
};

/// The findings of a pass over all rows for one column.
struct Survey {
    double strongest = 0.0;  ///< max over all rows of x_i . r, of its magnitude where the sign is free
    double shift = 0.0;      ///< max over all rows of (2 x_i . r - beta)_+ / sum of x_i
    std::vector<Pull> pulls;
};

class SparseRegression {
  public:
    SparseRegression(const SubspaceProblem& problem, Sign sign, const SolveOptions& options)
        : stack_(stack_features(problem)), beta_(problem.beta), sign_(sign), options_(options) {}

    std::vector<Column> solve_tile(std::int64_t begin, std::int64_t end);
    [[nodiscard]] const FeatureStack& stack() const noexcept { return stack_; }
    [[nodiscard]] int passes() const noexcept { return passes_; }
    [[nodiscard]] bool timed_out() const noexcept { return timed_out_; }

  private:
    [[nodiscard]] Column start_column(int column) const;
    [[nodiscard]] std::vector<Survey> look(const std::vector<Column*>& columns) const;
    void inspect(const Column& column, int row, double score, Survey& survey) const;
    void judge(Column& column, const Survey& survey) const;
    bool enter(Column& column, const Survey& survey) const;
    double descend(Column& column, std::vector<double>& gradient) const;
    bool solve_support(Column& column, std::vector<double>& gradient) const;
    void solve_inside(Column& column) const;
    void measure(Column& column) const;
    [[nodiscard]] double pull_of(double score) const { return sign_ == Sign::free ? std::abs(score) : score; }
    [[nodiscard]] double tolerance(const Column& column) const {
        return std::max(options_.gap * std::max(column.objective, 1e-6 * column.squared_norm),
                        negligible * column.squared_norm);
    }

    FeatureStack stack_;
    double beta_;
    Sign sign_;
    const SolveOptions& options_;
    Stopwatch clock_;
    int passes_ = 0;
    bool timed_out_ = false;
};

Column SparseRegression::start_column(int column) const {
    Column start;
    start.column = column;
    const double* x = stack_.columns.data() + static_cast<std::int64_t>(column) * stack_.dimension;
    start.residual.assign(x, x + stack_.dimension);
    for (const double value : start.residual) start.squared_norm += value * value;
    start.objective = start.squared_norm;
    return start;
}

void SparseRegression::inspect(const Column& column, int row, double score, Survey& survey) const {
    if (row == column.column) return;
    const double pull = pull_of(score);
    survey.strongest = std::max(survey.strongest, pull);
    const double excess = 2.0 * pull - beta_;
    if (excess <= 0.0) return;
    survey.shift = std::max(survey.shift, excess / stack_.entry_sum(0, row));
    if (survey.pulls.size() == entering_at_once && pull <= survey.pulls.back().strength) return;
    if (std::find(column.rows.begin(), column.rows.end(), row) != column.rows.end()) return;
    if (survey.pulls.size() == entering_at_once) survey.pulls.pop_back();
    const auto place = std::find_if(survey.pulls.begin(), survey.pulls.end(),
                                    [&](const Pull& p) { return p.strength < pull; });
    survey.pulls.insert(place, {pull, row});
}

/// Scores of all rows against the residuals, as blocked matrix products.
std::vector<Survey> SparseRegression::look(const std::vector<Column*>& columns) const {
    const int width = static_cast<int>(columns.size());
    const int dimension = stack_.dimension;
    std::vector<double> residuals;
    for (const Column* column : columns)
        residuals.insert(residuals.end(), column->residual.begin(), column->residual.end());
    std::vector<double> scores(at(chunk_rows) * columns.size());
    std::vector<Survey> surveys(columns.size());
    for (int begin = 0; begin < stack_.size; begin += chunk_rows) {
        const int end = std::min(begin + chunk_rows, stack_.size);
        const double* chunk = stack_.columns.data() + static_cast<std::int64_t>(begin) * dimension;
        multiply_transposed({chunk, dimension, end - begin, dimension},
                            {residuals.data(), dimension, width, dimension}, 0.0,
                            {scores.data(), end - begin, width, chunk_rows});
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const double* score = scores.data() + c * chunk_rows;
            for (int i = begin; i < end; ++i) inspect(*columns[c], i, score[i - begin], surveys[c]);
        }
    }
    return surveys;
}

/// The lower bound: <u, x> - ||u||^2 / 4 for a dual u with x_i . u <= beta for every row i.
void SparseRegression::judge(Column& column, const Survey& survey) const {
    const double* x = stack_.columns.data() + static_cast<std::int64_t>(column.column) * stack_.dimension;
    double squares = 0.0, product = 0.0;
    for (std::size_t k = 0; k < column.residual.size(); ++k) {
        squares += column.residual[k] * column.residual[k];
        product += column.residual[k] * x[k];
    }
    const double error = stack_.inner_product_error();
    const double strongest =
        std::max(survey.strongest, 0.0) + error * std::sqrt(squares * stack_.largest_inner) * (1.0 + error);
    // u = 2 s r: the best s is product / squares, the largest feasible one beta / (2 strongest).
    const double most = strongest > 0.0 ? beta_ / (2.0 * strongest) : 1.0;
    const double s = squares > 0.0 ? std::clamp(product / squares, 0.0, most) : 0.0;
    double bound = 2.0 * s * product - s * s * squares;
    if (sign_ == Sign::nonnegative) {
        // u = 2 r - tau 1, tau so large that every row is feasible.
        const double rounding = 2.0 * error * std::sqrt(squares * stack_.largest_inner);
        double least_sum = std::numeric_limits<double>::infinity();
        if (rounding > 0.0) {
            for (Eigen::Index i = 0; i < stack_.size; ++i)
                least_sum = std::min(least_sum, stack_.entry_sum(0, i));
        }
        const double tau = (survey.shift + rounding / least_sum) * (1.0 + 4.0 * epsilon);
        double shifted = 0.0;
        for (std::size_t k = 0; k < column.residual.size(); ++k) {
            const double u = 2.0 * column.residual[k] - tau;
            shifted += u * (x[k] - 0.25 * u);
        }
        bound = std::max(bound, shifted);
    }
    bound -= 8.0 * error * column.squared_norm;
    column.lower_bound = std::max(column.lower_bound, bound);
    if (column.objective - column.lower_bound <= tolerance(column)) column.open = false;
}

bool SparseRegression::enter(Column& column, const Survey& survey) const {
    for (const Pull& pull : survey.pulls) {
        const double* x = stack_.columns.data() + static_cast<std::int64_t>(pull.row) * stack_.dimension;
        column.rows.push_back(pull.row);
        column.weights.push_back(0.0);
        std::vector<double> products;
        for (const int row : column.rows) {
            double product = 0.0;
            feature_products(stack_, row, x, &product);
            products.push_back(product);
        }
        column.gram.push_back(std::move(products));
        double linear = 0.0;
        feature_products(stack_, column.column, x, &linear);
        column.linear.push_back(linear);
    }
    return !survey.pulls.empty();
}

/// One sweep over the working set; `gradient` is x_i . r of its rows. Returns the largest decrease of a step.
double SparseRegression::descend(Column& column, std::vector<double>& gradient) const {
    double largest = 0.0;
    const std::size_t count = column.rows.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double curvature = column.gram[i][i];
        const double target = gradient[i] + curvature * column.weights[i];
        double next = std::max(std::abs(target) - 0.5 * beta_, 0.0) / curvature;
        if (target < 0.0) next = sign_ == Sign::free ? -next : 0.0;
        const double change = next - column.weights[i];
        if (change == 0.0) continue;
        column.weights[i] = next;
        for (std::size_t k = 0; k < i; ++k) gradient[k] -= change * column.gram[i][k];
        for (std::size_t k = i; k < count; ++k) gradient[k] -= change * column.gram[k][i];
        largest = std::max(largest, change * change * curvature);
    }
    return largest;
}

/// Moves to the minimum on the support with its signs, or as far towards it as the signs hold. Where columns
/// are alike, sweeps alone make little progress. Returns false once the support no longer changes.
bool SparseRegression::solve_support(Column& column, std::vector<double>& gradient) const {
    std::vector<std::size_t> support;
    for (std::size_t i = 0; i < column.weights.size(); ++i) {
        if (column.weights[i] != 0.0) support.push_back(i);
    }
    if (support.empty() || support.size() > largest_support) return false;
    const auto size = static_cast<Eigen::Index>(support.size());
    Eigen::MatrixXd gram(size, size);
    Eigen::VectorXd slope(size);
    for (Eigen::Index a = 0; a < size; ++a) {
        const std::size_t i = support[at(a)];
        slope(a) = gradient[i] - std::copysign(0.5 * beta_, column.weights[i]);
        for (Eigen::Index b = 0; b <= a; ++b) gram(a, b) = gram(b, a) = column.gram[i][support[at(b)]];
    }
    Eigen::VectorXd step = gram.completeOrthogonalDecomposition().solve(slope);
    const Eigen::VectorXd flat = slope - gram * step;
    // Columns may be dependent. In directions that the Gram matrix maps to 0, the penalty alone decides, up
    // to a change of sign.
    const bool is_flat = flat.norm() > 1e-7 * (slope.norm() + beta_);
    if (is_flat) step = flat;
    if (!step.allFinite() || !(step.dot(slope) > 0.0)) return false;
    double length = is_flat ? std::numeric_limits<double>::infinity() : 1.0;
    Eigen::Index first = -1;
    for (Eigen::Index a = 0; a < size; ++a) {
        const double ratio = -column.weights[support[at(a)]] / step(a);
        if (ratio > 0.0 && ratio < length) {
            length = ratio;
            first = a;
        }
    }
    if (!std::isfinite(length)) return false;
    for (Eigen::Index a = 0; a < size; ++a) {
        const std::size_t i = support[at(a)];
        const double change = a == first ? -column.weights[i] : length * step(a);
        column.weights[i] = a == first ? 0.0 : column.weights[i] + change;
        for (std::size_t k = 0; k < gradient.size(); ++k)
            gradient[k] -= change * (k < i ? column.gram[i][k] : column.gram[k][i]);
    }
    return first >= 0;
}

void SparseRegression::measure(Column& column) const {
    const double* x = stack_.columns.data() + static_cast<std::int64_t>(column.column) * stack_.dimension;
    column.residual.assign(x, x + stack_.dimension);
    double penalty = 0.0;
    for (std::size_t p = 0; p < column.rows.size(); ++p) {
        const double w = column.weights[p];
        if (w == 0.0) continue;
        penalty += beta_ * std::abs(w);
        const double* y =
            stack_.columns.data() + static_cast<std::int64_t>(column.rows[p]) * stack_.dimension;
        for (std::size_t k = 0; k < column.residual.size(); ++k) column.residual[k] -= w * y[k];
    }
    double squares = 0.0;
    for (const double value : column.residual) squares += value * value;
    column.objective = squares + penalty;
}

void SparseRegression::solve_inside(Column& column) const {
    std::vector<double> gradient(column.rows.size());
    for (std::size_t i = 0; i < gradient.size(); ++i)
        feature_products(stack_, column.rows[i], column.residual.data(), &gradient[i]);
    const double gap = std::max(column.objective - column.lower_bound, tolerance(column));
    while (true) {
        double largest = 0.0;
        for (int sweep = 0; sweep < sweeps_between_checks; ++sweep) largest = descend(column, gradient);
        column.sweeps += sweeps_between_checks;
        for (std::size_t turn = 0; turn < largest_support && solve_support(column, gradient);) ++turn;
        if (largest <= column.inner_change * gap || largest <= epsilon * epsilon * column.squared_norm) break;
        if (column.sweeps >= options_.max_iterations) {
            column.limited = true;
            break;
        }
        if (clock_.seconds() >= options_.max_seconds) break;
    }
    measure(column);
}

std::vector<Column> SparseRegression::solve_tile(std::int64_t begin, std::int64_t end) {
    std::vector<Column> columns;
    for (std::int64_t j = begin; j < end; ++j) columns.push_back(start_column(static_cast<int>(j)));
    std::vector<Column*> open;
    for (Column& column : columns) open.push_back(&column);
    int passes = 0;
    while (!open.empty()) {
        const std::vector<Survey> surveys = look(open);
        ++passes;
        for (std::size_t c = 0; c < open.size(); ++c) {
            Column& column = *open[c];
            judge(column, surveys[c]);
            append_round(column.rounds, {column.objective, column.lower_bound, column.sweeps,
                                         static_cast<std::int64_t>(column.rows.size())});
            if (!column.open) continue;
            if (column.limited || timed_out_) {
                column.open = false;
            } else {
                if (!enter(column, surveys[c])) column.inner_change *= 0.01;
                column.stalled = column.inner_change < 1e-24;
                if (column.stalled) column.open = false;
                solve_inside(column);
            }
        }
        timed_out_ = timed_out_ || clock_.seconds() >= options_.max_seconds;
        std::erase_if(open, [](const Column* column) { return !column->open; });
    }
    passes_ = std::max(passes_, passes);
    return columns;
}

void append_column(const Column& column, SparseCoefficients& sparse) {
    std::vector<std::pair<int, double>> entries;
    for (std::size_t p = 0; p < column.rows.size(); ++p) {
        if (column.weights[p] != 0.0) entries.emplace_back(column.rows[p], column.weights[p]);
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [row, weight] : entries) {
        sparse.rows.push_back(row);
        sparse.values.push_back(weight);
    }
    sparse.offsets.push_back(static_cast<std::int64_t>(sparse.rows.size()));
}

struct Totals {
    int sweeps = 0;
    bool limited = false;
    std::int64_t working_pairs = 0;
    std::vector<std::vector<ColumnRound>> rounds;  ///< per tile
};

StopReason reason_of(const Comm& comm, const Totals& totals, bool timed_out) {
    if (any_rank(comm, timed_out)) return StopReason::time_limit;
    return any_rank(comm, totals.limited) ? StopReason::iteration_limit : StopReason::residual_reached;
}

double gap_of(double objective, double lower_bound, double objective_at_zero) {
    return relative_gap(objective - lower_bound, gap_scale(PenaltyScope::rows, objective, objective_at_zero),
                        objective_at_zero);
}

/// Collective. The last row is the answer's own.
void finish_history(const Comm& comm, const std::vector<std::vector<ColumnRound>>& tiles,
                    SolveResult& result) {
    for (const ColumnRound& round : joined_rounds(comm, tiles)) {
        const double bound = std::min(round.bound, round.reached);
        result.history.push_back(
            {static_cast<int>(result.history.size()) + 1, round.iterations, round.reached, bound,
             gap_of(round.reached, bound, result.objective_at_zero), round.working_pairs});
    }
    HistoryRow& last = result.history.back();
    last = {result.passes,      result.iterations,   result.objective,
            result.lower_bound, result.relative_gap, result.working_pairs};
}

}  // namespace

SolveResult solve_sparse_regression(const Comm& comm, const SubspaceProblem& problem, Sign sign,
                                    const SolveOptions& options) {
    SparseRegression solver(problem, sign, options);
    SolveResult result;
    const BlockRange owned = block_range(problem.size(), comm.size(), comm.rank(), coefficient_tile);
    result.coefficients = {problem.size(), owned, 1, {0}, {}, {}};
    ExactSum sums(2);
    Totals totals;
    for (std::int64_t begin = owned.begin; begin < owned.end; begin += coefficient_tile) {
        std::vector<std::vector<ColumnRound>> rounds;
        for (const Column& column : solver.solve_tile(begin, std::min(begin + coefficient_tile, owned.end))) {
            rounds.push_back(column.rounds);
            sums.add_scalar(0, column.objective);
            sums.add_scalar(1, column.lower_bound);
            append_column(column, result.coefficients);
            totals.sweeps = std::max(totals.sweeps, column.sweeps);
            totals.limited = totals.limited || column.limited;
            totals.working_pairs += static_cast<std::int64_t>(column.rows.size());
        }
        totals.rounds.push_back(joined_rounds(rounds));
    }
    sums.reduce(comm);
    result.objective_at_zero = solver.stack().squared_norm;
    result.objective = sums.scalar(0);
    result.lower_bound = std::min(sums.scalar(1), result.objective);
    result.relative_gap = gap_of(result.objective, result.lower_bound, result.objective_at_zero);
    result.iterations = all_max(comm, totals.sweeps);
    result.passes = all_max(comm, solver.passes());
    result.working_pairs = all_sum(comm, totals.working_pairs);
    result.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(result.coefficients.rows.size()));
    finish_history(comm, totals.rounds, result);
    const StopReason otherwise = reason_of(comm, totals, solver.timed_out());
    result.reason = result.relative_gap <= options.gap ? StopReason::gap_reached : otherwise;
    return result;
}

}  // namespace coseg
