#include "solvers/variants/subspace_solver.hpp"

#include "solvers/mesh_scope/mesh_scope_solver.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/row_scope/dense_solver.hpp"
#include "solvers/row_scope/working_set_solver.hpp"

namespace coseg {

SolveResult solve_subspace(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    agree(comm, [&] {
        validate(problem);
        if (problem.scope == PenaltyScope::meshes && options.solver == SolverChoice::dense) {
            throw Error(ExitCode::usage, "the dense solver covers row scope only; use auto or working-set");
        }
    });
    use_one_blas_thread();
    if (problem.scope == PenaltyScope::meshes) return solve_mesh_scope(comm, problem, options);
    if (options.solver == SolverChoice::dense) return solve_dense(comm, problem, options);
    return solve_working_set(comm, problem, options);
}

}  // namespace coseg
