#include "solvers/spectral/spectral_embedding.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "solvers/affinity/graph_components.hpp"
#include "solvers/petsc/petsc_handle.hpp"
#include "solvers/spectral/served_product.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// Eigenpairs of the operator, values descending; vectors on all ranks, orthonormal columns over all patches.
struct EigenPairs {
    std::vector<double> values;
    Eigen::MatrixXd vectors;

    void append(double value, const Eigen::VectorXd& vector) {
        values.push_back(value);
        vectors.conservativeResize(vector.size(), vectors.cols() + 1);
        vectors.col(vectors.cols() - 1) = vector;
    }
};

/// The operator whose eigenvectors are wanted. Rows set aside keep their place with eigenvalue -2, below all
/// others.
struct CutOperator {
    SparseRows matrix;
    std::vector<int> rows;
    std::vector<std::vector<int>> components;
    std::vector<double> degree;  ///< all patches; 0 where set aside
};

SparseRows diagonal_rows(const SparseRows& like, const std::vector<double>& diagonal) {
    std::vector<SparseEntry> entries;
    for (auto i = like.rows.begin; i < like.rows.end; ++i) {
        const double value = diagonal[at(i)];
        if (value != 0.0) entries.push_back({static_cast<int>(i), static_cast<int>(i), value});
    }
    return rows_from_entries(like.size, like.rows, std::move(entries));
}

SparseRows plus_diagonal(const SparseRows& matrix, const std::vector<double>& diagonal) {
    const SparseRows addend = diagonal_rows(matrix, diagonal);
    const WeightedMatrix terms[] = {{&matrix, 1.0}, {&addend, 1.0}};
    return weighted_sum(terms);
}

/// v_ij -> v_ij (q_i q_j): the product in parentheses keeps the matrix symmetric to the last bit.
void scale_both_sides(SparseRows& matrix, const std::vector<double>& q) {
    for (std::size_t r = 0; r < at(matrix.local_rows()); ++r) {
        const double row_factor = q[at(matrix.rows.begin) + r];
        for (auto k = at(matrix.offsets[r]); k < at(matrix.offsets[r + 1]); ++k) {
            matrix.values[k] *= row_factor * q[at(matrix.columns[k])];
        }
    }
}

std::vector<int> rows_of(const std::vector<std::vector<int>>& components) {
    std::vector<int> rows;
    for (const std::vector<int>& members : components)
        rows.insert(rows.end(), members.begin(), members.end());
    std::sort(rows.begin(), rows.end());
    return rows;
}

void refuse_too_few(std::size_t rows, int parts) {
    if (rows == 0) {
        throw AgreedError(ExitCode::input,
                          "no two patches are similar enough to be linked, so there is nothing to "
                          "cut; lower alpha, beta or lambda, or raise the adjacency weight");
    }
    if (rows < at(parts)) {
        throw AgreedError(ExitCode::input,
                          std::to_string(parts) + " parts are asked for, but only " + std::to_string(rows) +
                              " patches are linked to others; ask for fewer parts or more patches");
    }
}

CutOperator cut_operator(const Comm& comm, const SparseRows& affinity, int parts, double offset) {
    CutOperator result;
    result.components = main_components(connected_components(comm, affinity), parts);
    result.rows = rows_of(result.components);
    refuse_too_few(result.rows.size(), parts);
    const auto size = at(affinity.size);
    const std::vector<double> sums = row_sums_global(comm, affinity);
    result.degree.assign(size, 0.0);
    std::vector<double> inverse_root(size, 0.0);
    std::vector<double> aside(size, -2.0);
    for (const int row : result.rows) {
        const auto i = at(row);
        result.degree[i] = sums[i] + 2.0 * offset;
        inverse_root[i] = 1.0 / std::sqrt(result.degree[i]);
        aside[i] = 0.0;
    }
    result.matrix = offset == 0.0 ? affinity : plus_diagonal(affinity, std::vector<double>(size, offset));
    scale_both_sides(result.matrix, inverse_root);
    if (result.rows.size() < size) result.matrix = plus_diagonal(result.matrix, aside);
    return result;
}

/// D^1/2 times the indicator of each component: eigenvectors of eigenvalue 1.
EigenPairs component_eigenpairs(const CutOperator& op) {
    EigenPairs pairs;
    for (const std::vector<int>& members : op.components) {
        Eigen::VectorXd vector = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(op.degree.size()));
        double squares = 0.0;
        for (const int i : members) squares += op.degree[at(i)];
        for (const int i : members) vector(i) = std::sqrt(op.degree[at(i)] / squares);
        pairs.append(1.0, vector);
    }
    return pairs;
}

