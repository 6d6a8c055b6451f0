#include "solvers/mesh_scope/mesh_scope_pass.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "solvers/mesh_scope/mesh_scope_kernel.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/numeric/pair_score_kernel.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

MeshOrder sort_by_mesh(const std::vector<int>& mesh_of) {
    MeshOrder meshes;
    meshes.order.resize(mesh_of.size());
    std::iota(meshes.order.begin(), meshes.order.end(), 0);
    const auto mesh = [&](int i) { return mesh_of[at(i)]; };
    std::stable_sort(meshes.order.begin(), meshes.order.end(),
                     [&](int a, int b) { return mesh(a) < mesh(b); });
    meshes.place.resize(mesh_of.size());
    for (std::size_t p = 0; p < meshes.order.size(); ++p) {
        const int i = meshes.order[p];
        meshes.place[at(i)] = static_cast<int>(p);
        if (meshes.group_mesh.empty() || meshes.group_mesh.back() != mesh(i)) {
            meshes.group_begin.push_back(static_cast<int>(p));
            meshes.group_mesh.push_back(mesh(i));
        }
        meshes.group_of.push_back(static_cast<int>(meshes.group_mesh.size()) - 1);
    }
    meshes.group_begin.push_back(static_cast<int>(mesh_of.size()));
    return meshes;
}

/// The state of a column while its rows are scored one after the other.
struct MeshScopePass::Survey {
    const PassColumn* column = nullptr;
    int own_group = 0;
    bool shifts = false;           ///< whether the shifted bound is worth its work
    std::size_t next_working = 0;  ///< the first working row not yet passed
    double relative_error = 0.0;   ///< of ||(x_hi . u_hj - beta)_+||
    double absolute_error = 0.0;   ///< likewise, on top
    std::vector<GroupLeaders> leaders;
    std::vector<double> largest2;  ///< per group: largest squared norm of all its rows
    std::vector<double> shift;     ///< per feature
    int group = -1;                ///< the group whose rows are being looked at
    double limit = 0.0;            ///< of the norms of its rows that are not in the working set
    double shift2 = 0.0;           ///< squares above it may need a shift
    double second2 = 0.0;          ///< square of the second of its leaders

    [[nodiscard]] double at_most(double norm) const { return norm * (1.0 + relative_error) + absolute_error; }
    [[nodiscard]] double at_least(double norm) const {
        return std::max(norm * (1.0 - relative_error) - absolute_error, 0.0);
    }
    void begin_group(int next, const ColumnPenalties& penalties) {
        group = next;
        limit = penalties.alpha + 2.0 * penalties.lambda * column->group_sums[at(next)];
        shift2 = shifts ? std::pow(at_least(limit), 2) : std::numeric_limits<double>::infinity();
        second2 = 0.0;
    }
    /// Squares at or below it change nothing.
    [[nodiscard]] double threshold() const { return std::min(second2, shift2); }
};

/// The scores x_hi . u_hj of one column for the rows from `begin` on, feature h's values `stride` apart.
template <class Real>
struct MeshScopePass::Scores {
    int begin = 0;
    const Real* values = nullptr;
    std::int64_t stride = 0;
};

MeshScopePass::MeshScopePass(const Comm& comm, const FeatureStack& stack, const MeshOrder& meshes,
                             const ColumnPenalties& penalties, const PairScorerFactory& scorer)
    : stack_(stack),
      meshes_(meshes),
      penalties_(penalties),
      panels_(comm, stack, meshes.group_begin),
      scorer_(scorer(stack, panels_)),
      prices_(at(stack.features) * at(panels_.count()) * panel_rows, static_cast<float>(penalties.beta)),
      largest_norm_(stack.largest_norms()) {
    scorer_->set_prices(prices_);
}

