// What the subspace solvers cost: seconds, iterations, passes and memory against N, and the dense form beside
// the working set where it fits.
//
//   mpirun -n P solver_bench [--sizes 1000,5000,20000] [--dense-up-to 1000] [--scope paper] [--lambda 1000]
//   [--gap 1e-4]

#include <mpi.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "solvers/subspace_solver.hpp"
#include "src/seeded_random.hpp"

namespace {

using coseg::PenaltyScope;
using nlohmann::ordered_json;

struct Settings {
    std::vector<int> sizes{1000, 5000};
    int dense_up_to = 1000;
    std::string scope = "paper";
    double lambda = 1000.0;
    double gap = 1e-4;
};

constexpr int features = 5;
constexpr int bins = 100;
constexpr int parts = 5;
constexpr int patches_per_mesh = 50;

/// A square-rooted histogram of three bumps around the part's own centres, each patch a little different.
Eigen::VectorXd patch_histogram(int feature, int patch) {
    const auto h = static_cast<std::uint64_t>(feature);
    coseg::SeededStream part(coseg::hash_words({9, h, static_cast<std::uint64_t>(patch % parts)}));
    coseg::SeededStream own(coseg::hash_words({7, h, static_cast<std::uint64_t>(patch)}));
    Eigen::VectorXd histogram = Eigen::VectorXd::Zero(bins);
    for (int bump = 0; bump < 3; ++bump) {
        const double centre = part.uniform(0.0, bins) + 4.0 * own.normal();
        const double width = part.uniform(2.0, 8.0);
        const double mass = own.uniform(0.2, 1.2);
        for (int k = 0; k < bins; ++k) {
            histogram[k] += mass * own.uniform(0.5, 1.5) * std::exp(-0.5 * std::pow((k - centre) / width, 2));
        }
    }
    return (histogram / histogram.sum()).cwiseSqrt();
}

coseg::SubspaceProblem generate(int size, const Settings& settings) {
    constexpr double weight[features] = {1.0, 0.5, 1.0, 2.0, 1.0};
    coseg::SubspaceProblem problem;
    problem.scope = settings.scope == "mesh" ? PenaltyScope::mesh : PenaltyScope::paper;
    problem.lambda = settings.lambda;
    for (int h = 0; h < features; ++h) {
        Eigen::MatrixXd x(bins, size);
        for (int j = 0; j < size; ++j) x.col(j) = weight[h] * patch_histogram(h, j);
        problem.features.push_back(std::move(x));
    }
    for (int j = 0; j < size; ++j) problem.mesh_of.push_back(j / patches_per_mesh);
    return problem;
}

/// Megabytes that all ranks together have held at most so far.
double peak_megabytes(const coseg::Comm& comm) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(coseg::all_sum(comm, static_cast<std::int64_t>(usage.ru_maxrss))) / 1024.0;
}

ordered_json measure(const coseg::Comm& comm, const coseg::SubspaceProblem& problem, const Settings& settings,
                     const std::string& solver) {
    MPI_Barrier(comm.raw());
    const double start = MPI_Wtime();
    const coseg::SolveResult result = solve_subspace(comm, problem, {.gap = settings.gap, .solver = solver});
    const double seconds = coseg::all_max(comm, MPI_Wtime() - start);
    return {{"n", problem.size()},
            {"solver", solver},
            {"seconds", seconds},
            {"relative_gap", result.relative_gap},
            {"reason", to_string(result.reason)},
            {"iterations", result.iterations},
            {"passes", result.passes},
            {"working_pairs", result.working_pairs},
            {"nonzero_groups", result.nonzero_groups},
            {"peak_megabytes_so_far", peak_megabytes(comm)}};
}

void run(const Settings& settings) {
    const coseg::Comm comm(MPI_COMM_WORLD);
    ordered_json report{{"version", COSEG_VERSION},      {"build", COSEG_BUILD_TYPE},
                        {"ranks", comm.size()},          {"scope", settings.scope},
                        {"lambda", settings.lambda},     {"gap", settings.gap},
                        {"features", features},          {"bins", bins},
                        {"cases", ordered_json::array()}};
    for (const int size : settings.sizes) {
        const coseg::SubspaceProblem problem = generate(size, settings);
        report["cases"].push_back(measure(comm, problem, settings, "working-set"));
        if (settings.scope == "paper" && size <= settings.dense_up_to) {
            report["cases"].push_back(measure(comm, problem, settings, "dense"));
        }
    }
    if (comm.is_root()) std::cout << report.dump(2) << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    Settings settings;
    CLI::App app("Cost of the subspace solvers");
    app.add_option("--sizes", settings.sizes, "Numbers of patches")->delimiter(',')->capture_default_str();
    app.add_option("--dense-up-to", settings.dense_up_to, "Largest N for the dense form")
        ->capture_default_str();
    app.add_option("--scope", settings.scope, "paper or mesh")->check(CLI::IsMember({"paper", "mesh"}));
    app.add_option("--lambda", settings.lambda, "Penalty of the scope")->capture_default_str();
    app.add_option("--gap", settings.gap, "Relative gap")->capture_default_str();
    int status = 0;
    try {
        app.parse(argc, argv);
        run(settings);
    } catch (const CLI::ParseError& error) {
        status = app.exit(error);
    } catch (const coseg::Error& error) {
        std::cerr << error.what() << "\n";
        status = static_cast<int>(error.code());
    }
    MPI_Finalize();
    return status;
}
