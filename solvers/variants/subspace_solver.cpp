#include "solvers/variants/subspace_solver.hpp"

#include "solvers/mesh_scope/mesh_scope_solver.hpp"
#include "solvers/numeric/blas.hpp"
#include "solvers/row_scope/dense_solver.hpp"
#include "solvers/row_scope/working_set_solver.hpp"

namespace coseg {

SolveResult solve_subspace(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    agree(comm, [&] {
        validate(problem);
        const bool known =
            options.solver == "auto" || options.solver == "dense" || options.solver == "working-set";
        if (!known) {
            throw Error(ExitCode::usage,
                        "unknown solver '" + options.solver + "'; use auto, dense or working-set");
        }
        if (problem.scope == PenaltyScope::meshes && options.solver == "dense") {
            throw Error(ExitCode::usage, "the dense solver covers row scope only; use auto or working-set");
        }
    });
    use_one_blas_thread();
    if (problem.scope == PenaltyScope::meshes) return solve_mesh_scope(comm, problem, options);
    if (options.solver == "dense") return solve_dense(comm, problem, options);
    return solve_working_set(comm, problem, options);
}

}  // namespace coseg
