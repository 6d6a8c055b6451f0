#include "solvers/mesh_scope/mesh_scope_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/mesh_scope/mesh_scope_kernel.hpp"
#include "solvers/numeric/blas.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int chunk_rows = 1024;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct RowRun {
    int begin, end;
};

/// The rows of the allowed groups as runs of at most chunk_rows; a function of the groups alone.
std::vector<RowRun> row_runs(const MeshOrder& meshes, const std::vector<int>& allowed) {
    std::vector<RowRun> merged;
    for (const int g : allowed) {
        const auto gs = at(g);
        const RowRun group{meshes.group_begin[gs], meshes.group_begin[gs + 1]};
        if (!merged.empty() && merged.back().end == group.begin) {
            merged.back().end = group.end;
        } else {
            merged.push_back(group);
        }
    }
    std::vector<RowRun> runs;
    for (const RowRun& run : merged) {
        for (int begin = run.begin; begin < run.end; begin += chunk_rows) {
            runs.push_back({begin, std::min(begin + chunk_rows, run.end)});
        }
    }
    return runs;
}

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

    [[nodiscard]] double at_most(double norm) const { return norm * (1.0 + relative_error) + absolute_error; }
    [[nodiscard]] double at_least(double norm) const {
        return std::max(norm * (1.0 - relative_error) - absolute_error, 0.0);
    }
};

/// The scores x_hi . u_hj of one column for the rows [begin, end), feature h's values `stride` apart.
template <class Real>
struct MeshScopePass::Scores {
    int begin = 0, end = 0;
    const Real* values = nullptr;
    std::int64_t stride = 0;
};

MeshScopePass::MeshScopePass(const Comm& comm, const FeatureStack& stack, const MeshOrder& meshes,
                             const ColumnPenalties& penalties)
    : stack_(stack), meshes_(meshes), penalties_(penalties), single_columns_(comm, stack) {
    for (int h = 0; h < stack.features; ++h) {
        double largest = 0.0;
        for (Eigen::Index i = 0; i < stack.size; ++i) largest = std::max(largest, stack.norm(h, i));
        largest_norm_.push_back(largest);
    }
}

MeshScopePass::Survey MeshScopePass::start_survey(const PassColumn& column, double rounding) const {
    Survey survey;
    survey.column = &column;
    survey.own_group = meshes_.group_of[at(column.working->column)];
    survey.shifts = shift_pays(stack_, penalties_);
    survey.leaders.resize(meshes_.group_mesh.size());
    survey.largest2.assign(meshes_.group_mesh.size(), 0.0);
    survey.shift.assign(at(stack_.features), 0.0);
    const double* target =
        stack_.columns.data() + static_cast<std::int64_t>(column.working->column) * stack_.dimension;
    double squares = 0.0;
    for (std::size_t h = 0; h < survey.shift.size(); ++h) {
        double residual2 = 0.0;
        for (int k = stack_.offset[h]; k < stack_.offset[h + 1]; ++k) {
            const double residual = 2.0 * (target[k] - column.reconstruction[k]);
            residual2 += residual * residual;
        }
        squares += residual2 * largest_norm_[h] * largest_norm_[h];
    }
    // gamma_n of an inner product of n terms, two roundings of its factors and slack; beta is rounded too.
    survey.absolute_error =
        rounding * ((stack_.dimension + 6) * std::sqrt(squares) + 4.0 * penalties_.beta) * (1.0 + 1e-3);
    survey.relative_error = rounding * (stack_.features + 6);
    return survey;
}

template <class Real>
void MeshScopePass::score_rows(Survey& survey, const Scores<Real>& scores) {
    const auto count = at(scores.end - scores.begin);
    const Real beta = static_cast<Real>(penalties_.beta);
    std::vector<Real>& squares = std::get<std::vector<Real>>(squares_);
    squares.assign(count, Real{0});
    for (int h = 0; h < stack_.features; ++h) {
        const Real* score = scores.values + h * scores.stride;
        add_excess_squares(score, beta, count, squares.data());
    }
    for (int i = scores.begin; i < scores.end;) {
        const int g = meshes_.group_of[at(i)];
        const int stop = std::min(scores.end, meshes_.group_begin[at(g) + 1]);
        if (g != survey.own_group) score_group(survey, g, i, stop, squares.data(), scores);
        i = stop;
    }
}

