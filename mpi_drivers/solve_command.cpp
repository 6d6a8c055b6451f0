// coseg solve: the optimiser alone, on a problem file.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/problem_file.hpp"
#include "mpi_drivers/command.hpp"
#include "mpi_drivers/option_checks.hpp"
#include "solvers/mesh_links.hpp"
#include "solvers/subspace_variants.hpp"

namespace coseg {

namespace {

struct SolveSettings {
    std::string path;
    std::string scope = "paper";
    int patches_per_mesh = 1;
    int links = 0;
    std::uint64_t seed = 1;
    std::string variant = "multi-feature";
    int feature = 1;
    SolveOptions options{.gap = 1e-6};
};

void broadcast_matrix(const Comm& comm, Eigen::MatrixXd& matrix) {
    constexpr std::int64_t chunk = 1 << 27;
    for (std::int64_t at = 0; at < matrix.size(); at += chunk) {
        MPI_Bcast(matrix.data() + at, static_cast<int>(std::min(chunk, matrix.size() - at)), MPI_DOUBLE, 0,
                  comm.raw());
    }
}

/// Rank 0 reads; the others learn of a bad file before they wait for its content.
ProblemFile read_and_broadcast(const Comm& comm, const std::string& path) {
    ProblemFile file;
    agree(comm, [&] {
        if (comm.is_root()) file = read_problem_file(path);
    });
    std::int64_t sizes[3] = {0, 0, 0};
    double numbers[3] = {file.lambda, file.alpha, file.beta};
    if (comm.is_root()) {
        sizes[0] = static_cast<std::int64_t>(file.features.size());
        sizes[1] = file.features.front().rows();
        sizes[2] = file.features.front().cols();
    }
    MPI_Bcast(sizes, 3, MPI_INT64_T, 0, comm.raw());
    MPI_Bcast(numbers, 3, MPI_DOUBLE, 0, comm.raw());
    file.lambda = numbers[0];
    file.alpha = numbers[1];
    file.beta = numbers[2];
    agree(comm, [&] {
        if (!comm.is_root())
            file.features.assign(static_cast<std::size_t>(sizes[0]), Eigen::MatrixXd(sizes[1], sizes[2]));
    });
    for (Eigen::MatrixXd& feature : file.features) broadcast_matrix(comm, feature);
    return file;
}

SubspaceProblem make_problem(ProblemFile file, const SolveSettings& settings) {
    SubspaceProblem problem;
    problem.features = std::move(file.features);
    problem.lambda = file.lambda;
    problem.alpha = file.alpha;
    problem.beta = file.beta;
    if (settings.scope == "mesh" && keeps_scope(variant_of(settings.variant))) {
        problem.scope = PenaltyScope::mesh;
        for (std::int64_t i = 0; i < problem.size(); ++i) {
            problem.mesh_of.push_back(static_cast<int>(i / settings.patches_per_mesh));
        }
        std::vector<std::string> names;
        for (int m = 0; m <= problem.mesh_of.back(); ++m) names.push_back(std::to_string(m));
        if (settings.links > 0) problem.allowed_meshes = mesh_links(names, settings.links, settings.seed);
    }
    return problem;
}

nlohmann::ordered_json to_json(const SubspaceProblem& problem, const SolveSettings& settings,
                               const SolveResult& result, int ranks, double seconds) {
    return {{"objective", result.objective},
            {"lower_bound", result.lower_bound},
            {"relative_gap", result.relative_gap},
            {"iterations", result.iterations},
            {"nonzero_groups", result.nonzero_groups},
            {"reason", to_string(result.reason)},
            {"objective_at_zero", result.objective_at_zero},
            {"kkt_residual", result.kkt_residual},
            {"working_pairs", result.working_pairs},
            {"passes", result.passes},
            {"seconds", seconds},
            {"ranks", ranks},
            {"solver", settings.options.solver},
            {"variant", settings.variant},
            {"scope", settings.scope},
            {"allowed_pairs", allowed_pair_count(problem)},
            {"n", problem.size()},
            {"h", problem.feature_count()},
            {"lambda", problem.lambda},
            {"alpha", problem.alpha},
            {"beta", problem.beta}};
}

void solve_file(const Comm& comm, const SolveSettings& settings) {
    if (settings.links > 0 && (settings.scope != "mesh" || !keeps_scope(variant_of(settings.variant)))) {
        throw AgreedError(
            ExitCode::usage,
            "--links needs --scope mesh and a variant that keeps it; scope paper, ssc and ssqp are "
            "over all pairs");
    }
    const SubspaceProblem problem = make_problem(read_and_broadcast(comm, settings.path), settings);
    const double start = MPI_Wtime();
    const SolveResult result =
        solve_variant(comm, problem, variant_of(settings.variant), settings.feature - 1, settings.options);
    if (comm.is_root()) {
        std::cout << to_json(problem, settings, result, comm.size(), MPI_Wtime() - start).dump(2)
                  << std::endl;
    }
    if (result.reason != StopReason::gap_reached && result.reason != StopReason::residual_reached) {
        throw AgreedError(ExitCode::not_converged,
                          settings.path + ": the gap of " + nlohmann::json(settings.options.gap).dump() +
                              " was not reached (" + to_string(result.reason) + ", gap " +
                              nlohmann::json(result.relative_gap).dump() +
                              "); raise --max-iterations or --max-seconds, or ask for a larger --gap");
    }
}

}  // namespace

Command add_solve_command(CLI::App& parent) {
    auto settings = std::make_shared<SolveSettings>();
    CLI::App* app = parent.add_subcommand(
        "solve", "Solve one subspace problem from a file and print the answer with its certificate as JSON");
    app->add_option("problem", settings->path,
                    "The problem: H d N, penalties, known bounds, then the features")
        ->required();
    app->add_option("--scope", settings->scope,
                    "What lambda punishes: row sums (paper) or matches per mesh (mesh)")
        ->check(CLI::IsMember({"paper", "mesh"}))
        ->capture_default_str();
    app->add_option("--patches-per-mesh", settings->patches_per_mesh,
                    "Scope mesh: columns that make up one mesh, in order")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    app->add_option("--links", settings->links,
                    "Scope mesh: other meshes in which a column may have matches, a seeded sample; 0 is all")
        ->check(CLI::Validator(
            [](std::string& text) {
                return text == "1" ? std::string("a mesh needs at least 2") : std::string();
            },
            ""))
        ->check(CLI::Range(0, 1 << 30))
        ->capture_default_str();
    app->add_option("--seed", settings->seed, "Of the sample of --links")->capture_default_str();
    app->add_option("--variant", settings->variant, "Form of the problem; see docs/method.md")
        ->check(CLI::IsMember(variant_names()))
        ->capture_default_str();
    app->add_option("--feature", settings->feature, "Variant single-feature: which, counted from 1")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    app->add_option("--solver", settings->options.solver,
                    "How W is stored: all pairs (dense) or a working set")
        ->check(CLI::IsMember({"auto", "dense", "working-set"}))
        ->capture_default_str();
    app->add_option("--gap", settings->options.gap, "Stop at this relative duality gap")
        ->check(finite_number)
        ->check(CLI::Range(1e-14, 1.0))
        ->capture_default_str();
    app->add_option("--max-iterations", settings->options.max_iterations, "Stop after so many iterations")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    app->add_option("--max-seconds", settings->options.max_seconds, "Stop after so many seconds")
        ->check(finite_number)
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
    return {app, [settings](const Invocation& invocation) { solve_file(invocation.world, *settings); }};
}

}  // namespace coseg
