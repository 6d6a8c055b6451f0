#include "solvers/spectral/spectral_embedding.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "solvers/affinity/graph_components.hpp"
#include "solvers/spectral/leading_eigenpairs.hpp"
#include "solvers/spectral/row_product.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// The operator whose eigenvectors are wanted. Rows set aside keep their place with eigenvalue -2, below all
/// others.
struct CutOperator {
    SparseRows matrix;
    BlockRange own;         ///< the rows of this rank
    std::vector<int> rows;  ///< of all ranks
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
    const WeightedMatrix terms[] = {{matrix, 1.0}, {addend, 1.0}};
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

/// Takes the affinity.
CutOperator cut_operator(const Comm& comm, SparseRows affinity, int parts, double offset) {
    CutOperator result;
    result.own = affinity.rows;
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
    result.matrix =
        offset == 0.0 ? std::move(affinity) : plus_diagonal(affinity, std::vector<double>(size, offset));
    scale_both_sides(result.matrix, inverse_root);
    if (result.rows.size() < size) result.matrix = plus_diagonal(result.matrix, aside);
    return result;
}

/// This rank's rows of D^1/2 times the indicator of each component: eigenvectors of eigenvalue 1.
EigenPairs component_eigenpairs(const CutOperator& op, BlockRange rows) {
    EigenPairs pairs;
    for (const std::vector<int>& members : op.components) {
        Eigen::VectorXd vector = Eigen::VectorXd::Zero(rows.size());
        double squares = 0.0;
        for (const int i : members) squares += op.degree[at(i)];
        for (const int i : members) {
            if (rows.contains(i)) vector(i - rows.begin) = std::sqrt(op.degree[at(i)] / squares);
        }
        pairs.append(1.0, 0.0, vector);
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
    const Eigen::MatrixXd known = component_eigenpairs(op, {0, dense.rows()}).vectors;
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
        pairs.append(solver.eigenvalues()(all.size - k), 0.0,
                     solver.eigenvectors().col(all.size - k).segment(op.own.begin, op.own.size()));
    }
    return pairs;
}

/// Another start for every `trial`: the complement of what a start has found holds nothing of the other
/// copies of a multiple eigenvalue in its direction. Zero where rows are set aside, so that the Krylov space
/// stays clear of them.
Eigen::VectorXd start_vector(const CutOperator& op, std::uint64_t trial) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(op.own.size());
    for (auto i = op.own.begin; i < op.own.end; ++i) {
        if (op.degree[at(i)] > 0.0)
            start(i - op.own.begin) =
                1.0 - 2.0 * uniform_of(hash_words({trial, static_cast<std::uint64_t>(i)}));
    }
    return start;
}

/// Whether the complement of the pairs holds a larger eigenvalue than their smallest. A coarse look settles
/// it where that is out of reach of its residual; the next one starts from what it found. The error of an
/// eigenvalue is of the order of the squared residual.
bool misses_a_pair(const Comm& comm, const RowProduct& product, const EigenPairs& pairs,
                   Eigen::VectorXd start, EigenRequest request) {
    const double fine = request.tolerance;
    const double least = pairs.values.back() + 1e-8;
    for (const double coarse : {1e-3, 1e-5}) {
        request.tolerance = std::max(fine, coarse);
        const EigenPairs look = leading_eigenpairs(comm, product, pairs, start, request);
        if (look.values[0] + look.residuals[0] <= least) return false;
        if (look.values[0] > least) return true;
        start = look.vectors.col(0);
    }
    return false;
}

/// Replaces the smallest pairs by larger ones that the first solve missed, until the complement has none.
EigenPairs with_missed_pairs(const Comm& comm, const CutOperator& op, const RowProduct& product,
                             const EigenRequest& fine, EigenPairs pairs) {
    const std::size_t count = pairs.values.size();
    for (std::size_t round = 0; round < count; ++round) {
        const Eigen::VectorXd start = start_vector(op, round + 1);
        if (!misses_a_pair(comm, product, pairs, start, fine)) break;
        const EigenPairs next = leading_eigenpairs(comm, product, pairs, start, fine);
        pairs.append(next.values[0], next.residuals[0], next.vectors.col(0));
        pairs = sorted_descending(pairs);
        pairs.values.resize(count);
        pairs.residuals.resize(count);
        pairs.vectors.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(count));
    }
    return pairs;
}