/// Rows [begin, end) of one group.
template <class Real>
void MeshScopePass::score_group(Survey& survey, int group, int begin, int end, const Real* squares,
                                const Scores<Real>& scores) {
    const auto g = at(group);
    GroupLeaders& leaders = survey.leaders[g];
    const std::vector<int>& working = survey.column->working->rows;
    const double limit = penalties_.alpha + 2.0 * penalties_.lambda * survey.column->group_sums[g];
    const double never = std::numeric_limits<double>::infinity();
    const double shift2 = survey.shifts ? std::pow(survey.at_least(limit), 2) : never;
    double second2 = leaders.norm[1] * leaders.norm[1];
    for (int i = begin; i < end; ++i) {
        const double square = static_cast<double>(squares[i - scores.begin]);
        if (square <= second2 && square <= shift2) continue;
        survey.largest2[g] = std::max(survey.largest2[g], square);
        if (square > shift2) require_shift(survey, i, std::sqrt(square), limit, scores);
        while (survey.next_working < working.size() && working[survey.next_working] < i)
            ++survey.next_working;
        const bool works = survey.next_working < working.size() && working[survey.next_working] == i;
        if (works || square <= second2) continue;
        const bool first = std::sqrt(square) > leaders.norm[0];
        if (first) {
            leaders.row[1] = leaders.row[0];
            leaders.norm[1] = leaders.norm[0];
        }
        leaders.row[first ? 0 : 1] = i;
        leaders.norm[first ? 0 : 1] = std::sqrt(square);
        second2 = leaders.norm[1] * leaders.norm[1];
    }
}

/// u - shift 1 must bring this pair's norm down to `limit`.
template <class Real>
void MeshScopePass::require_shift(Survey& survey, int row, double norm, double limit,
                                  const Scores<Real>& scores) {
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

template <class Real>
std::vector<ColumnVerdict> MeshScopePass::survey_all(const std::vector<PassColumn>& columns,
                                                     const std::vector<int>& allowed, const Real* stacked) {
    const int width = static_cast<int>(columns.size());
    const int rows = stack_.dimension;
    std::vector<Survey> surveys;
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> duals(rows, width);
    for (int c = 0; c < width; ++c) {
        const PassColumn& column = columns[at(c)];
        surveys.push_back(
            start_survey(column, 0.5 * static_cast<double>(std::numeric_limits<Real>::epsilon())));
        for (int k = 0; k < rows; ++k) {
            duals(k, c) = static_cast<Real>(
                2.0 * (stack_.columns(k, column.working->column) - column.reconstruction[k]));
        }
    }
    std::vector<Real> buffer(at(chunk_rows * width * stack_.features));
    const std::int64_t stride = static_cast<std::int64_t>(chunk_rows) * width;
    for (const RowRun& run : row_runs(meshes_, allowed)) {
        for (int h = 0; h < stack_.features; ++h) {
            const int from = stack_.offset[at(h)];
            const int height = stack_.rows_of(h);
            const int run_rows = run.end - run.begin;
            const Real* first = stacked + static_cast<std::int64_t>(run.begin) * rows + from;
            multiply_transposed({first, height, run_rows, rows}, {duals.data() + from, height, width, rows},
                                Real{0}, {buffer.data() + h * stride, run_rows, width, chunk_rows});
        }
        for (int c = 0; c < width; ++c) {
            score_rows<Real>(
                surveys[at(c)],
                {run.begin, run.end, buffer.data() + static_cast<std::int64_t>(c) * chunk_rows, stride});
        }
    }
    std::vector<ColumnVerdict> verdicts;
    for (Survey& survey : surveys) verdicts.push_back(finish_survey(survey));
    return verdicts;
}

std::vector<ColumnVerdict> MeshScopePass::single_precision(const std::vector<PassColumn>& columns,
                                                           const std::vector<int>& allowed) {
    return survey_all<float>(columns, allowed, single_columns_.data());
}

std::vector<ColumnVerdict> MeshScopePass::double_precision(const std::vector<PassColumn>& columns,
                                                           const std::vector<int>& allowed) {
    return survey_all<double>(columns, allowed, stack_.columns.data());
}

}  // namespace coseg
