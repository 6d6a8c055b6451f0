// Measures the eigenproblem of the cut: products, restarts, seconds and residuals of SLEPc's methods, on a
// generated affinity like that of a collection.
//
//   mpirun -n P spectral_bench [--meshes 20] [--patches 150] [--links 19] [--vectors 1,5,20] [--warm]
//                              [--tolerance 1e-10] [--write FILE] [-- -eps_type lobpcg]
//
// --warm solves the same graph with its adjacency a third stronger, from the eigenvectors of the first.
// --write leaves the operator as raw arrays for bench/spectral_peers.py. Products are counted, because
// seconds depend on what else the machine does.

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/mpi_program.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "solvers/spectral/leading_eigenpairs.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/stopwatch.hpp"

namespace {

using coseg::at;
using coseg::Comm;
using nlohmann::ordered_json;

struct Settings {
    int meshes = 20;
    int patches = 150;  // of a mesh
    int links = 19;     // other meshes that a patch is linked to
    int parts = 5;
    std::vector<int> vectors{1, 5, 20};
    double tolerance = 1e-10;
    bool warm = false;
    std::string write;
    std::vector<std::string> petsc;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Patch i of a mesh is of part i * parts / patches, and a neighbour of i + 1 and i + 5. In each linked mesh
/// it resembles one patch, nine times of ten of the same part.
class CollectionGraph {
  public:
    explicit CollectionGraph(const Settings& settings) : settings_(settings) {}

    [[nodiscard]] std::int64_t size() const {
        return static_cast<std::int64_t>(settings_.meshes) * settings_.patches;
    }

    /// Entries and their transposes, of the patches of `rows`. Adjacency has the weight `adjacency` times
    /// that of the links.
    [[nodiscard]] std::vector<coseg::SparseEntry> entries(coseg::BlockRange rows, double adjacency) const {
        std::vector<coseg::SparseEntry> result;
        const double neighbor = adjacency * settings_.links / 4.0;
        for (auto i = rows.begin; i < rows.end; ++i) {
            coseg::SeededStream random(coseg::hash_words({17, static_cast<std::uint64_t>(i)}));
            const auto mesh = static_cast<int>(i / settings_.patches);
            const auto place = static_cast<int>(i % settings_.patches);
            for (const int step : {1, 5}) {
                if (place + step < settings_.patches) add(i, i + step, neighbor * random.uniform(), result);
            }
            for (int k = 1; k <= settings_.links; ++k) {
                const int other = (mesh + k * stride()) % settings_.meshes;
                if (other != mesh) add(i, linked(other, place, random), 0.5 + random.uniform(), result);
            }
        }
        return result;
    }

