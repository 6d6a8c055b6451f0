// coseg cluster: solver, affinity and cut on a user's own feature matrices.

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/data_files/feature_file.hpp"
#include "io/data_files/label_file.hpp"
#include "mpi_drivers/clustering.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

struct ClusterSettings {
    std::string path;
    std::string out;
    std::string coefficients;
    ClusterOptions cluster;
};

nlohmann::ordered_json to_json(const SubspaceProblem& problem, const SolveResult& solution,
                               const CutResult& result, const ClusterSettings& settings) {
    auto json = nlohmann::ordered_json::parse(certificate_json(problem, solution));
    std::vector<std::int64_t> sizes(static_cast<std::size_t>(settings.cluster.parts), 0);
    for (const int part : result.part_of_patch) ++sizes[at(part)];
    json.update({{"variant", to_string(settings.cluster.variant)},
                 {"scope", to_string(problem.scope)},
                 {"parts", settings.cluster.parts},
                 {"items_of_part", sizes}});
    if (!result.starts.empty()) json["eigenvalues"] = result.eigenvalues;
    return json;
}

void cluster_file(const Invocation& invocation, const ClusterSettings& settings) {
    const Comm& comm = invocation.world;
    const CheckedPetsc petsc(comm, invocation.petsc_arguments);
    ClusterData data;
    data.name = settings.path;
    agree(comm, [&] {
        if (!comm.is_root()) return;
        check_output_files({{"--out", settings.out}, {"--coefficients", settings.coefficients}},
                           {settings.path});
        data.file = read_feature_file(settings.path);
    });
    share(comm, data);
    const auto [problem, solution] = solve_clusters(comm, data, settings.cluster);
    write_coefficients(comm, solution, settings.coefficients);
    const CutResult result = cut_clusters(comm, data, solution, settings.cluster);
    if (!invocation.petsc_arguments.empty()) CheckedPetsc::refuse_unused(comm);
    agree(comm, [&] {
        if (comm.is_root()) write_labels(settings.out, result.part_of_patch);
    });
    if (comm.is_root()) std::cout << to_json(problem, solution, result, settings).dump(2) << std::endl;
    refuse_unreached_gap(solution, settings.cluster.solve.gap, settings.path);
}

void add_problem_options(CLI::App& app, ClusterSettings& settings) {
    add_enum_option(app, "--variant", settings.cluster.variant, "Form of the problem; see docs/method.md");
    add_enum_option(app, "--scope", settings.cluster.scope,
                    "What lambda punishes: row sums (rows, as in the paper), matches per mesh (meshes), or "
                    "meshes where the file groups its items (auto)");
    app.add_option("--links", settings.cluster.links,
                   "Mesh scope: other groups in which an item may have matches, a seeded sample; 0 is all")
        ->check(CLI::Range(0, 1 << 30))
        ->transform(decimal_digits)
        ->check(CLI::Validator(
            [](std::string& text) {
                return text == "1" ? std::string("a group needs at least 2") : std::string();
            },
            ""))
        ->capture_default_str();
    app.add_option("--seed", settings.cluster.seed, "Of the sample of --links")
        ->check(unsigned_number)
        ->transform(decimal_digits)
        ->capture_default_str();
    for (const auto& [name, value, help] :
         {std::tuple{"--alpha", &settings.cluster.alpha, "Weight of the l2,1 penalty"},
          std::tuple{"--beta", &settings.cluster.beta, "Weight of the l1 penalty"},
          std::tuple{"--lambda", &settings.cluster.lambda, "Weight of the squared sums"}}) {
        app.add_option(name, *value, help)
            ->check(finite_number)
            ->check(CLI::Range(0.0, most_penalty))
            ->capture_default_str();
    }
    app.add_flag("--unit-columns", settings.cluster.unit_columns,
                 "Scale every item of every feature to norm 1 first");
}

void add_limits(CLI::App& app, ClusterSettings& settings) {
    app.add_option("--gap", settings.cluster.solve.gap, "Stop at this relative duality gap")
        ->check(finite_number)
        ->check(gap_from(least_gap))
        ->capture_default_str();
    app.add_option("--max-iterations", settings.cluster.solve.max_iterations, "Stop after so many iterations")
        ->check(CLI::Range(1, most_solve_iterations))
        ->transform(decimal_digits)
        ->capture_default_str();
    app.add_option("--max-seconds", settings.cluster.solve.max_seconds, "Stop after so many seconds")
        ->check(finite_number)
        ->check(CLI::Range(0.0, most_solve_seconds))
        ->capture_default_str();
}

}  // namespace

Command add_cluster_command(CLI::App& parent) {
    auto settings = std::make_shared<ClusterSettings>();
    CLI::App* app = parent.add_subcommand(
        "cluster", "Cluster the items of your own feature matrices: solver, affinity and normalised cut");
    app->add_option("features", settings->path,
                    "HDF5 file with the group 'features', whose datasets have a row for each item; layout in "
                    "docs/formats.md")
        ->required();
    app->add_option("--parts", settings->cluster.parts, "Number of clusters K")
        ->required()
        ->check(CLI::Range(1, most_parts))
        ->transform(decimal_digits);
    app->add_option("--out", settings->out, "Text file for the clusters: one number a line, 0 .. K-1")
        ->required()
        ->type_name("FILE");
    app->add_option("--coefficients", settings->coefficients,
                    "HDF5 file for W; written also where a limit ends the solve")
        ->type_name("FILE");
    add_problem_options(*app, *settings);
    add_enum_option(*app, "--affinity", settings->cluster.affinity,
                    "formula-8 (the paper's) or links (every item's own links sum to 1)");
    app->add_option("--adjacency", settings->cluster.adjacency,
                    "Weight of the file's neighbours and overlaps")
        ->check(finite_number)
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    add_limits(*app, *settings);
    return {app, [settings](const Invocation& invocation) { cluster_file(invocation, *settings); }};
}

}  // namespace coseg
