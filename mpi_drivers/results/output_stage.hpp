#pragma once
// Writes what a run leaves: labels, patches and coloured meshes of each shape, and the report.

#include <optional>
#include <string>
#include <vector>

#include "io/reports/report.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/options/option_value.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// Writes labels/NAME.seg, patches/NAME.seg and ply/NAME.ply of this rank's meshes. Collective; throws
/// AgreedError(output).
void write_meshes(const Comm& comm, const std::string& folder, const Collection& collection,
                  const std::vector<MeshLabels>& labels);

/// The outcome of a run or of an assignment.
struct RunOutcome {
    const Collection& collection;
    const std::vector<NamedRange>& ranges;  ///< of the features' bins
    const Optimisation& optimisation;
    const CutResult& cut;
    const std::vector<MeshLabels>& labels;
    int parts;
    const std::vector<OptionValue>& options;
    std::optional<ReportState> state;
    const ShapeAlignment* alignment = nullptr;  ///< of a run; null for an assignment
};

/// The text of report.json on rank 0. Collective.
std::string run_report(const Comm& comm, const RunOutcome& outcome, const StageLog& log);

/// Writes affinity.png: W permuted by part, finer than in the report. It is not written for an assignment,
/// which has no coefficients of its own to draw. Collective; throws AgreedError(output).
void write_affinity_picture(const Comm& comm, const std::string& folder, const RunOutcome& outcome);

}  // namespace coseg
