#include "solvers/spectral/leading_eigenpairs.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "solvers/spectral/exact_vectors.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

PetscVector to_petsc(const RowProduct& product, const Eigen::VectorXd& local) {
    PetscVector vector;
    check(VecDuplicate(product.vector().get(), vector.out()), "VecDuplicate");
    PetscScalar* values = nullptr;
    check(VecGetArrayWrite(vector.get(), &values), "VecGetArrayWrite");
    std::copy_n(local.data(), local.size(), values);
    check(VecRestoreArrayWrite(vector.get(), &values), "VecRestoreArrayWrite");
    return vector;
}

/// The columns of a matrix, as functions of SLEPc take them.
class VectorArray {
  public:
    VectorArray(const RowProduct& product, const Eigen::MatrixXd& columns) {
        for (Eigen::Index k = 0; k < columns.cols(); ++k) {
            vectors_.push_back(to_petsc(product, columns.col(k)));
            handles_.push_back(vectors_.back().get());
        }
    }
    [[nodiscard]] PetscInt size() const { return static_cast<PetscInt>(handles_.size()); }
    [[nodiscard]] Vec* handles() { return handles_.data(); }

  private:
    std::vector<PetscVector> vectors_;
    std::vector<Vec> handles_;
};

Eigen::VectorXd to_eigen(Vec vector, Eigen::Index rows) {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(vector, &values), "VecGetArrayRead");
    Eigen::VectorXd copy = Eigen::Map<const Eigen::VectorXd>(values, rows);
    check(VecRestoreArrayRead(vector, &values), "VecRestoreArrayRead");
    return copy;
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
void configure(EPS solver, const RowProduct& product, const EigenRequest& request, Progress& progress) {
    PetscInt basis = 0;
    PetscInt projected = 0;
    DS small_problem = nullptr;
    check(EPSSetOperators(solver, product.matrix(), nullptr), "EPSSetOperators");
    check(EPSSetProblemType(solver, EPS_HEP), "EPSSetProblemType");
    check(EPSSetType(solver, EPSKRYLOVSCHUR), "EPSSetType");
    check(EPSGetDS(solver, &small_problem), "EPSGetDS");
    check(DSSetParallel(small_problem, DS_PARALLEL_SYNCHRONIZED), "DSSetParallel");
    basis = std::min<PetscInt>(petsc_int(product.size(), "patches"), std::max(2 * request.wanted + 16, 40));
    check(EPSSetDimensions(solver, request.wanted, basis, PETSC_DEFAULT), "EPSSetDimensions");
    check(EPSSetTolerances(solver, request.tolerance, request.max_restarts), "EPSSetTolerances");
    check(EPSMonitorSet(solver, note_progress, &progress, nullptr), "EPSMonitorSet");
    check(EPSSetFromOptions(solver), "EPSSetFromOptions");
    check(EPSGetDimensions(solver, nullptr, &basis, &projected), "EPSGetDimensions");
    check(EPSSetDimensions(solver, request.wanted, basis, projected), "EPSSetDimensions");
    check(EPSSetWhichEigenpairs(solver, EPS_LARGEST_REAL), "EPSSetWhichEigenpairs");
    check(EPSSetConvergenceTest(solver, EPS_CONV_ABS), "EPSSetConvergenceTest");
}

/// All ranks find the same, so that all throw or none.
void refuse_unconverged(EPS solver, int wanted, const Progress& progress) {
    EPSConvergedReason reason = EPS_CONVERGED_ITERATING;
    PetscInt converged = 0;
    PetscInt iterations = 0;
    check(EPSGetConvergedReason(solver, &reason), "EPSGetConvergedReason");
    check(EPSGetConverged(solver, &converged), "EPSGetConverged");
    check(EPSGetIterationNumber(solver, &iterations), "EPSGetIterationNumber");
    if (reason > 0 && converged >= wanted) return;
    const std::string why = reason == EPS_DIVERGED_BREAKDOWN ? " (the method broke down)" : "";
    throw AgreedError(ExitCode::not_converged,
                      "the cut's eigenvectors did not converge" + why + ": " + std::to_string(converged) +
                          " of " + std::to_string(wanted) + " after " + std::to_string(iterations) +
                          " restarts, the next with residual " + significant(progress.residual) +
                          "; give the solver a larger basis (-- -eps_ncv 200)");
}

EigenPairs found_pairs(EPS solver, const RowProduct& product, int wanted) {
    PetscVector vector;
    check(VecDuplicate(product.vector().get(), vector.out()), "VecDuplicate");
    PetscInt rows = 0;
    check(VecGetLocalSize(vector.get(), &rows), "VecGetLocalSize");
    EigenPairs found;
    for (int k = 0; k < wanted; ++k) {
        PetscScalar value = 0.0;
        PetscReal residual = 0.0;
        check(EPSGetEigenpair(solver, k, &value, nullptr, vector.get(), nullptr), "EPSGetEigenpair");
        check(EPSGetErrorEstimate(solver, k, &residual), "EPSGetErrorEstimate");
        found.append(value, residual, to_eigen(vector.get(), rows));
    }
    return found;
}

}  // namespace

void EigenPairs::append(double value, double residual, const Eigen::VectorXd& vector) {
    values.push_back(value);
    residuals.push_back(residual);
    vectors.conservativeResize(vector.size(), vectors.cols() + 1);
    vectors.col(vectors.cols() - 1) = vector;
}

EigenPairs sorted_descending(const EigenPairs& pairs) {
    std::vector<Eigen::Index> order(pairs.values.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return pairs.values[at(a)] > pairs.values[at(b)];
    });
    EigenPairs sorted;
    for (const Eigen::Index k : order)
        sorted.append(pairs.values[at(k)], pairs.residuals[at(k)], pairs.vectors.col(k));
    return sorted;
}

EigenPairs leading_eigenpairs(const Comm& comm, const RowProduct& product, const EigenPairs& known,
                              const Eigen::MatrixXd& starts, const EigenRequest& request) {
    VectorArray deflated(product, known.vectors);
    VectorArray initial(product, starts);
    BasisVectors basis;
    if (product.sums() == VectorSums::exact) basis = exact_basis(comm, product.vector(), 1);
    Progress progress;
    EigenSolver solver;
    check(EPSCreate(comm.raw(), solver.out()), "EPSCreate");
    if (basis.get() != nullptr) check(EPSSetBV(solver.get(), basis.get()), "EPSSetBV");
    configure(solver.get(), product, request, progress);
    if (deflated.size() > 0)
        check(EPSSetDeflationSpace(solver.get(), deflated.size(), deflated.handles()),
              "EPSSetDeflationSpace");
    check(EPSSetInitialSpace(solver.get(), initial.size(), initial.handles()), "EPSSetInitialSpace");
    check(EPSSolve(solver.get()), "EPSSolve");
    refuse_unconverged(solver.get(), request.wanted, progress);
    return found_pairs(solver.get(), product, request.wanted);
}

}  // namespace coseg