/// The span of the components' vectors is left to deflation.
GroupBalance mesh_balance(const CutOperator& op, const SpectralOptions& options,
                          const std::vector<int>& mesh_of) {
    if (options.mesh_balance <= 0.0) return {};
    return {options.mesh_balance, mesh_of, mesh_indicators(op, mesh_of)};
}

/// Residuals from which on the operator's entries need no more than single precision: rounding them changes
/// the operator, and each eigenvalue, by less than 1e-7.
constexpr double single_tolerance = 1e-5;

/// Takes the operator's matrix.
EigenPairs sparse_eigenpairs(const Comm& comm, CutOperator& op, int count, const SpectralOptions& options,
                             const GroupBalance& balance) {
    EigenPairs pairs = options.offset == 0.0 ? component_eigenpairs(op, op.own) : EigenPairs{};
    EigenRequest request{count - static_cast<int>(pairs.values.size()), options.tolerance,
                         options.max_restarts};
    if (request.wanted <= 0) return pairs;
    const auto precision =
        options.tolerance >= single_tolerance ? EntryPrecision::single : EntryPrecision::full;
    const RowProduct product(comm, std::move(op.matrix), balance, options.sums, precision);
    const EigenPairs found = leading_eigenpairs(comm, product, pairs, start_vector(op, 0), request);
    for (std::size_t k = 0; k < found.values.size(); ++k)
        pairs.append(found.values[k], found.residuals[k], found.vectors.col(static_cast<Eigen::Index>(k)));
    if (count == static_cast<int>(op.rows.size())) return pairs;
    request.wanted = 1;
    return with_missed_pairs(comm, op, product, request, std::move(pairs));
}

/// The column of all ranks, multiplied by D^-1/2, at the rows that take part.
Eigen::VectorXd back_multiplied(const CutOperator& op, const std::vector<double>& vector) {
    const auto rows = static_cast<Eigen::Index>(op.rows.size());
    Eigen::VectorXd coordinates(rows);
    double squares = 0.0;
    for (Eigen::Index r = 0; r < rows; ++r) {
        const auto i = at(op.rows[at(r)]);
        const double value = vector[i] / std::sqrt(op.degree[i]);
        coordinates(r) = value;
        squares += value * value;
    }
    return coordinates * std::sqrt(static_cast<double>(rows) / squares);
}

/// Collective.
Eigen::MatrixXd gathered_coordinates(const Comm& comm, const CutOperator& op, const EigenPairs& pairs) {
    Eigen::MatrixXd coordinates(static_cast<Eigen::Index>(op.rows.size()), pairs.vectors.cols());
    for (Eigen::Index k = 0; k < pairs.vectors.cols(); ++k) {
        const std::span<const double> local(pairs.vectors.col(k).data(), at(pairs.vectors.rows()));
        coordinates.col(k) = back_multiplied(op, all_gather(comm, local));
    }
    return coordinates;
}

}  // namespace

SpectralEmbedding spectral_embedding(const Comm& comm, SparseRows affinity, int parts, int count,
                                     const SpectralOptions& options, const std::vector<int>& mesh_of) {
    if (options.mesh_balance > 0.0 && (options.offset != 0.0 || std::ssize(mesh_of) != affinity.size)) {
        throw AgreedError(ExitCode::internal,
                          "a cut with mesh balance needs the mesh of each patch, and no offset");
    }
    const std::int64_t size = affinity.size;
    CutOperator op = cut_operator(comm, std::move(affinity), parts, options.offset);
    const int vectors = std::min(count, static_cast<int>(op.rows.size()));
    const EigenPairs pairs = size <= dense_rows ? dense_eigenpairs(comm, op, vectors, options, mesh_of)
                                                : sparse_eigenpairs(comm, op, vectors, options,
                                                                    mesh_balance(op, options, mesh_of));
    SpectralEmbedding embedding;
    embedding.rows = op.rows;
    embedding.eigenvalues = pairs.values;
    embedding.residuals = pairs.residuals;
    embedding.coordinates = gathered_coordinates(comm, op, pairs);
    for (const int i : op.rows) embedding.degrees.push_back(op.degree[at(i)]);
    return embedding;
}

}  // namespace coseg
