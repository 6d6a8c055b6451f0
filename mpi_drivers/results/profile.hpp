#pragma once
// Writes what --profile adds to a run: where the time of each rank went.

#include <string>

#include "mpi_drivers/options/stage_options.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// From here on the run's times are kept; after PetscSession has begun. Collective.
void begin_profile(StageLog& log);

/// Writes `folder`/profile.txt (the table of stages and steps, PETSc's log) and `folder`/trace.json
/// (io/reports/trace_file.hpp). Prints the former to standard error on rank 0, unless the run is quiet or its
/// log is JSON. begin_petsc_log and StageLog::keep_trace must be called at the run's beginning. Collective;
/// throws AgreedError(output) if a file cannot be written.
void write_profile(const Comm& comm, const std::string& folder, const ProcessOptions& options,
                   const StageLog& log);

}  // namespace coseg