/// Writes the dual u = 2 (x - z) of the column, D values.
MeshScopePass::Survey MeshScopePass::start_survey(const PassColumn& column, double rounding,
                                                  double* dual) const {
    Survey survey;
    survey.column = &column;
    survey.own_group = meshes_.group_of[at(column.working->column)];
    survey.shifts = shift_pays(stack_, penalties_);
    survey.leaders.resize(meshes_.group_mesh.size());
    survey.largest2.assign(meshes_.group_mesh.size(), 0.0);
    survey.shift.assign(at(stack_.features), 0.0);
    const double* target =
        stack_.columns.data() + static_cast<std::int64_t>(column.working->column) * stack_.dimension;
    for (int k = 0; k < stack_.dimension; ++k) dual[k] = 2.0 * (target[k] - column.reconstruction[k]);
    double squares = 0.0;
    for (int h = 0; h < stack_.features; ++h) {
        double dual2 = 0.0;
        for (int k = stack_.offset[at(h)]; k < stack_.offset[at(h) + 1]; ++k) dual2 += dual[k] * dual[k];
        const double terms = (stack_.rows_of(h) + 6) * largest_norm_[at(h)];
        squares += dual2 * terms * terms;
    }
    // gamma_n of an inner product of n terms for each feature, two roundings of its factors and slack; beta
    // is rounded too.
    survey.absolute_error = rounding * (std::sqrt(squares) + 4.0 * penalties_.beta) * (1.0 + 1e-3);
    survey.relative_error = rounding * (stack_.features + 6);
    return survey;
}

std::vector<MeshScopePass::Survey> MeshScopePass::start_surveys(const std::vector<PassColumn>& columns,
                                                                double rounding,
                                                                Eigen::MatrixXd& duals) const {
    duals.resize(stack_.dimension, static_cast<Eigen::Index>(columns.size()));
    std::vector<Survey> surveys;
    for (std::size_t c = 0; c < columns.size(); ++c)
        surveys.push_back(start_survey(columns[c], rounding, duals.col(static_cast<Eigen::Index>(c)).data()));
    return surveys;
}

/// A row of the survey's group; rows come in ascending order.
template <class Real>
void MeshScopePass::look_at_row(Survey& survey, int row, double square, const Scores<Real>& scores) const {
    if (square <= survey.threshold()) return;
    const auto g = at(survey.group);
    GroupLeaders& leaders = survey.leaders[g];
    const std::vector<int>& working = survey.column->working->rows;
    survey.largest2[g] = std::max(survey.largest2[g], square);
    if (square > survey.shift2) require_shift(survey, row, std::sqrt(square), survey.limit, scores);
    while (survey.next_working < working.size() && working[survey.next_working] < row) ++survey.next_working;
    const bool works = survey.next_working < working.size() && working[survey.next_working] == row;
    if (works || square <= survey.second2) return;
    const bool first = std::sqrt(square) > leaders.norm[0];
    if (first) {
        leaders.row[1] = leaders.row[0];
        leaders.norm[1] = leaders.norm[0];
    }
    leaders.row[first ? 0 : 1] = row;
    leaders.norm[first ? 0 : 1] = std::sqrt(square);
    survey.second2 = leaders.norm[1] * leaders.norm[1];
}

/// u - shift 1 must bring this pair's norm down to `limit`.
template <class Real>
void MeshScopePass::require_shift(Survey& survey, int row, double norm, double limit,
                                  const Scores<Real>& scores) const {
    const double largest = survey.at_most(norm);
    if (largest <= limit) return;
    for (int h = 0; h < stack_.features; ++h) {
        const auto score = static_cast<double>(scores.values[h * scores.stride + (row - scores.begin)]);
        const double excess = std::max(score - penalties_.beta, 0.0) + survey.absolute_error;
        const double needed = excess * (1.0 - limit / largest) * (1.0 + survey.relative_error);
        double& shift = survey.shift[at(h)];
        shift = std::max(shift, needed / stack_.entry_sum(h, row));
    }
}

/// The panel stands at `place` among the scores.
void MeshScopePass::look_at_panel(std::vector<Survey>& surveys, int group, int panel, int place) {
    const int begin = panels_.first_row(panel);
    const std::uint64_t used = panels_.row_bits(panel);
    for (std::size_t c = 0; c < surveys.size(); ++c) {
        Survey& survey = surveys[c];
        if (group == survey.own_group) continue;
        const auto column = static_cast<int>(c);
        const float* squares = scores_.squares(place, column);
        // Rounded down, so that no row is left out that the exact comparison would keep.
        const auto threshold = static_cast<float>(survey.threshold() * (1.0 - 4.0 * single_rounding));
        std::uint64_t above = 0;
        find_above(squares, 1, threshold, &above);
        for (above &= used; above != 0; above &= above - 1) {
            const int r = std::countr_zero(above);
            look_at_row<float>(survey, begin + r, static_cast<double>(squares[r]),
                               {begin, scores_.scores(place, 0, column), scores_.feature_stride()});
        }
    }
}

void MeshScopePass::score_panels(std::vector<Survey>& surveys, int group) {
    score_in_batches(*scorer_, panels_.first_panel(group), panels_.first_panel(group + 1), scores_,
                     [&](int panel, int place) { look_at_panel(surveys, group, panel, place); });
}