/// Entry i: that of patch i in the unit indicator D^1/2 1_m of its mesh m; 0 where set aside.
std::vector<double> mesh_indicators(const CutOperator& op, const std::vector<int>& mesh_of) {
    std::vector<double> squares(at(*std::max_element(mesh_of.begin(), mesh_of.end())) + 1, 0.0);
    const auto mesh = [&](int i) { return at(mesh_of[at(i)]); };
    for (const int i : op.rows) squares[mesh(i)] += op.degree[at(i)];
    std::vector<double> entries(op.degree.size(), 0.0);
    for (const int i : op.rows) {
        const auto k = at(i);
        entries[k] = std::sqrt(op.degree[k] / squares[mesh(i)]);
    }
    return entries;
}

/// Subtracts tau times the projection on the meshes' indicators less what lies in the span of `known`.
void balance_dense(const CutOperator& op, const std::vector<int>& mesh_of, double tau,
                   Eigen::MatrixXd& dense) {
    const std::vector<double> indicator = mesh_indicators(op, mesh_of);
    Eigen::MatrixXd q =
        Eigen::MatrixXd::Zero(dense.rows(), *std::max_element(mesh_of.begin(), mesh_of.end()) + 1);
    for (const int i : op.rows) q(i, mesh_of[at(i)]) = indicator[at(i)];
    const Eigen::MatrixXd known = component_eigenpairs(op).vectors;
    q -= (known * (known.transpose() * q)).eval();
    dense -= tau * (q * q.transpose());
}

EigenPairs dense_eigenpairs(const Comm& comm, const CutOperator& op, int count,
                            const SpectralOptions& options, const std::vector<int>& mesh_of) {
    const SparseRows all = gather_rows(comm, op.matrix);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(all.size, all.size);
    for (std::size_t r = 0; r < at(all.size); ++r) {
        for (auto k = at(all.offsets[r]); k < at(all.offsets[r + 1]); ++k) {
            dense(static_cast<Eigen::Index>(r), all.columns[k]) = all.values[k];
        }
    }
    if (options.mesh_balance > 0.0) balance_dense(op, mesh_of, options.mesh_balance, dense);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
    if (solver.info() != Eigen::Success) {
        throw AgreedError(ExitCode::not_converged,
                          "the dense eigenvalue problem of the cut did not converge");
    }
    EigenPairs pairs;
    for (Eigen::Index k = 1; k <= count; ++k) {
        pairs.append(solver.eigenvalues()(all.size - k), solver.eigenvectors().col(all.size - k));
    }
    return pairs;
}

PetscVector to_petsc(Mat matrix, const Eigen::VectorXd& global) {
    PetscVector vector;
    check(MatCreateVecs(matrix, vector.out(), nullptr), "MatCreateVecs");
    PetscScalar* values = nullptr;
    check(VecGetArray(vector.get(), &values), "VecGetArray");
    std::copy_n(global.data(), global.size(), values);
    check(VecRestoreArray(vector.get(), &values), "VecRestoreArray");
    return vector;
}

Eigen::VectorXd to_eigen(Vec vector, Eigen::Index size) {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(vector, &values), "VecGetArrayRead");
    Eigen::VectorXd copy = Eigen::Map<const Eigen::VectorXd>(values, size);
    check(VecRestoreArrayRead(vector, &values), "VecRestoreArrayRead");
    return copy;
}

/// Another start for every `trial`: the complement of what a start has found holds nothing of the other
/// copies of a multiple eigenvalue in its direction. Zero where rows are set aside, so that the Krylov space
/// stays clear of them.
Eigen::VectorXd start_vector(const CutOperator& op, std::uint64_t trial) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(op.degree.size()));
    for (const int i : op.rows)
        start(i) = 1.0 - 2.0 * uniform_of(hash_words({trial, static_cast<std::uint64_t>(i)}));
    return start;
}

/// Notes how far the first pair that has not converged is from convergence.
struct Progress {
    double residual = 0.0;
};

// NOLINTNEXTLINE(readability-function-size): SLEPc prescribes the parameters
PetscErrorCode note_progress(EPS /*solver*/, PetscInt /*iteration*/, PetscInt converged,
                             PetscScalar* /*real*/, PetscScalar* /*imaginary*/, PetscReal* estimates,
                             PetscInt estimated, void* context) {
    if (converged < estimated) static_cast<Progress*>(context)->residual = estimates[converged];
    return 0;
}

