// coseg cluster: solver, affinity and cut on a user's own feature matrices.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/data_files/feature_file.hpp"
#include "io/data_files/label_file.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "solvers/subspace/mesh_links.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

enum class ClusterScope {
    automatic,  ///< meshes where the file groups its items
    rows,
    meshes,
};
constexpr std::array<EnumName<ClusterScope>, 3> enum_names(ClusterScope /*type*/) {
    return {{{ClusterScope::automatic, "auto"},
             {ClusterScope::rows, name_of(PenaltyScope::rows)},
             {ClusterScope::meshes, name_of(PenaltyScope::meshes)}}};
}
constexpr std::array<EnumName<ClusterScope>, 2> enum_aliases(ClusterScope /*type*/) {
    return {{{ClusterScope::rows, "paper"}, {ClusterScope::meshes, "mesh"}}};
}

struct ClusterSettings {
    std::string path;
    std::string out;
    std::string coefficients;
    int parts = 0;
    bool unit_columns = false;
    SubspaceVariant variant = SubspaceVariant::multi_feature;
    ClusterScope scope = ClusterScope::automatic;
    int links = 0;
    std::uint64_t seed = 1;
    double alpha = 0.01, beta = 0.1, lambda = 1.0;
    AffinityForm affinity = AffinityForm::formula_8;
    double adjacency = 0.0;
    SolveOptions options{.gap = 1e-4};
};

/// A message about matrices, in the terms of the file.
std::string in_terms_of(const FeatureFile& file, const std::string& path, const std::string& message) {
    std::string names;
    for (const std::string& name : file.names) names += (names.empty() ? "" : ", ") + name;
    return path + ": " + message + " (features are the datasets of 'features' in the order " + names +
           ", columns their rows, both counted from 1)";
}

/// Rank 0 reads, and its features become those of all; relations stay there, since each is to be given to the
/// cut by one rank.
FeatureFile read_and_broadcast(const Comm& comm, const std::string& path, FeatureMatrices& features) {
    FeatureFile file;
    agree(comm, [&] {
        if (comm.is_root()) file = read_feature_file(path);
    });
    broadcast(comm, file.names);
    try {
        features = share_matrices(comm, file.features);
    } catch (const AgreedError& error) {
        throw AgreedError(error.code(), in_terms_of(file, path, error.what()));
    }
    file.features.clear();
    broadcast(comm, file.mesh_of);
    broadcast(comm, file.patch_area);
    broadcast(comm, file.mesh_names);
    return file;
}

/// The certificate and the limits of allowed pairs refer to groups; without any each item is one.
SubspaceProblem make_problem(const FeatureFile& file, FeatureMatrices features,
                             const ClusterSettings& settings) {
    SubspaceProblem problem;
    problem.features = std::move(features);
    problem.alpha = settings.alpha;
    problem.beta = settings.beta;
    problem.lambda = settings.lambda;
    const bool grouped = !file.mesh_of.empty() &&
                         std::ranges::adjacent_find(file.mesh_of, std::not_equal_to()) != file.mesh_of.end();
    // One group has no other to link to: its items are then compared among themselves.
    const bool mesh_scope =
        settings.scope == ClusterScope::meshes || (settings.scope == ClusterScope::automatic && grouped);
    if (settings.scope == ClusterScope::meshes && !grouped) {
        throw AgreedError(ExitCode::input,
                          settings.path +
                              ": --scope meshes needs the dataset 'mesh_of' with at least two "
                              "groups; items of one group are not linked to each other");
    }
    if (!mesh_scope || !keeps_scope(settings.variant)) return problem;
    problem.scope = PenaltyScope::meshes;
    problem.mesh_of = file.mesh_of;
    const int meshes = 1 + *std::ranges::max_element(problem.mesh_of);
    std::vector<std::string> names = file.mesh_names;
    for (int m = 0; names.size() < static_cast<std::size_t>(meshes); ++m) names.push_back(std::to_string(m));
    if (settings.links > 0) problem.allowed_meshes = mesh_links(names, settings.links, settings.seed);
    return problem;
}

