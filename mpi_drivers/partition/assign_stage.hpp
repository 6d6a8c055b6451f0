#pragma once
// Assigns new shapes to a finished run: finds their coefficients over its patches, and the part of each of
// their patches.

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/mesh_assignment.hpp"
#include "src/records/cut_result.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

struct Assigned {
    /// Bounds and gap of all new columns. The coefficients are left out, because their rows are no patches of
    /// this collection.
    Optimisation optimisation;
    CutResult cut;  ///< without starts
    /// How the meshes are turned to stand like the run's shapes; without scale and translation.
    ShapeAlignment alignment;
};

/// Solves each mesh on the rank that holds it, with the run's patches as rows of the problem of mesh scope
/// (also where the run had another scope or variant). The mesh is turned by added_pose and takes parts by
/// added_parts. Meshes of which examples say something come first, with what is known held; to all others
/// they are then as good as shapes of the run. The result is a function of the model, the examples and the
/// mesh alone. `options` hold the limits of the solves. Collective. Throws AgreedError: input where a mesh
/// has nothing in common with the run, not_converged where a limit ends the solve.
Assigned assign_parts(const Comm& comm, const AssignInput& input, const OptimiseOptions& options,
                      StageLog& log);

}  // namespace coseg
