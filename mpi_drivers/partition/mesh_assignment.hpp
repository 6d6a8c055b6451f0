#pragma once
// Assigns one new mesh to the meshes of a run: its coefficients over their patches, and the parts of its own.

#include <tuple>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "mpi_drivers/partition/run_model.hpp"
#include "solvers/alignment/added_pose.hpp"
#include "solvers/partition/added_mesh.hpp"
#include "solvers/partition/part_regression.hpp"
#include "solvers/subspace/solve_result.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What is assigned, and to what.
struct AssignInput {
    const Collection& collection;
    const PatchFeatures& features;
    const RunModel& model;
    const ExampleLabels& examples;  ///< of the collection's patches; empty where nothing is known
};

/// All that new meshes are compared with, made once.
struct KnownMeshes {
    const RunModel& model;
    PatchReduction reduction;
    LinearScore score;
    std::vector<BetweenPartVariance> weights;  ///< see explained_weights
};

/// descriptors: as in PatchFeatures. The model must outlive the result. Serial.
KnownMeshes known_meshes(const RunModel& model, const std::vector<Descriptor>& descriptors);

/// What a mesh adds to the report, gathered in the order of meshes so that sums do not depend on the ranks.
struct AssignedMesh {
    int mesh = 0;
    SolveSummary solution;
    std::int64_t allowed_pairs = 0;
    AddedPose pose;  ///< by which it stands like the run's shapes
    static constexpr auto fields() {
        return std::tuple(field("mesh", &AssignedMesh::mesh), field("solution", &AssignedMesh::solution),
                          field("allowed_pairs", &AssignedMesh::allowed_pairs),
                          field("pose", &AssignedMesh::pose));
    }
};

struct MeshOutcome {
    AddedParts parts;
    Eigen::MatrixXf scores;  ///< K x n
    AssignedMesh figures;
};

/// Solves the mesh with the patches of `known` as rows of the problem of mesh scope, turns it to stand like
/// the run's shapes, and gives it parts by added_parts. `self` is of one rank. Throws Error: input where the
/// mesh has nothing in common with the run, not_converged where a limit ends the solve.
MeshOutcome assign_mesh(const Comm& self, const MeshDescription& mesh, const AssignInput& input,
                        const KnownMeshes& known, const OptimiseOptions& options);

}  // namespace coseg