/// The user's options may choose the method and its basis, not what is asked for.
void configure(EPS solver, Mat matrix, int wanted, const SpectralOptions& options, Progress& progress) {
    PetscInt size = 0;
    PetscInt basis = 0;
    PetscInt projected = 0;
    check(MatGetSize(matrix, &size, nullptr), "MatGetSize");
    check(EPSSetOperators(solver, matrix, nullptr), "EPSSetOperators");
    check(EPSSetProblemType(solver, EPS_HEP), "EPSSetProblemType");
    check(EPSSetType(solver, EPSKRYLOVSCHUR), "EPSSetType");
    basis = std::min<PetscInt>(size, std::max(2 * wanted + 40, 60));
    check(EPSSetDimensions(solver, wanted, basis, PETSC_DEFAULT), "EPSSetDimensions");
    check(EPSSetTolerances(solver, options.tolerance, options.max_restarts), "EPSSetTolerances");
    check(EPSMonitorSet(solver, note_progress, &progress, nullptr), "EPSMonitorSet");
    check(EPSSetFromOptions(solver), "EPSSetFromOptions");
    check(EPSGetDimensions(solver, nullptr, &basis, &projected), "EPSGetDimensions");
    check(EPSSetDimensions(solver, wanted, basis, projected), "EPSSetDimensions");
    check(EPSSetWhichEigenpairs(solver, EPS_LARGEST_REAL), "EPSSetWhichEigenpairs");
    check(EPSSetConvergenceTest(solver, EPS_CONV_ABS), "EPSSetConvergenceTest");
}

void refuse_unconverged(EPS solver, int wanted, const Progress& progress) {
    EPSConvergedReason reason = EPS_CONVERGED_ITERATING;
    PetscInt converged = 0;
    PetscInt iterations = 0;
    check(EPSGetConvergedReason(solver, &reason), "EPSGetConvergedReason");
    check(EPSGetConverged(solver, &converged), "EPSGetConverged");
    check(EPSGetIterationNumber(solver, &iterations), "EPSGetIterationNumber");
    if (reason > 0 && converged >= wanted) return;
    throw Error(ExitCode::not_converged,
                "the cut's eigenvectors did not converge: " + std::to_string(converged) + " of " +
                    std::to_string(wanted) + " after " + std::to_string(iterations) +
                    " restarts, the next with residual " + significant(progress.residual) +
                    "; give the solver a larger basis (-- -eps_ncv 200)");
}

/// The `wanted` largest eigenpairs orthogonal to `known`, from start number `trial`.
struct EigenSearch {
    const EigenPairs& known;
    int wanted = 1;
    std::uint64_t trial = 0;
};

/// On the root alone, while the other ranks serve products.
EigenPairs root_eigenpairs(const CutOperator& op, ServedProduct& product, const EigenSearch& search,
                           const SpectralOptions& options) {
    const PetscMatrix matrix = shell_matrix(product);
    std::vector<PetscVector> deflated;
    std::vector<Vec> handles;
    for (Eigen::Index k = 0; k < search.known.vectors.cols(); ++k) {
        deflated.push_back(to_petsc(matrix.get(), search.known.vectors.col(k)));
        handles.push_back(deflated.back().get());
    }
    const PetscVector start = to_petsc(matrix.get(), start_vector(op, search.trial));
    Vec initial = start.get();
    Progress progress;
    EigenSolver solver;
    check(EPSCreate(PETSC_COMM_SELF, solver.out()), "EPSCreate");
    configure(solver.get(), matrix.get(), search.wanted, options, progress);
    if (!handles.empty()) {
        check(EPSSetDeflationSpace(solver.get(), static_cast<PetscInt>(handles.size()), handles.data()),
              "EPSSetDeflationSpace");
    }
    check(EPSSetInitialSpace(solver.get(), 1, &initial), "EPSSetInitialSpace");
    check(EPSSolve(solver.get()), "EPSSolve");
    refuse_unconverged(solver.get(), search.wanted, progress);
    EigenPairs found;
    PetscVector vector;
    check(MatCreateVecs(matrix.get(), vector.out(), nullptr), "MatCreateVecs");
    for (int k = 0; k < search.wanted; ++k) {
        PetscScalar value = 0.0;
        check(EPSGetEigenpair(solver.get(), k, &value, nullptr, vector.get(), nullptr), "EPSGetEigenpair");
        found.append(value, to_eigen(vector.get(), static_cast<Eigen::Index>(op.degree.size())));
    }
    return found;
}

/// The same on all ranks, with the root's bits. Collective.
EigenPairs krylov_eigenpairs(const Comm& comm, const CutOperator& op, ServedProduct& product,
                             const EigenSearch& search, const SpectralOptions& options) {
    EigenPairs found;
    // The root releases the others however its step ends, so that no rank waits for a product that does not
    // come.
    agree(comm, [&] {
        if (comm.is_root()) {
            const ServedProduct::Release release(product);
            found = root_eigenpairs(op, product, search, options);
        } else {
            product.serve();
        }
    });
    found.values.resize(at(search.wanted));
    found.vectors.resize(static_cast<Eigen::Index>(op.degree.size()), search.wanted);
    MPI_Bcast(found.values.data(), search.wanted, MPI_DOUBLE, 0, comm.raw());
    for (Eigen::Index k = 0; k < search.wanted; ++k) {
        MPI_Bcast(found.vectors.col(k).data(), static_cast<int>(found.vectors.rows()), MPI_DOUBLE, 0,
                  comm.raw());
    }
    return found;
}

