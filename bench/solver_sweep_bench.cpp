// Tests whether the subspace solvers reach a gap over the whole range of the penalties. It solves small
// problems of three kinds in both scopes, and prints one line of JSON for each case, and a summary.
//
//   mpirun -n P solver_sweep_bench [--kinds random,histogram,counts] [--size 40] [--gaps 1e-4,1e-8]
//                                  [--seconds 10] [--alphas 0,.01,.1,.5] [--betas 0,.01,.1,.5]
//                                  [--lambdas 0,1e-3,1e-2,.1,1,100,1e4] [--scopes rows,meshes]
//
// The penalties are those of columns of unit length. For counts they are multiplied by the mean squared
// length of a column, so that they have the same effect.

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/mpi_program.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "solvers/row_scope/pass_clock.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/base/seeded_random.hpp"

namespace {

using coseg::PenaltyScope;
using coseg::SubspaceProblem;
using nlohmann::ordered_json;

enum class Kind { random, histogram, counts };
constexpr std::array<coseg::EnumName<Kind>, 3> enum_names(Kind /*type*/) {
    return {{{Kind::random, "random"}, {Kind::histogram, "histogram"}, {Kind::counts, "counts"}}};
}

struct Settings {
    std::vector<Kind> kinds{Kind::random, Kind::histogram, Kind::counts};
    std::vector<PenaltyScope> scopes{PenaltyScope::rows, PenaltyScope::meshes};
    std::vector<double> alphas{0.0, 0.01, 0.1, 0.5};
    std::vector<double> betas{0.0, 0.01, 0.1, 0.5};
    std::vector<double> lambdas{0.0, 1e-3, 1e-2, 0.1, 1.0, 100.0, 1e4};
    std::vector<double> gaps{1e-4, 1e-8};
    int size = 40;
    int rows = 20;
    double seconds = 10.0;
    coseg::SolverChoice solver = coseg::SolverChoice::automatic;
};

constexpr int features = 5;
constexpr int parts = 5;

/// A column of one patch: independent entries, or bumps around its part's centres.
Eigen::VectorXd column_of(Kind kind, int rows, int feature, int patch) {
    const auto h = static_cast<std::uint64_t>(feature);
    coseg::SeededStream part(coseg::hash_words({19, h, static_cast<std::uint64_t>(patch % parts)}));
    coseg::SeededStream own(coseg::hash_words({17, h, static_cast<std::uint64_t>(patch)}));
    Eigen::VectorXd x = Eigen::VectorXd::Zero(rows);
    if (kind == Kind::random) {
        for (int k = 0; k < rows; ++k) x[k] = std::pow(own.uniform(), 3.0);
        return x.normalized();
    }
    for (int bump = 0; bump < 3; ++bump) {
        const double centre = part.uniform(0.0, rows) + 0.04 * rows * own.normal();
        const double width = rows * part.uniform(0.02, 0.08);
        const double mass = own.uniform(0.2, 1.2);
        for (int k = 0; k < rows; ++k) {
            x[k] += mass * own.uniform(0.5, 1.5) * std::exp(-0.5 * std::pow((k - centre) / width, 2));
        }
    }
    if (kind == Kind::counts) return (200.0 / x.sum() * x).array().round().matrix();
    return (x / x.sum()).cwiseSqrt();
}

SubspaceProblem generate(Kind kind, const Settings& settings) {
    SubspaceProblem problem;
    std::vector<Eigen::MatrixXd> matrices;
    for (int h = 0; h < features; ++h) {
        Eigen::MatrixXd x(settings.rows, settings.size);
        for (int j = 0; j < settings.size; ++j) x.col(j) = column_of(kind, settings.rows, h, j);
        matrices.push_back(std::move(x));
    }
    problem.features = matrices;
    for (int j = 0; j < settings.size; ++j) problem.mesh_of.push_back(j / 10);
    return problem;
}

double mean_square(const SubspaceProblem& problem) {
    double squares = 0.0;
    for (const Eigen::MatrixXd& x : problem.features.matrices()) squares += x.squaredNorm();
    return squares / static_cast<double>(problem.size() * problem.feature_count());
}

struct Summary {
    int cases = 0;
    int reached = 0;
    double slowest = 0.0;
    double total = 0.0;
};

void run_case(const coseg::Comm& comm, const SubspaceProblem& problem, Kind kind, const Settings& settings,
              double gap, Summary& summary) {
    const double start = coseg::PassClock::cpu_seconds();
    const coseg::SolveResult result = solve_subspace(
        comm, problem, {.gap = gap, .max_seconds = settings.seconds, .solver = settings.solver});
    const double seconds = coseg::all_max(comm, coseg::PassClock::cpu_seconds() - start);
    ++summary.cases;
    summary.reached += result.relative_gap <= gap ? 1 : 0;
    summary.slowest = std::max(summary.slowest, seconds);
    summary.total += seconds;
    const ordered_json line{{"kind", coseg::to_string(kind)},
                            {"scope", to_string(problem.scope)},
                            {"alpha", problem.alpha},
                            {"beta", problem.beta},
                            {"lambda", problem.lambda},
                            {"gap", gap},
                            {"relative_gap", result.relative_gap},
                            {"reason", to_string(result.reason)},
                            {"cpu_seconds", seconds},
                            {"iterations", result.iterations},
                            {"passes", result.passes},
                            {"objective", result.objective},
                            {"share_left", result.objective / result.objective_at_zero},
                            {"nonzero_groups", result.nonzero_groups}};
    if (comm.is_root()) std::cout << line.dump() << std::endl;
}

void run(const Settings& settings) {
    const coseg::Comm comm(MPI_COMM_WORLD);
    Summary summary;
    for (const Kind kind : settings.kinds) {
        SubspaceProblem problem = generate(kind, settings);
        const double scale = kind == Kind::counts ? mean_square(problem) : 1.0;
        for (const PenaltyScope scope : settings.scopes) {
            problem.scope = scope;
            for (const double lambda : settings.lambdas) {
                for (const double alpha : settings.alphas) {
                    for (const double beta : settings.betas) {
                        problem.lambda = lambda * scale;
                        problem.alpha = alpha * scale;
                        problem.beta = beta * scale;
                        for (const double gap : settings.gaps)
                            run_case(comm, problem, kind, settings, gap, summary);
                    }
                }
            }
        }
    }
    const ordered_json line{{"cases", summary.cases},
                            {"reached", summary.reached},
                            {"slowest_cpu_seconds", summary.slowest},
                            {"total_cpu_seconds", summary.total}};
    if (comm.is_root()) std::cout << line.dump() << std::endl;
}

int program(int argc, char** argv) {
    Settings settings;
    CLI::App app("Gaps of the subspace solvers over the range of the penalties");
    coseg::add_enum_list_option(app, "--kinds", settings.kinds, "What the columns are");
    coseg::add_enum_list_option(app, "--scopes", settings.scopes, "What lambda's squared sums run over");
    app.add_option("--alphas", settings.alphas)->delimiter(',')->capture_default_str();
    app.add_option("--betas", settings.betas)->delimiter(',')->capture_default_str();
    app.add_option("--lambdas", settings.lambdas)->delimiter(',')->capture_default_str();
    app.add_option("--gaps", settings.gaps)->delimiter(',')->capture_default_str();
    app.add_option("--size", settings.size, "Columns")->capture_default_str();
    app.add_option("--rows", settings.rows, "Rows of a feature")->capture_default_str();
    app.add_option("--seconds", settings.seconds, "Limit of a case")->capture_default_str();
    coseg::add_enum_option(app, "--solver", settings.solver, "How W is stored");
    return coseg::parse_and_run(app, argc, argv, [&] { run(settings); });
}

}  // namespace

int main(int argc, char** argv) { return coseg::run_with_mpi(argc, argv, program); }
