#pragma once
// The stages of `coseg assign`: new shapes labelled like those of a finished run, without solving it again.

#include <string>
#include <vector>

#include "io/data_files/alignment_file.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "mpi_drivers/partition/assign_stage.hpp"
#include "mpi_drivers/partition/run_model.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// The outcome. Labels and descriptions of meshes are on the ranks that hold them.
struct AssignedLabels {
    Collection collection;
    Assigned assigned;
    std::vector<MeshLabels> labels;
    int parts = 0;
    std::string report;       ///< the text of report.json, on rank 0
    AlignmentFile alignment;  ///< of `entries`, on all ranks
};

/// Labels the meshes `entries`, or where this is null own.process.inputs, by a model, which messages call
/// `run`. All options that are not of input and output are the model's. The folder of results is written if
/// own.output.folder has a name. The caller has started PETSc. Collective; throws AgreedError.
AssignedLabels assign(const Comm& comm, const std::vector<MeshEntry>* entries, const RunModel& model,
                      const std::string& run, const RunOptions& own, StageLog& log);

/// The command: labels the meshes own.process.inputs as the run in the folder `run` labels its own, and
/// writes own.output.folder. All other options are the run's. petsc_arguments: what follows `--` on the
/// command line. Collective; throws AgreedError: not_converged also after all is written, where a limit ended
/// a solve before its gap.
void assign(const Comm& comm, const std::string& run, const RunOptions& own,
            const std::vector<std::string>& petsc_arguments = {});

}  // namespace coseg
