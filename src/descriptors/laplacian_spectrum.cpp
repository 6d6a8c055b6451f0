#include "src/descriptors/laplacian_spectrum.hpp"

#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/descriptors/cotangent_laplacian.hpp"
#include "src/descriptors/gaussian_curvature.hpp"

namespace coseg {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Up to so many vertices all eigenvalues are computed at once, which is then as fast.
constexpr int dense_vertices = 300;
/// Eigenvalues that differ by less than this share are one group, as symmetric shapes have them.
constexpr double group_width = 1e-3;

[[noreturn]] void refuse(const TriMesh& mesh, const std::string& what) {
    throw Error(ExitCode::internal, "the Laplacian of a mesh with " + std::to_string(mesh.face_count()) +
                                        " faces " + what +
                                        "; leave wave_kernel_signature out of --feature-weights");
}

/// L with the springs between components. A vertex of no face gets a stiff spring to the ground, which takes
/// it out of the lowest eigenfunctions.
SparseMatrix joined_laplacian(const TriMesh& mesh, const DualGraph& graph) {
    SparseMatrix laplacian = cotangent_laplacian(mesh);
    std::vector<Eigen::Triplet<double>> springs;
    for (const DualEdge& edge : graph.edges) {
        if (!edge.is_virtual()) continue;
        constexpr double weight = 1.0 / 9.0;  // nine pairs of corners share it
        for (const int a : mesh.faces.col(edge.face_a)) {
            for (const int b : mesh.faces.col(edge.face_b)) {
                springs.insert(springs.end(),
                               {{a, b, -weight}, {b, a, -weight}, {a, a, weight}, {b, b, weight}});
            }
        }
    }
    std::vector<bool> is_used(at(mesh.vertex_count()), false);
    for (const int v : mesh.faces.reshaped()) is_used[at(v)] = true;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!is_used[at(v)]) springs.emplace_back(v, v, 1.0);
    }
    SparseMatrix joined(laplacian.rows(), laplacian.cols());
    joined.setFromTriplets(springs.begin(), springs.end());
    return laplacian + joined;
}

/// S = A^-1/2 L A^-1/2, which has the same eigenvalues; its eigenvectors are A^1/2 phi.
SparseMatrix symmetric_form(const SparseMatrix& laplacian, const Eigen::VectorXd& area) {
    const Eigen::VectorXd inverse_root = area.cwiseSqrt().cwiseInverse();
    return inverse_root.asDiagonal() * laplacian * inverse_root.asDiagonal();
}

/// (S - shift)^-1 beside the eigenvectors that are found already, as Spectra asks for it.
class ShiftedInverse {
  public:
    using Scalar = double;
    ShiftedInverse(const SparseMatrix& matrix, double shift) : shift_(shift) {
        SparseMatrix shifted = matrix;
        shifted.diagonal().array() -= shift;
        factors_.compute(shifted);
    }
    [[nodiscard]] bool is_good() const { return factors_.info() == Eigen::Success; }
    /// They take the eigenvalue 0 of this operator, which is the least of all.
    void leave_out(const LaplacianSpectrum& found) {
        vectors_ = found.eigenfunctions;
        values_ = (found.eigenvalues.array() - shift_).inverse();
    }

    [[nodiscard]] Eigen::Index rows() const { return factors_.rows(); }
    [[nodiscard]] Eigen::Index cols() const { return factors_.cols(); }
    void set_shift(double /*shift*/) {}  // it is factorised once for all searches
    void perform_op(const double* x, double* y) const {
        const Eigen::Map<const Eigen::VectorXd> in(x, rows());
        Eigen::Map<Eigen::VectorXd> out(y, rows());
        out = factors_.solve(in);
        if (vectors_.cols() > 0) out -= vectors_ * values_.cwiseProduct(vectors_.transpose() * in);
    }

  private:
    double shift_;
    Eigen::SimplicialLDLT<SparseMatrix> factors_;
    Eigen::MatrixXd vectors_;
    Eigen::VectorXd values_;
};

/// Without symmetry, so that no eigenvector of a symmetric mesh is orthogonal to it.
Eigen::VectorXd start_vector(Eigen::Index size, int search) {
    Eigen::VectorXd start(size);
    for (Eigen::Index v = 0; v < size; ++v)
        start[v] =
            uniform_of(hash_words({static_cast<std::uint64_t>(search), static_cast<std::uint64_t>(v)})) - 0.5;
    return start;
}

