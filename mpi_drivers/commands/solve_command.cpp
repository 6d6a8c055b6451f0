// coseg solve: the optimiser alone, on a problem file.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/data_files/problem_file.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/subspace/mesh_links.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

struct SolveSettings {
    std::string path;
    std::string coefficients;
    PenaltyScope scope = PenaltyScope::rows;
    int patches_per_mesh = 1;
    int links = 0;
    std::uint64_t seed = 1;
    SubspaceVariant variant = SubspaceVariant::multi_feature;
    int feature = 1;
    SolveOptions options{.gap = 1e-6};
};

/// Rank 0 reads; the others learn of a bad file before they wait for its content.
ProblemFile broadcast_problem(const Comm& comm, const std::string& path, FeatureMatrices& features) {
    ProblemFile file;
    agree(comm, [&] {
        if (comm.is_root()) file = read_problem_file(path);
    });
    for (double* penalty : {&file.lambda, &file.alpha, &file.beta}) broadcast(comm, *penalty);
    features = share_matrices(comm, file.features);
    file.features.clear();
    return file;
}

SubspaceProblem problem_of(const ProblemFile& file, FeatureMatrices features, const SolveSettings& settings) {
    SubspaceProblem problem;
    problem.features = std::move(features);
    problem.lambda = file.lambda;
    problem.alpha = file.alpha;
    problem.beta = file.beta;
    if (settings.scope == PenaltyScope::meshes && keeps_scope(settings.variant)) {
        problem.scope = PenaltyScope::meshes;
        for (std::int64_t i = 0; i < problem.size(); ++i) {
            problem.mesh_of.push_back(static_cast<int>(i / settings.patches_per_mesh));
        }
        std::vector<std::string> names;
        for (int m = 0; m <= problem.mesh_of.back(); ++m) names.push_back(std::to_string(m));
        if (settings.links > 0) problem.allowed_meshes = mesh_links(names, settings.links, settings.seed);
    }
    return problem;
}

void solve_file(const Comm& comm, const SolveSettings& settings) {
    if (settings.links > 0 && (settings.scope != PenaltyScope::meshes || !keeps_scope(settings.variant))) {
        throw AgreedError(
            ExitCode::usage,
            "--links needs --scope meshes and a variant that keeps it; row scope, ssc and ssqp are "
            "over all pairs");
    }
    agree(comm, [&] {
        if (comm.is_root()) check_output_files({{"--coefficients", settings.coefficients}}, {settings.path});
        reserve_blas_memory();
    });
    FeatureMatrices features;
    const ProblemFile file = broadcast_problem(comm, settings.path, features);
    const SubspaceProblem problem = problem_of(file, std::move(features), settings);
    const Stopwatch clock;
    const SolveResult result =
        solve_variant(comm, problem, settings.variant, settings.feature - 1, settings.options);
    const double seconds = clock.seconds();
    if (comm.is_root()) {
        auto json = nlohmann::ordered_json::parse(certificate_json(problem, result));
        json.update({{"variant", to_string(settings.variant)},
                     {"scope", to_string(problem.scope)},
                     {"seconds", seconds},
                     {"ranks", comm.size()},
                     {"solver", to_string(settings.options.solver)}});
        std::cout << json.dump(2) << std::endl;
    }
    write_coefficients(comm, result, settings.coefficients);
    refuse_unreached_gap(result, settings.options.gap, settings.path);
}

}  // namespace

Command add_solve_command(CLI::App& parent) {
    auto settings = std::make_shared<SolveSettings>();
    CLI::App* app = parent.add_subcommand(
        "solve", "Solve one subspace problem from a file and print the answer with its certificate as JSON");
    app->add_option("problem", settings->path,
                    "The problem: H d N, penalties, known bounds, then the features")
        ->required();
    app->add_option("--coefficients", settings->coefficients,
                    "HDF5 file for W; written also where a limit ends the solve")
        ->type_name("FILE");
    add_enum_option(*app, "--scope", settings->scope,
                    "What lambda punishes: row sums (rows, as in the paper) or matches per mesh (meshes)");
    app->add_option("--patches-per-mesh", settings->patches_per_mesh,
                    "Mesh scope: columns that make up one mesh, in order")
        ->check(CLI::Range(1, 1 << 30))
        ->transform(decimal_digits)
        ->capture_default_str();
    app->add_option("--links", settings->links,
                    "Mesh scope: other meshes in which a column may have matches, a seeded sample; 0 is all")
        ->check(CLI::Validator(
            [](std::string& text) {
                return text == "1" ? std::string("a mesh needs at least 2") : std::string();
            },
            ""))
        ->check(CLI::Range(0, 1 << 30))
        ->transform(decimal_digits)
        ->capture_default_str();
    app->add_option("--seed", settings->seed, "Of the sample of --links")
        ->check(unsigned_number)
        ->transform(decimal_digits)
        ->capture_default_str();
    add_enum_option(*app, "--variant", settings->variant, "Form of the problem; see docs/method.md");
    app->add_option("--feature", settings->feature, "Variant single-feature: which, counted from 1")
        ->check(CLI::Range(1, 1 << 30))
        ->transform(decimal_digits)
        ->capture_default_str();
    add_enum_option(*app, "--solver", settings->options.solver,
                    "How W is stored: all pairs (dense) or a working set");
    app->add_option("--gap", settings->options.gap, "Stop at this relative duality gap")
        ->check(finite_number)
        ->check(gap_from(least_gap))
        ->capture_default_str();
    app->add_option("--max-iterations", settings->options.max_iterations, "Stop after so many iterations")
        ->check(CLI::Range(1, most_solve_iterations))
        ->transform(decimal_digits)
        ->capture_default_str();
    app->add_option("--max-seconds", settings->options.max_seconds, "Stop after so many seconds")
        ->check(finite_number)
        ->check(CLI::Range(0.0, most_solve_seconds))
        ->capture_default_str();
    return {app, [settings](const Invocation& invocation) { solve_file(invocation.world, *settings); }};
}

}  // namespace coseg
