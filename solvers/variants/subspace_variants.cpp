#include "solvers/variants/subspace_variants.hpp"

#include <algorithm>
#include <map>

#include "solvers/numeric/blas.hpp"
#include "solvers/variants/sparse_regression.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// All of `problem` but its features.
SubspaceProblem without_features(const SubspaceProblem& problem) {
    SubspaceProblem copy;
    copy.alpha = problem.alpha;
    copy.beta = problem.beta;
    copy.lambda = problem.lambda;
    copy.scope = problem.scope;
    copy.mesh_of = problem.mesh_of;
    copy.allowed_meshes = problem.allowed_meshes;
    return copy;
}

SubspaceProblem of_one_feature(const Comm& comm, const SubspaceProblem& problem, std::size_t feature) {
    SubspaceProblem one = without_features(problem);
    one.features = problem.features.only(comm, feature);
    return one;
}

SubspaceProblem stacked(const SubspaceProblem& problem) {
    SubspaceProblem one = without_features(problem);
    one.features = problem.features.joined();
    return one;
}

/// One pattern of pairs for all features, a value of 0 where a feature has none.
SparseCoefficients side_by_side(const std::vector<SparseCoefficients>& features) {
    const SparseCoefficients& first = features.front();
    SparseCoefficients all{first.size, first.columns, static_cast<int>(features.size()), {0}, {}, {}};
    for (std::size_t c = 0; c + 1 < first.offsets.size(); ++c) {
        std::map<int, std::vector<double>> pairs;
        for (std::size_t h = 0; h < features.size(); ++h) {
            const auto end = at(features[h].offsets[c + 1]);
            for (auto e = at(features[h].offsets[c]); e < end; ++e) {
                std::vector<double>& values = pairs[features[h].rows[e]];
                values.resize(features.size(), 0.0);
                values[h] = features[h].values[e];
            }
        }
        for (const auto& [row, values] : pairs) {
            all.rows.push_back(row);
            all.values.insert(all.values.end(), values.begin(), values.end());
        }
        all.offsets.push_back(static_cast<std::int64_t>(all.rows.size()));
    }
    return all;
}

SolveResult solve_independent(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    SolveResult sum;
    std::vector<SparseCoefficients> coefficients;
    std::vector<SolveHistory> histories;
    for (std::size_t h = 0; h < problem.features.size(); ++h) {
        SolveResult one = solve_subspace(comm, of_one_feature(comm, problem, h), options);
        add_certificate(sum, one);
        coefficients.push_back(std::move(one.coefficients));
        histories.push_back(std::move(one.history));
    }
    const auto gap_of = [&](double objective, double lower_bound) {
        return relative_gap(objective - lower_bound,
                            gap_scale(problem.scope, objective, sum.objective_at_zero),
                            sum.objective_at_zero);
    };
    sum.relative_gap = gap_of(sum.objective, sum.lower_bound);
    sum.history = joined(histories);
    for (HistoryRow& row : sum.history) row.relative_gap = gap_of(row.objective, row.lower_bound);
    sum.coefficients = side_by_side(coefficients);
    sum.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(sum.coefficients.rows.size()));
    return sum;
}

SolveResult solve_l1(const Comm& comm, const SubspaceProblem& problem, Sign sign,
                     const SolveOptions& options) {
    agree(comm, [&] { validate(problem); });
    use_one_blas_thread();
    return solve_sparse_regression(comm, problem, sign, options);
}

SolveResult solve_ssqp(const Comm& comm, SubspaceProblem problem, const SolveOptions& options) {
    problem.scope = PenaltyScope::rows;
    problem.alpha = problem.beta = 0.0;
    return solve_subspace(comm, problem, options);
}

}  // namespace

bool keeps_scope(SubspaceVariant variant) {
    return variant != SubspaceVariant::ssc && variant != SubspaceVariant::ssc_signed &&
           variant != SubspaceVariant::ssqp;
}

SolveResult solve_variant(const Comm& comm, const SubspaceProblem& problem, SubspaceVariant variant,
                          int feature, const SolveOptions& options) {
    agree(comm, [&] {
        validate(problem);
        if (variant == SubspaceVariant::single_feature &&
            (feature < 0 || feature >= problem.feature_count())) {
            throw Error(ExitCode::usage, "feature " + std::to_string(feature + 1) +
                                             " is asked for, but there are " +
                                             std::to_string(problem.feature_count()));
        }
    });
    switch (variant) {
        case SubspaceVariant::multi_feature:
            break;
        case SubspaceVariant::single_feature:
            return solve_subspace(comm, of_one_feature(comm, problem, at(feature)), options);
        case SubspaceVariant::independent:
            return solve_independent(comm, problem, options);
        case SubspaceVariant::concatenated:
            return solve_subspace(comm, stacked(problem), options);
        case SubspaceVariant::ssc:
            return solve_l1(comm, stacked(problem), Sign::nonnegative, options);
        case SubspaceVariant::ssc_signed:
            return solve_l1(comm, stacked(problem), Sign::free, options);
        case SubspaceVariant::ssqp:
            return solve_ssqp(comm, stacked(problem), options);
    }
    return solve_subspace(comm, problem, options);
}

}  // namespace coseg