/// The `count` lowest that are not left out, ascending.
LaplacianSpectrum lowest_of(ShiftedInverse& inverse, double shift, Eigen::Index count, int search,
                            const TriMesh& mesh) {
    constexpr double tolerance = 1e-9;
    constexpr Eigen::Index restarts = 1000;
    const Eigen::Index basis = std::min(2 * count + 20, inverse.rows());
    Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, count, basis, shift);
    const Eigen::VectorXd start = start_vector(inverse.rows(), search);
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestMagn, restarts, tolerance, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful) refuse(mesh, "does not give up its eigenvalues");
    return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Both together, ascending.
LaplacianSpectrum merged(const LaplacianSpectrum& a, const LaplacianSpectrum& b) {
    Eigen::VectorXd values(a.eigenvalues.size() + b.eigenvalues.size());
    values << a.eigenvalues, b.eigenvalues;
    std::vector<Eigen::Index> order(at(values.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
    LaplacianSpectrum both{values(order), Eigen::MatrixXd(a.eigenfunctions.rows(), values.size())};
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Eigen::Index i = order[k];
        const Eigen::Index from_b = i - a.eigenvalues.size();
        both.eigenfunctions.col(static_cast<Eigen::Index>(k)) =
            from_b < 0 ? a.eigenfunctions.col(i) : b.eigenfunctions.col(from_b);
    }
    return both;
}

/// At least the `count` lowest, ascending, the constant one first; eigenvectors of S. A search from one
/// vector sees of equal eigenvalues only one copy but for rounding, and may miss others. So it is repeated
/// beside what was found, until it finds nothing below the last of these.
LaplacianSpectrum lowest_with_copies(const TriMesh& mesh, const SparseMatrix& matrix, Eigen::Index count,
                                     double shift) {
    constexpr Eigen::Index more = 6;
    ShiftedInverse inverse(matrix, shift);
    if (!inverse.is_good()) refuse(mesh, "cannot be factorised");
    LaplacianSpectrum found = lowest_of(inverse, shift, count, 0, mesh);
    for (int search = 1; found.eigenvalues.size() + more < matrix.rows() / 2; ++search) {
        const double last = found.eigenvalues[count - 1];
        inverse.leave_out(found);
        const LaplacianSpectrum missed = lowest_of(inverse, shift, more, search, mesh);
        found = merged(found, missed);
        if (missed.eigenvalues[0] >= last) break;
    }
    return found;
}

LaplacianSpectrum all_of(const SparseMatrix& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(matrix)};
    return {solver.eigenvalues(), solver.eigenvectors()};
}

/// How many of the eigenvalues after the first to keep: at most `pairs`, and no part of a group unless the
/// group is most of them.
Eigen::Index kept_pairs(const Eigen::VectorXd& eigenvalues, Eigen::Index pairs) {
    const Eigen::Index last = std::min(pairs, eigenvalues.size() - 1);
    for (Eigen::Index kept = last; kept >= last - last / 10 && kept + 1 < eigenvalues.size(); --kept) {
        if (eigenvalues[kept + 1] - eigenvalues[kept] > group_width * eigenvalues[kept]) return kept;
    }
    return last;
}

}  // namespace

LaplacianSpectrum laplacian_spectrum(const TriMesh& mesh, const FaceGeometry& geometry,
                                     const DualGraph& graph, int pairs) {
    const Eigen::VectorXd area =
        vertex_areas(mesh, geometry).cwiseMax(1e-6 * geometry.total_area / mesh.vertex_count());
    const SparseMatrix matrix = symmetric_form(joined_laplacian(mesh, graph), area);
    // The constant one before them and one behind them, which shows whether a group ends there.
    const Eigen::Index asked = static_cast<Eigen::Index>(pairs) + 2;
    const bool is_small = matrix.rows() <= std::max<Eigen::Index>(dense_vertices, 2 * asked);
    // A shift just below the spectrum keeps what is factorised positive definite.
    const LaplacianSpectrum all =
        is_small ? all_of(matrix) : lowest_with_copies(mesh, matrix, asked, -1.0 / geometry.total_area);
    const Eigen::Index kept = kept_pairs(all.eigenvalues, pairs);
    LaplacianSpectrum spectrum;
    spectrum.eigenvalues = all.eigenvalues.segment(1, kept);
    spectrum.eigenfunctions =
        area.cwiseSqrt().cwiseInverse().asDiagonal() * all.eigenfunctions.middleCols(1, kept);
    return spectrum;
}

}  // namespace coseg