void MeshScopePass::score_in_double(std::vector<Survey>& surveys, int group, const Eigen::MatrixXd& duals) {
    const int begin = meshes_.group_begin[at(group)];
    const int rows = meshes_.group_begin[at(group) + 1] - begin;
    const auto width = static_cast<int>(surveys.size());
    const std::int64_t stride = static_cast<std::int64_t>(rows) * width;
    exact_scores_.resize(at(stride) * at(stack_.features));
    for (int h = 0; h < stack_.features; ++h) {
        const int height = stack_.rows_of(h);
        const double* first = stack_.feature(h) + static_cast<std::int64_t>(begin) * stack_.dimension;
        multiply_transposed({first, height, rows, stack_.dimension},
                            {duals.data() + stack_.offset[at(h)], height, width, stack_.dimension}, 0.0,
                            {exact_scores_.data() + h * stride, rows, width, rows});
    }
    for (int c = 0; c < width; ++c) {
        Survey& survey = surveys[at(c)];
        if (group == survey.own_group) continue;
        const Scores<double> scores{begin, exact_scores_.data() + static_cast<std::int64_t>(c) * rows,
                                    stride};
        exact_squares_.assign(at(rows), 0.0);
        for (int h = 0; h < stack_.features; ++h)
            add_excess_squares(scores.values + h * stride, penalties_.beta, at(rows), exact_squares_.data());
        for (int r = 0; r < rows; ++r) look_at_row(survey, begin + r, exact_squares_[at(r)], scores);
    }
}

ColumnVerdict MeshScopePass::finish_survey(Survey& survey) const {
    double squares = 0.0;
    double shifted = 0.0;
    for (std::size_t h = 0; h < survey.shift.size(); ++h) {
        for (int k = stack_.offset[h]; k < stack_.offset[h + 1]; ++k) {
            const double z = survey.column->reconstruction[k];
            squares += z * z;
            shifted += (z + 0.5 * survey.shift[h]) * (z + 0.5 * survey.shift[h]);
        }
    }
    double raised = squares;
    for (std::size_t g = 0; g < survey.largest2.size(); ++g) {
        const double sum = survey.column->group_sums[g];
        shifted += penalties_.lambda * sum * sum;
        if (static_cast<int>(g) == survey.own_group) continue;
        const double price = survey.at_most(std::sqrt(survey.largest2[g])) - penalties_.alpha;
        if (price > 0.0) raised += price * price / (4.0 * penalties_.lambda);
    }
    const double up =
        1.0 + stack_.inner_product_error() + 4.0 * epsilon * static_cast<double>(survey.largest2.size());
    return {std::move(survey.leaders), (survey.shifts ? std::min(raised, shifted) : raised) * up};
}

std::vector<ColumnVerdict> MeshScopePass::finish_surveys(std::vector<Survey>& surveys) const {
    std::vector<ColumnVerdict> verdicts;
    for (Survey& survey : surveys) verdicts.push_back(finish_survey(survey));
    return verdicts;
}

std::vector<ColumnVerdict> MeshScopePass::single_precision(const std::vector<PassColumn>& columns,
                                                           const std::vector<int>& allowed) {
    Eigen::MatrixXd duals;
    std::vector<Survey> surveys = start_surveys(columns, single_rounding, duals);
    const std::vector<double> errors(at(stack_.features), 0.0);
    single_duals_.reset(stack_, static_cast<int>(columns.size()));
    for (Eigen::Index c = 0; c < duals.cols(); ++c)
        single_duals_.set(static_cast<int>(c), duals.col(c).data(), errors.data());
    scorer_->set_columns(single_duals_);
    scores_.resize(scorer_->batch_panels(), stack_.features, single_duals_.columns());
    for (const int group : allowed) {
        for (Survey& survey : surveys) survey.begin_group(group, penalties_);
        score_panels(surveys, group);
    }
    return finish_surveys(surveys);
}

std::vector<ColumnVerdict> MeshScopePass::double_precision(const std::vector<PassColumn>& columns,
                                                           const std::vector<int>& allowed) {
    Eigen::MatrixXd duals;
    std::vector<Survey> surveys = start_surveys(columns, 0.5 * epsilon, duals);
    for (const int group : allowed) {
        for (Survey& survey : surveys) survey.begin_group(group, penalties_);
        score_in_double(surveys, group, duals);
    }
    return finish_surveys(surveys);
}

}  // namespace coseg