void sort_descending(EigenPairs& pairs) {
    std::vector<Eigen::Index> order(pairs.values.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return pairs.values[at(a)] > pairs.values[at(b)];
    });
    EigenPairs sorted;
    for (const Eigen::Index k : order) sorted.append(pairs.values[at(k)], pairs.vectors.col(k));
    pairs = std::move(sorted);
}

/// Replaces the smallest pairs by larger ones that the first solve missed, until the complement has none.
/// This search uses a coarse tolerance, which halves the work: the error of an eigenvalue is of the order of
/// the squared residual.
void find_missed_pairs(const Comm& comm, const CutOperator& op, ServedProduct& product,
                       const SpectralOptions& options, EigenPairs& pairs) {
    SpectralOptions coarse = options;
    coarse.tolerance = std::max(options.tolerance, 1e-5);
    const std::size_t count = pairs.values.size();
    for (std::size_t round = 0; round < count; ++round) {
        const EigenPairs look = krylov_eigenpairs(comm, op, product, {pairs, 1, round + 1}, coarse);
        if (look.values[0] <= pairs.values.back() + 1e-8) return;
        const EigenPairs next = krylov_eigenpairs(comm, op, product, {pairs, 1, round + 1}, options);
        pairs.append(next.values[0], next.vectors.col(0));
        sort_descending(pairs);
        pairs.values.resize(count);
        pairs.vectors.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(count));
    }
}

/// Only the root's product needs it; the span of the components' vectors is left to deflation.
GroupBalance mesh_balance(const CutOperator& op, const SpectralOptions& options,
                          const std::vector<int>& mesh_of) {
    if (options.mesh_balance <= 0.0) return {};
    return {options.mesh_balance, mesh_of, mesh_indicators(op, mesh_of)};
}

EigenPairs sparse_eigenpairs(const Comm& comm, const CutOperator& op, int count,
                             const SpectralOptions& options, const std::vector<int>& mesh_of) {
    EigenPairs pairs = options.offset == 0.0 ? component_eigenpairs(op) : EigenPairs{};
    const int wanted = count - static_cast<int>(pairs.values.size());
    if (wanted <= 0) return pairs;
    ServedProduct product(comm, op.matrix,
                          comm.is_root() ? mesh_balance(op, options, mesh_of) : GroupBalance{});
    const EigenPairs found = krylov_eigenpairs(comm, op, product, {pairs, wanted, 0}, options);
    for (int k = 0; k < wanted; ++k) pairs.append(found.values[at(k)], found.vectors.col(k));
    if (count < static_cast<int>(op.rows.size())) find_missed_pairs(comm, op, product, options, pairs);
    return pairs;
}

Eigen::MatrixXd back_multiplied(const CutOperator& op, const Eigen::MatrixXd& vectors) {
    const auto rows = static_cast<Eigen::Index>(op.rows.size());
    Eigen::MatrixXd coordinates(rows, vectors.cols());
    for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
        double squares = 0.0;
        for (Eigen::Index r = 0; r < rows; ++r) {
            const int i = op.rows[at(r)];
            const double value = vectors(i, k) / std::sqrt(op.degree[at(i)]);
            coordinates(r, k) = value;
            squares += value * value;
        }
        coordinates.col(k) *= std::sqrt(static_cast<double>(rows) / squares);
    }
    return coordinates;
}

}  // namespace

SpectralEmbedding spectral_embedding(const Comm& comm, const SparseRows& affinity, int parts, int count,
                                     const SpectralOptions& options, const std::vector<int>& mesh_of) {
    if (options.mesh_balance > 0.0 && (options.offset != 0.0 || std::ssize(mesh_of) != affinity.size)) {
        throw AgreedError(ExitCode::internal,
                          "a cut with mesh balance needs the mesh of each patch, and no offset");
    }
    const CutOperator op = cut_operator(comm, affinity, parts, options.offset);
    const int vectors = std::min(count, static_cast<int>(op.rows.size()));
    const EigenPairs pairs = affinity.size <= dense_rows
                                 ? dense_eigenpairs(comm, op, vectors, options, mesh_of)
                                 : sparse_eigenpairs(comm, op, vectors, options, mesh_of);
    SpectralEmbedding embedding;
    embedding.rows = op.rows;
    embedding.eigenvalues = pairs.values;
    embedding.coordinates = back_multiplied(op, pairs.vectors);
    for (const int i : op.rows) embedding.degrees.push_back(op.degree[at(i)]);
    return embedding;
}

}  // namespace coseg