  private:
    [[nodiscard]] int stride() const { return std::max(1, (settings_.meshes - 1) / settings_.links); }
    [[nodiscard]] std::int64_t linked(int mesh, int place, coseg::SeededStream& random) const {
        const int length = settings_.patches / settings_.parts;
        const int part = random.uniform() < 0.9 ? std::min(place / length, settings_.parts - 1)
                                                : static_cast<int>(random.uniform() * settings_.parts);
        const auto step = static_cast<int>(random.uniform() * length);
        return static_cast<std::int64_t>(mesh) * settings_.patches + part * length + step;
    }
    static void add(std::int64_t i, std::int64_t j, double value, std::vector<coseg::SparseEntry>& entries) {
        entries.push_back({static_cast<int>(i), static_cast<int>(j), value});
        entries.push_back({static_cast<int>(j), static_cast<int>(i), value});
    }
    const Settings& settings_;
};

/// D^-1/2 S D^-1/2 and this rank's rows of its first eigenvector, D^1/2 1. Collective.
coseg::SparseRows operator_of(const Comm& comm, const Settings& settings, double adjacency,
                              coseg::EigenPairs& known) {
    const CollectionGraph graph(settings);
    const coseg::BlockRange rows =
        coseg::block_range(graph.size(), comm.size(), comm.rank(), coseg::row_tile);
    coseg::SparseRows matrix = exchange_entries(comm, graph.size(), graph.entries(rows, adjacency));
    const std::vector<double> degree = row_sums_global(comm, matrix);
    double total = 0.0;
    for (const double d : degree) total += d;
    Eigen::VectorXd first(rows.size());
    for (std::size_t r = 0; r < at(rows.size()); ++r) {
        const double own = degree[at(rows.begin) + r];
        first(static_cast<Eigen::Index>(r)) = std::sqrt(own / total);
        for (auto k = at(matrix.offsets[r]); k < at(matrix.offsets[r + 1]); ++k)
            matrix.values[k] /= std::sqrt(own * degree[at(matrix.columns[k])]);
    }
    known.append(1.0, 0.0, first);
    return matrix;
}

Eigen::MatrixXd random_starts(coseg::BlockRange rows, int count) {
    Eigen::MatrixXd starts(rows.size(), count);
    for (int k = 0; k < count; ++k) {
        for (auto i = rows.begin; i < rows.end; ++i) {
            const auto row = static_cast<std::uint64_t>(i);
            starts(i - rows.begin, k) =
                coseg::uniform_of(coseg::hash_words({static_cast<std::uint64_t>(k), row})) - 0.5;
        }
    }
    return starts;
}

/// The largest norm of A v - value v. Collective.
double worst_residual(const coseg::RowProduct& product, const coseg::EigenPairs& pairs) {
    double worst = 0.0;
    coseg::PetscVector x;
    coseg::PetscVector y;
    coseg::check(MatCreateVecs(product.matrix(), x.out(), y.out()), "MatCreateVecs");
    for (std::size_t k = 0; k < pairs.values.size(); ++k) {
        PetscScalar* values = nullptr;
        double norm = 0.0;
        coseg::check(VecGetArrayWrite(x.get(), &values), "VecGetArrayWrite");
        std::copy_n(pairs.vectors.col(static_cast<Eigen::Index>(k)).data(), pairs.vectors.rows(), values);
        coseg::check(VecRestoreArrayWrite(x.get(), &values), "VecRestoreArrayWrite");
        coseg::check(MatMult(product.matrix(), x.get(), y.get()), "MatMult");
        coseg::check(VecAXPY(y.get(), -pairs.values[k], x.get()), "VecAXPY");
        coseg::check(VecNorm(y.get(), NORM_2, &norm), "VecNorm");
        worst = std::max(worst, norm);
    }
    return worst;
}

/// Collective; the figures are the same on all ranks but for the seconds.
ordered_json solved(const Comm& comm, const coseg::RowProduct& product, const coseg::EigenPairs& known,
                    const Eigen::MatrixXd& starts, coseg::EigenRequest request, coseg::EigenPairs& pairs) {
    MPI_Barrier(comm.raw());
    const coseg::Stopwatch watch;
    const double begin = cpu_seconds();
    const std::int64_t before = product.count();
    try {
        pairs = leading_eigenpairs(comm, product, known, starts, request);
    } catch (const coseg::AgreedError& error) {
        return {{"vectors", request.wanted}, {"failed", error.what()}};
    }
    const double cpu = cpu_seconds() - begin;
    double all_cpu = 0.0;
    MPI_Allreduce(&cpu, &all_cpu, 1, MPI_DOUBLE, MPI_SUM, comm.raw());
    ordered_json figures{{"vectors", request.wanted},
                         {"products", product.count() - before},
                         {"wall_seconds", watch.seconds()},
                         {"cpu_seconds", all_cpu}};
    figures["worst_residual"] = worst_residual(product, pairs);
    figures["last_eigenvalue"] = pairs.values.back();
    return figures;
}

/// Raw arrays: rows and entries, offsets, columns, values, first eigenvector. One rank.
void write_operator(const std::string& path, const coseg::SparseRows& matrix,
                    const coseg::EigenPairs& known) {
    std::ofstream file(path, std::ios::binary);
    const auto put = [&](const auto* from, std::size_t count) {
        file.write(reinterpret_cast<const char*>(from), static_cast<std::streamsize>(count * sizeof(*from)));
    };
    const std::int64_t sizes[] = {matrix.size, static_cast<std::int64_t>(matrix.values.size())};
    put(sizes, 2);
    put(matrix.offsets.data(), matrix.offsets.size());
    put(matrix.columns.data(), matrix.columns.size());
    put(matrix.values.data(), matrix.values.size());
    put(known.vectors.col(0).data(), at(matrix.size));
}

void measure(const Comm& comm, const Settings& settings) {
    const coseg::PetscSession session(settings.petsc);
    ordered_json json{{"ranks", comm.size()}, {"options", settings.petsc}};
    coseg::EigenPairs known;
    coseg::SparseRows matrix = operator_of(comm, settings, 1.0, known);
    if (!settings.write.empty() && comm.size() == 1) write_operator(settings.write, matrix, known);
    const coseg::BlockRange rows = matrix.rows;
    json["rows"] = matrix.size;
    json["entries"] = all_sum(comm, static_cast<std::int64_t>(matrix.values.size()));
    const coseg::RowProduct product(comm, std::move(matrix));
    std::vector<coseg::EigenPairs> found(settings.vectors.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        const int wanted = settings.vectors[k];
        json["cold"].push_back(solved(comm, product, known, random_starts(rows, wanted),
                                      {wanted, settings.tolerance, 2000}, found[k]));
    }
    if (settings.warm) {
        coseg::EigenPairs known_next;
        const coseg::RowProduct next(comm, operator_of(comm, settings, 4.0 / 3.0, known_next));
        for (std::size_t k = 0; k < found.size(); ++k) {
            const int wanted = settings.vectors[k];
            const coseg::EigenRequest request{wanted, settings.tolerance, 2000};
            coseg::EigenPairs pairs;
            json["next_graph_cold"].push_back(
                solved(comm, next, known_next, random_starts(rows, wanted), request, pairs));
            // One vector where the method takes one: the sum holds all directions.
            Eigen::MatrixXd starts(rows.size(), found[k].vectors.cols() + 1);
            starts << found[k].vectors.rowwise().sum(), found[k].vectors;
            const bool takes_block = !settings.petsc.empty();
            json["next_graph_warm"].push_back(
                solved(comm, next, known_next,
                       takes_block ? Eigen::MatrixXd(starts.rightCols(starts.cols() - 1))
                                   : Eigen::MatrixXd(starts.leftCols(1)),
                       request, pairs));
        }
    }
    if (comm.is_root()) std::cout << json.dump(2) << "\n";
}

int program(int argc, char** argv) {
    Settings settings;
    CLI::App app("Measures the eigenproblem of the cut.");
    app.add_option("--meshes", settings.meshes);
    app.add_option("--patches", settings.patches, "Patches of a mesh");
    app.add_option("--links", settings.links, "Other meshes that a patch is linked to");
    app.add_option("--parts", settings.parts);
    app.add_option("--vectors", settings.vectors)->delimiter(',');
    app.add_option("--tolerance", settings.tolerance);
    app.add_flag("--warm", settings.warm, "Also solve a neighbouring graph from the first one's vectors");
    app.add_option("--write", settings.write, "Write the operator, on one rank");
    app.add_option("petsc", settings.petsc, "Words for SLEPc, behind --");
    return coseg::parse_and_run(app, argc, argv, [&] { measure(Comm(MPI_COMM_WORLD), settings); });
}

}  // namespace

int main(int argc, char** argv) { return coseg::run_with_mpi(argc, argv, program); }
