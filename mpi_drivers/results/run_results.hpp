#pragma once
// All that a run, or an assignment to one, leaves in its folder but its model and its features.

#include <optional>
#include <string>

#include "mpi_drivers/options/stage_options.hpp"
#include "mpi_drivers/partition/run_checkpoints.hpp"
#include "mpi_drivers/results/output_stage.hpp"

namespace coseg {

/// What the report says of the state folder; nothing without one. checkpoints: null where there are none.
/// Collective.
std::optional<ReportState> state_summary(const Comm& comm, const RunState* state,
                                         const RunCheckpoints* checkpoints, const Collection& collection);

/// Writes into `folder` the labels, the pictures, report.json and report.html, as far as `options` ask for
/// them. The log has the stages "write", "picture" and "page". The text of report.json is returned on rank 0.
/// Collective; throws AgreedError.
std::string write_results(const Comm& comm, const std::string& folder, const RunOutcome& outcome,
                          const OutputOptions& options, StageLog& log);

}  // namespace coseg