/// What cannot be clustered, in the terms of the file.
void validate(const SubspaceProblem& problem, const FeatureFile& file, const ClusterSettings& settings) {
    try {
        validate(problem);
    } catch (const Error& error) {
        throw Error(error.code(), in_terms_of(file, settings.path, error.what()));
    }
    if (settings.parts > problem.size()) {
        throw Error(ExitCode::usage, std::to_string(settings.parts) + " parts are asked for, but " +
                                         settings.path + " holds " + std::to_string(problem.size()) +
                                         (problem.size() == 1 ? " item" : " items"));
    }
}

/// Collective.
void scale_columns(FeatureMatrices& features) {
    const std::vector<Eigen::Index>& offsets = features.offsets();
    features.for_each_column([&](Eigen::Index, double* column) {
        for (std::size_t h = 0; h < features.size(); ++h) {
            Eigen::Map<Eigen::VectorXd> x(column + offsets[h], offsets[h + 1] - offsets[h]);
            const Eigen::VectorXd aligned = x;  // for its sum not to depend on where the column lies
            const double norm = aligned.norm();
            if (norm > 0.0) x /= norm;
        }
    });
}

CutResult cut(const Comm& comm, const FeatureFile& file, const SolveResult& solution,
              const ClusterSettings& settings) {
    const auto items = static_cast<std::size_t>(solution.coefficients.size);
    std::vector<GlobalPatchNeighbors> neighbors;
    for (std::size_t k = 0; k < file.neighbors.first.size(); ++k) {
        neighbors.push_back(
            {file.neighbors.first[k], file.neighbors.second[k], file.neighbors.weight[k], file.concavity[k]});
    }
    std::vector<GlobalPatchOverlap> overlaps;
    for (std::size_t k = 0; k < file.overlaps.first.size(); ++k)
        overlaps.push_back({file.overlaps.first[k], file.overlaps.second[k], file.overlaps.weight[k]});
    const std::vector<int> mesh_of = file.mesh_of.empty() ? std::vector<int>(items, 0) : file.mesh_of;
    const std::vector<double> area = file.patch_area.empty()
                                         ? std::vector<double>(items, 1.0 / static_cast<double>(items))
                                         : file.patch_area;
    CutOptions options;
    options.parts = settings.parts;
    options.form = settings.affinity;
    options.minima_rule = !neighbors.empty();
    options.starts = single_start(settings.parts, settings.adjacency);
    return partition_patches(comm, {solution.coefficients, neighbors, overlaps, mesh_of, area}, options);
}

nlohmann::ordered_json to_json(const SubspaceProblem& problem, const SolveResult& solution,
                               const CutResult& result, const ClusterSettings& settings) {
    auto json = nlohmann::ordered_json::parse(certificate_json(problem, solution));
    std::vector<std::int64_t> sizes(static_cast<std::size_t>(settings.parts), 0);
    for (const int part : result.part_of_patch) ++sizes[at(part)];
    json.update({{"variant", to_string(settings.variant)},
                 {"scope", to_string(problem.scope)},
                 {"parts", settings.parts},
                 {"items_of_part", sizes}});
    if (!result.starts.empty()) json["eigenvalues"] = result.eigenvalues;
    return json;
}

