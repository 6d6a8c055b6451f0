#pragma once
// What finds and keeps the results of the optimiser and the cut in a state folder.

#include <optional>
#include <string>

#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"
#include "mpi_drivers/partition/partition_checkpoint.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

class RunCheckpoints {
  public:
    /// state: null keeps nothing. cut_options: see cut_option_text.
    RunCheckpoints(const Comm& comm, const RunState* state, const std::string& cut_options);

    /// Null where nothing is kept.
    [[nodiscard]] SolverCheckpoint* tiles() noexcept { return tiles_ ? &*tiles_ : nullptr; }
    [[nodiscard]] PartitionCheckpoint* cuts() noexcept { return cuts_ ? &*cuts_ : nullptr; }

    struct Counts {
        std::int64_t tiles_found = 0;
        std::int64_t tiles_solved = 0;
        std::int64_t cuts_found = 0;
    };
    /// Of all ranks. Collective.
    [[nodiscard]] Counts counts(const Comm& comm) const;
    /// Says which files were damaged. Collective.
    void warn_of_damage(StageLog& log) const;

  private:
    std::optional<SolverCheckpointFiles> tiles_;
    std::optional<PartitionCheckpoint> cuts_;
};

}  // namespace coseg
