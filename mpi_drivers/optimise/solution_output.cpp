#include "mpi_drivers/optimise/solution_output.hpp"

#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "io/data_files/feature_file.hpp"
#include "io/reports/record_json.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

/// What a solve prints of itself.
struct Certificate {
    std::int64_t allowed_pairs = 0;
    std::int64_t n = 0;
    int h = 0;
    double lambda = 0.0;
    double alpha = 0.0;
    double beta = 0.0;
    SolveSummary solution;
    static constexpr auto fields() {
        return std::tuple(field("allowed_pairs", &Certificate::allowed_pairs), field("n", &Certificate::n),
                          field("h", &Certificate::h), field("lambda", &Certificate::lambda),
                          field("alpha", &Certificate::alpha), field("beta", &Certificate::beta),
                          inlined(&Certificate::solution));
    }
};

}  // namespace

std::string certificate_json(const SubspaceProblem& problem, const SolveResult& result) {
    JsonTree tree;
    set_json(tree.root(), Certificate{.allowed_pairs = allowed_pair_count(problem),
                                      .n = problem.size(),
                                      .h = problem.feature_count(),
                                      .lambda = problem.lambda,
                                      .alpha = problem.alpha,
                                      .beta = problem.beta,
                                      .solution = result});
    return tree.line();
}

void write_coefficients(const Comm& comm, const SolveResult& result, const std::string& path) {
    if (path.empty()) return;
    SparseCoefficients w = gathered(comm, result.coefficients);
    const CoefficientFile file{
        w.size,           w.features,         std::move(w.offsets),    std::move(w.rows), std::move(w.values),
        result.objective, result.lower_bound, to_string(result.reason)};
    agree(comm, [&] {
        if (comm.is_root()) write_coefficient_file(path, file);
    });
}

std::optional<std::string> unreached_gap(const SolveResult& result, double gap, const std::string& subject) {
    if (result.reason == StopReason::gap_reached || result.reason == StopReason::residual_reached)
        return std::nullopt;
    return subject + ": the gap of " + nlohmann::json(gap).dump() + " was not reached (" +
           to_string(result.reason) + ", gap " + nlohmann::json(result.relative_gap).dump() +
           "); raise --max-iterations or --max-seconds, or ask for a larger --gap";
}

void refuse_unreached_gap(const SolveResult& result, double gap, const std::string& subject) {
    if (const auto sentence = unreached_gap(result, gap, subject))
        throw AgreedError(ExitCode::not_converged, *sentence);
}

void refuse_empty_solution(const SolveResult& result, const std::string& subject) {
    if (result.nonzero_groups > 0) return;
    const bool certified = result.reason == StopReason::gap_reached;
    throw AgreedError(
        ExitCode::input,
        subject + (certified ? ": the optimum is W = 0 (certified)" : ": the coefficients are all 0") +
            ", no item is explained by others, so there is nothing to cut; lower alpha, beta or lambda");
}

}  // namespace coseg