void cluster_file(const Invocation& invocation, const ClusterSettings& settings) {
    const Comm& comm = invocation.world;
    const std::string unknown = unknown_petsc_option(invocation.petsc_arguments);
    if (!unknown.empty())
        throw AgreedError(ExitCode::usage, "after --: " + unknown + " is not an option of PETSc or SLEPc");
    const PetscSession session(invocation.petsc_arguments);
    agree(comm, reserve_blas_memory);
    FeatureMatrices features;
    const FeatureFile file = read_and_broadcast(comm, settings.path, features);
    SubspaceProblem problem = make_problem(file, std::move(features), settings);
    agree(comm, [&] { validate(problem, file, settings); });
    if (settings.unit_columns) scale_columns(problem.features);
    const SolveResult solution = solve_variant(comm, problem, settings.variant, 0, settings.options);
    write_coefficients(comm, solution, settings.coefficients);
    if (settings.parts > 1) refuse_empty_solution(solution, settings.path);
    const CutResult result = cut(comm, file, solution, settings);
    agree(comm, [&] {
        if (comm.is_root()) write_labels(settings.out, result.part_of_patch);
    });
    if (comm.is_root()) std::cout << to_json(problem, solution, result, settings).dump(2) << std::endl;
    refuse_unreached_gap(solution, settings.options.gap, settings.path);
}

void add_problem_options(CLI::App& app, ClusterSettings& settings) {
    add_enum_option(app, "--variant", settings.variant, "Form of the problem; see docs/method.md");
    add_enum_option(app, "--scope", settings.scope,
                    "What lambda punishes: row sums (rows, as in the paper), matches per mesh (meshes), or "
                    "meshes where the file groups its items (auto)");
    app.add_option("--links", settings.links,
                   "Mesh scope: other groups in which an item may have matches, a seeded sample; 0 is all")
        ->check(CLI::Range(0, 1 << 30))
        ->check(CLI::Validator(
            [](std::string& text) {
                return text == "1" ? std::string("a group needs at least 2") : std::string();
            },
            ""))
        ->capture_default_str();
    app.add_option("--seed", settings.seed, "Of the sample of --links")->capture_default_str();
    for (const auto& [name, value, help] :
         {std::tuple{"--alpha", &settings.alpha, "Weight of the l2,1 penalty"},
          std::tuple{"--beta", &settings.beta, "Weight of the l1 penalty"},
          std::tuple{"--lambda", &settings.lambda, "Weight of the squared sums"}}) {
        app.add_option(name, *value, help)
            ->check(finite_number)
            ->check(CLI::Range(0.0, 1e12))
            ->capture_default_str();
    }
    app.add_flag("--unit-columns", settings.unit_columns,
                 "Scale every column of every feature to norm 1 first");
}

void add_limits(CLI::App& app, ClusterSettings& settings) {
    app.add_option("--gap", settings.options.gap, "Stop at this relative duality gap")
        ->check(finite_number)
        ->check(CLI::Range(1e-14, 1.0))
        ->capture_default_str();
    app.add_option("--max-iterations", settings.options.max_iterations, "Stop after so many iterations")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    app.add_option("--max-seconds", settings.options.max_seconds, "Stop after so many seconds")
        ->check(finite_number)
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
}

}  // namespace

Command add_cluster_command(CLI::App& parent) {
    auto settings = std::make_shared<ClusterSettings>();
    CLI::App* app = parent.add_subcommand(
        "cluster", "Cluster the columns of your own feature matrices: solver, affinity and normalised cut");
    app->add_option("features", settings->path,
                    "HDF5 file with the group 'features'; layout in docs/formats.md")
        ->required();
    app->add_option("--parts", settings->parts, "Number of clusters K")
        ->required()
        ->check(CLI::Range(1, 1000));
    app->add_option("--out", settings->out, "Text file for the clusters: one number a line, 0 .. K-1")
        ->required()
        ->type_name("FILE");
    app->add_option("--coefficients", settings->coefficients,
                    "HDF5 file for W; written also where a limit ends the solve")
        ->type_name("FILE");
    add_problem_options(*app, *settings);
    add_enum_option(*app, "--affinity", settings->affinity,
                    "formula-8 (the paper's) or links (every column sums to 1)");
    app->add_option("--adjacency", settings->adjacency, "Weight of the file's neighbours and overlaps")
        ->check(finite_number)
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    add_limits(*app, *settings);
    return {app, [settings](const Invocation& invocation) { cluster_file(invocation, *settings); }};
}

}  // namespace coseg
