#pragma once
// New shapes against a finished run: their coefficients over its patches, and the part of each of their
// patches.

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/run_model.hpp"

namespace coseg {

/// Weight of adjacency and overlap against links, in the graph that labels spread over. From .25 to 4 the
/// mean accuracies of the shapes that bench/assign.py leaves out of chairs, aeroplanes and pliers move by at
/// most 1.8 points; of single shapes chair 12 moves most, from 87.6 to 99.0.
inline constexpr double assign_bonds = 1.0;

struct Assigned {
    /// Bounds and gap of all new columns; the coefficients are left out, as their rows are no patches of this
    /// collection.
    Optimisation optimisation;
    CutResult cut;  ///< without starts
};

/// Each mesh is solved where it is, with the run's patches as rows of mesh scope's problem (also where the
/// run had another scope or variant), and takes labels by propagate_labels: a function of the model and the
/// mesh alone. `options`: limits of the solves. The log has the stage "assign". Collective. Throws
/// AgreedError: input where a mesh has nothing in common with the run, not_converged where a limit ends the
/// solve.
Assigned assign_parts(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                      const RunModel& model, const OptimiseOptions& options, StageLog& log);

}  // namespace coseg
