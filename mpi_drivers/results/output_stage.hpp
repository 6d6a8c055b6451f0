#pragma once
// What a run leaves: labels, patches and coloured meshes per shape, and the report.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/folders/output_directory.hpp"
#include "io/reports/report.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/process/signals.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// The folder that all ranks write into: rank 0 makes it beside DIR and renames it at the end, so that a run that fails
/// or is told to end leaves DIR as it was.
class ResultFolder {
  public:
    /// Collective; throws AgreedError(output) if DIR is not empty and `force` is off, or cannot be made.
    ResultFolder(const Comm& comm, const std::string& path, bool force);

    /// Where files are written until commit.
    [[nodiscard]] const std::string& staging() const noexcept { return staging_; }

    /// Collective; after it DIR holds the result.
    void commit(const Comm& comm);

  private:
    std::optional<OutputDirectory> on_root_;
    std::optional<TerminationWatch> watch_;
    std::string staging_;
};

/// Collective: labels/NAME.seg, patches/NAME.seg, ply/NAME.ply of this rank's meshes.
void write_meshes(const Comm& comm, const ResultFolder& folder, const Collection& collection,
                  const std::vector<MeshLabels>& labels);

struct RunOutcome {
    const Collection& collection;
    const PatchFeatures& features;
    const Optimisation& optimisation;
    const CutResult& cut;
    const std::vector<MeshLabels>& labels;
    const RunOptions& options;
    const std::vector<std::pair<std::string, std::string>>& resolved;
    std::optional<ReportState> state;
};

/// Collective: report.json, by rank 0.
void write_run_report(const Comm& comm, const ResultFolder& folder, const RunOutcome& outcome,
                      const StageLog& log);

}  // namespace coseg
