#pragma once
// Assigns new shapes to a finished run: finds their coefficients over its patches, and the part of each of
// their patches.

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/run_model.hpp"
#include "solvers/partition/labelled_parts.hpp"

namespace coseg {

/// The weight of adjacency and overlap against links, in the graph over which labels spread. From .25 to 4,
/// the mean accuracies of the shapes that bench/assign.py leaves out of chairs, aeroplanes and pliers change
/// by at most 1.8 points. Of single shapes chair 12 changes most, from 87.6 to 99.0.
inline constexpr double assign_bonds = 1.0;

/// What is assigned, and to what.
struct AssignInput {
    const Collection& collection;
    const PatchFeatures& features;
    const RunModel& model;
    const ExampleLabels& examples;  ///< of the collection's patches; empty where nothing is known
};

struct Assigned {
    /// Bounds and gap of all new columns. The coefficients are left out, because their rows are no patches of
    /// this collection.
    Optimisation optimisation;
    CutResult cut;  ///< without starts
};

/// Solves each mesh on the rank that holds it, with the run's patches as rows of the problem of mesh scope
/// (also where the run had another scope or variant). The mesh takes labels by propagate_labels. Meshes of which
/// examples say something come first, with what is known held; to all others they are then as good as shapes of
/// the run. The result is a function of the model, the examples and the mesh alone. `options` hold the limits of the solves. Collective. Throws
/// AgreedError: input where a mesh has nothing in common with the run, not_converged where a limit ends the
/// solve.
Assigned assign_parts(const Comm& comm, const AssignInput& input, const OptimiseOptions& options,
                      StageLog& log);

}  // namespace coseg
