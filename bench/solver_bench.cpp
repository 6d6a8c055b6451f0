// Measures what the subspace solvers cost: seconds, iterations, passes and memory against N, and the dense
// form beside the working set where it fits.
//
//   mpirun -n P solver_bench [--sizes 1000,5000,20000] [--dense-up-to 1000] [--scope rows] [--lambda 1000]
//                            [--gap 1e-4] [--links 0] [--strong]
//
// --strong first solves each case on rank 0 alone, and prints how much longer that takes than all ranks
// together. CPU seconds stand beside wall seconds, for machines that are shared.

#include <mpi.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/mpi_program.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "solvers/row_scope/pass_clock.hpp"
#include "solvers/subspace/mesh_links.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/stopwatch.hpp"

namespace {

/// Bytes that this rank has handed to collective calls, counted through MPI's profiling interface.
double message_bytes = 0.0;

double bytes_of(std::int64_t count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return static_cast<double>(count) * size;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the names and parameters are MPI's
extern "C" {
int MPI_Allreduce(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
    message_bytes += bytes_of(count, type);
    return PMPI_Allreduce(send, receive, count, type, op, comm);
}
int MPI_Allgatherv(const void* send, int count, MPI_Datatype type, void* receive, const int* counts,
                   const int* offsets, MPI_Datatype receive_type, MPI_Comm comm) {
    message_bytes += bytes_of(count, type);
    return PMPI_Allgatherv(send, count, type, receive, counts, offsets, receive_type, comm);
}
int MPI_Alltoallv(const void* send, const int* counts, const int* offsets, MPI_Datatype type, void* receive,
                  const int* receive_counts, const int* receive_offsets, MPI_Datatype receive_type,
                  MPI_Comm comm) {
    int ranks = 1;
    PMPI_Comm_size(comm, &ranks);
    for (int r = 0; r < ranks; ++r) message_bytes += bytes_of(counts[r], type);
    return PMPI_Alltoallv(send, counts, offsets, type, receive, receive_counts, receive_offsets, receive_type,
                          comm);
}
}
// NOLINTEND(readability-identifier-naming)

namespace {

using coseg::PenaltyScope;
using coseg::SolverChoice;
using nlohmann::ordered_json;

struct Settings {
    std::vector<int> sizes{1000, 5000};
    int dense_up_to = 1000;
    PenaltyScope scope = PenaltyScope::rows;
    double lambda = 1000.0;
    double gap = 1e-4;
    int links = 0;
    bool strong = false;
    std::vector<int> clusters;
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

coseg::SubspaceProblem generate(const coseg::Comm& comm, int size, const Settings& settings) {
    constexpr double weight[features] = {1.0, 0.5, 1.0, 2.0, 1.0};
    coseg::SubspaceProblem problem;
    problem.scope = settings.scope;
    problem.lambda = settings.lambda;
    problem.features = coseg::FeatureMatrices(comm, std::vector<Eigen::Index>(features, bins), size);
    problem.features.for_each_column([&](Eigen::Index j, double* column) {
        for (int h = 0; h < features; ++h) {
            Eigen::Map<Eigen::VectorXd>(column + static_cast<std::ptrdiff_t>(h) * bins, bins) =
                weight[h] * patch_histogram(h, static_cast<int>(j));
        }
    });
    for (int j = 0; j < size; ++j) problem.mesh_of.push_back(j / patches_per_mesh);
    const int meshes = problem.mesh_of.back() + 1;
    std::vector<std::string> names;
    for (int m = 0; m < meshes; ++m) names.push_back(std::to_string(m));
    const int by_default = meshes <= coseg::meshes_linked_to_all ? meshes : coseg::default_links;
    if (settings.scope == PenaltyScope::meshes)
        problem.allowed_meshes =
            coseg::mesh_links(names, settings.links > 0 ? settings.links : by_default, 1);
    return problem;
}

/// Looks at this process's memory a hundred times a second.
class MemoryWatch {
  public:
    MemoryWatch() : thread_([this] { look_on(); }) {}
    ~MemoryWatch() {
        over_ = true;
        thread_.join();
    }
    MemoryWatch(const MemoryWatch&) = delete;
    MemoryWatch& operator=(const MemoryWatch&) = delete;

    /// Megabytes that all ranks together have held at most so far. What ranks share - features, and the pages
    /// of the program and its libraries - is counted once.
    [[nodiscard]] double peak_megabytes(const coseg::Comm& comm) const {
        const auto pages = static_cast<double>(coseg::all_sum(comm, own_.load())) +
                           coseg::all_max(comm, static_cast<double>(shared_.load()));
        return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
    }

  private:
    void look_on() {
        while (!over_) {
            std::int64_t size = 0, resident = 0, shared = 0;
            std::ifstream("/proc/self/statm") >> size >> resident >> shared;
            own_ = std::max(own_.load(), resident - shared);
            shared_ = std::max(shared_.load(), shared);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    std::atomic<std::int64_t> own_{0};
    std::atomic<std::int64_t> shared_{0};
    std::atomic<bool> over_{false};
    std::thread thread_;
};

/// CPU seconds of all ranks.
double sum_over_ranks(const coseg::Comm& comm, double value) {
    double sum = 0.0;
    MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, comm.raw());
    return sum;
}

/// What one core does in large single-precision matrix products of the features' length, in 1e9 operations
/// per CPU second; all ranks measure at the same time, and the mean is given.
double machine_gigaflops(const coseg::Comm& comm) {
    constexpr int size = 2048;
    constexpr int length = features * bins;
    constexpr int repeats = 4;
    const std::vector<float> a(static_cast<std::size_t>(size) * length, 0.5F);
    std::vector<float> c(static_cast<std::size_t>(size) * size);
    MPI_Barrier(comm.raw());
    const double start = coseg::PassClock::cpu_seconds();
    for (int r = 0; r < repeats; ++r) {
        coseg::multiply_transposed({a.data(), length, size, length}, {a.data(), length, size, length}, 0.0F,
                                   {c.data(), size, size, size});
    }
    const double seconds = coseg::PassClock::cpu_seconds() - start;
    return sum_over_ranks(comm, 2e-9 * repeats * size * size * length / seconds) / comm.size();
}

/// docs/scaling.md: what a rank hands to collective calls. Each pass merges 8 candidates of 16 bytes a row
/// and, but for the first, raises H prices a row; each iteration, and the start, sends the H values of a pair
/// to its row and back.
double model_bytes(const coseg::Comm& comm, const coseg::SubspaceProblem& problem,
                   const coseg::SolveResult& result) {
    const auto rows = static_cast<double>(problem.size());
    const double candidates = comm.size() > 1 ? 128.0 * rows * result.passes : 0.0;
    const double prices = 8.0 * features * rows * (result.passes - 1);
    const double pairs = static_cast<double>(result.working_pairs) / comm.size();
    return candidates + prices + 16.0 * features * pairs * (result.iterations + 1);
}

/// The passes beside the machine's own matrix product, per core.
ordered_json pass_figures(const coseg::Comm& comm, const coseg::SubspaceProblem& problem,
                          const coseg::SolveResult& result, double machine) {
    const double cpu = sum_over_ranks(comm, result.pass_cost.cpu_seconds);
    const double wall = coseg::all_max(comm, result.pass_cost.wall_seconds);
    const double communication = sum_over_ranks(comm, result.pass_cost.communication_seconds) / comm.size();
    const double operations =
        2.0 * features * bins * static_cast<double>(coseg::allowed_pair_count(problem)) * result.passes;
    const double rate = 1e-9 * operations / cpu;
    // A rank that waits for another spins: on a machine with other work that is much of a short pass.
    const double waiting = sum_over_ranks(comm, result.pass_cost.waiting_cpu_seconds);
    const double measured = sum_over_ranks(comm, message_bytes);
    return {{"cpu_seconds_per_pass", cpu / result.passes},
            {"wall_seconds_per_pass", wall / result.passes},
            {"gigaflops_per_core", rate},
            {"machine_gigaflops_per_core", machine},
            {"share_of_machine", rate / machine},
            {"share_of_machine_while_not_waiting", rate / machine * cpu / (cpu - waiting)},
            {"message_bytes_per_rank", measured / comm.size()},
            {"model_bytes_per_rank", model_bytes(comm, problem, result)},
            {"communication_share", communication / wall}};
}

/// The normalised cut of the coefficients by formula (8), by one rank, as `coseg run` does it.
ordered_json cut_figures(const coseg::Comm& comm, const coseg::SolveResult& result,
                         const std::vector<int>& mesh_of, int clusters, const MemoryWatch& memory) {
    const std::vector<double> area(mesh_of.size(), 1.0);
    const std::vector<coseg::GlobalPatchNeighbors> neighbors;
    const std::vector<coseg::GlobalPatchOverlap> overlaps;
    coseg::CutOptions options;
    options.parts = clusters;
    options.minima_rule = false;
    options.starts = coseg::single_start(clusters, 0.0);
    MPI_Barrier(comm.raw());
    const coseg::Stopwatch clock;
    const double cpu_start = coseg::PassClock::cpu_seconds();
    const coseg::CutResult cut =
        coseg::partition_patches(comm, {result.coefficients, neighbors, overlaps, mesh_of, area}, options);
    const double cpu = coseg::PassClock::cpu_seconds() - cpu_start;
    return {{"clusters", clusters},
            {"seconds", coseg::all_max(comm, clock.seconds())},
            {"cpu_seconds", coseg::all_max(comm, cpu)},
            {"eigenvalues", cut.eigenvalues},
            {"set_aside", cut.starts.front().set_aside},
            {"peak_megabytes_so_far", memory.peak_megabytes(comm)}};
}

ordered_json measure(const coseg::Comm& comm, const coseg::SubspaceProblem& problem, const Settings& settings,
                     SolverChoice solver, const MemoryWatch& memory) {
    const double machine = machine_gigaflops(comm);
    MPI_Barrier(comm.raw());
    const coseg::Stopwatch clock;
    const double cpu_start = coseg::PassClock::cpu_seconds();
    message_bytes = 0.0;
    const coseg::SolveResult result = solve_subspace(comm, problem, {.gap = settings.gap, .solver = solver});
    const double seconds = coseg::all_max(comm, clock.seconds());
    const double cpu = sum_over_ranks(comm, coseg::PassClock::cpu_seconds() - cpu_start);
    ordered_json json{{"n", problem.size()},
                      {"solver", to_string(solver)},
                      {"seconds", seconds},
                      {"cpu_seconds", cpu},
                      {"objective", result.objective},
                      {"lower_bound", result.lower_bound},
                      {"allowed_pairs", coseg::allowed_pair_count(problem)},
                      {"relative_gap", result.relative_gap},
                      {"reason", to_string(result.reason)},
                      {"iterations", result.iterations},
                      {"passes", result.passes},
                      {"working_pairs", result.working_pairs},
                      {"nonzero_groups", result.nonzero_groups},
                      {"peak_megabytes_so_far", memory.peak_megabytes(comm)}};
    if (settings.scope == PenaltyScope::rows && solver == SolverChoice::working_set) {
        json["pass"] = pass_figures(comm, problem, result, machine);
    }
    for (const int clusters : settings.clusters)
        json["cuts"].push_back(cut_figures(comm, result, problem.mesh_of, clusters, memory));
    return json;
}

/// Until rank 0 gets here too; the others sleep meanwhile, and leave it the machine.
void wait_for_root(const coseg::Comm& comm) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(comm.raw(), &request);
    for (int done = 0; done == 0;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

/// The case on rank 0 alone, on a problem of its own; null on the other ranks.
ordered_json measure_alone(const coseg::Comm& comm, int size, const Settings& settings,
                           const MemoryWatch& memory) {
    ordered_json alone;
    const coseg::Comm own = comm.split(comm.rank());
    if (comm.is_root())
        alone = measure(own, generate(own, size, settings), settings, SolverChoice::working_set, memory);
    wait_for_root(comm);
    return alone;
}

/// Wall seconds of one rank over those of all: of the solve, and of a pass where it is timed by itself.
ordered_json strong_scaling(const ordered_json& alone, const ordered_json& together) {
    const auto ratio = [&](const ordered_json::json_pointer& what) {
        return alone.at(what).get<double>() / together.at(what).get<double>();
    };
    ordered_json scaling{{"one_rank", alone}, {"solve", ratio(ordered_json::json_pointer("/seconds"))}};
    if (alone.contains("pass"))
        scaling["pass"] = ratio(ordered_json::json_pointer("/pass/wall_seconds_per_pass"));
    return scaling;
}

void run(const Settings& settings) {
    const coseg::PetscSession session({});
    const coseg::Comm comm(MPI_COMM_WORLD);
    const MemoryWatch memory;
    ordered_json report{{"version", COSEG_VERSION},      {"build", COSEG_BUILD_TYPE},
                        {"ranks", comm.size()},          {"scope", to_string(settings.scope)},
                        {"lambda", settings.lambda},     {"gap", settings.gap},
                        {"features", features},          {"bins", bins},
                        {"cases", ordered_json::array()}};
    for (const int size : settings.sizes) {
        ordered_json alone;
        if (settings.strong) alone = measure_alone(comm, size, settings, memory);
        const coseg::SubspaceProblem problem = generate(comm, size, settings);
        report["cases"].push_back(measure(comm, problem, settings, SolverChoice::working_set, memory));
        if (settings.strong && comm.is_root())
            report["cases"].back()["strong_scaling"] = strong_scaling(alone, report["cases"].back());
        if (settings.scope == PenaltyScope::rows && size <= settings.dense_up_to) {
            report["cases"].push_back(measure(comm, problem, settings, SolverChoice::dense, memory));
        }
    }
    if (comm.is_root()) std::cout << report.dump(2) << std::endl;
}

int program(int argc, char** argv) {
    Settings settings;
    CLI::App app("Cost of the subspace solvers");
    app.add_option("--sizes", settings.sizes, "Numbers of patches")->delimiter(',')->capture_default_str();
    app.add_option("--dense-up-to", settings.dense_up_to, "Largest N for the dense form")
        ->capture_default_str();
    coseg::add_enum_option(app, "--scope", settings.scope, "What lambda's squared sums run over");
    app.add_option("--lambda", settings.lambda, "Penalty of the scope")->capture_default_str();
    app.add_option("--links", settings.links,
                   "Mesh scope: meshes in which a patch may have matches; 0 is the default rule")
        ->capture_default_str();
    app.add_option("--clusters", settings.clusters, "Also cut the answer into so many clusters")
        ->delimiter(',');
    app.add_option("--gap", settings.gap, "Relative gap")->capture_default_str();
    app.add_flag("--strong", settings.strong,
                 "Solve on one rank first, and print how much longer that takes");
    return coseg::parse_and_run(app, argc, argv, [&] { run(settings); });
}

}  // namespace

int main(int argc, char** argv) { return coseg::run_with_mpi(argc, argv, program); }
