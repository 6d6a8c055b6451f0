#pragma once
// Keeps the outcome of cuts in a state folder.

#include <string>
#include <vector>

#include "mpi_drivers/options/option_value.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/process/run_state.hpp"

namespace coseg {

/// The part of a run's command line on which a cut depends, as one text: the options that affect it or a
/// stage before it, and petsc_arguments, which follow `--`.
std::string cut_option_text(const std::vector<OptionValue>& options,
                            const std::vector<std::string>& petsc_arguments);

/// Finished cuts, DIR/cuts/HASH.h5: eigenvalues, terms and score of every start, and the part of every patch.
/// The hash is one of all that a cut depends on: coefficients, pairs and areas of the patches, options,
/// program. It is therefore valid on any number of ranks and for any part of a collection.
class PartitionCheckpoint {
  public:
    PartitionCheckpoint(const Comm& comm, const RunState& state, std::string options)
        : comm_(comm), state_(state), options_(std::move(options)) {}

    /// Does what cut_into_parts does, or takes the outcome from the folder if it is there. With --parts auto
    /// the outcome is kept for the number of parts that was found as well. Collective; throws
    /// what cut_into_parts does, AgreedError(output) if the outcome cannot be written,
    /// AgreedError(checkpointed) if a rank has been asked to end before the cut.
    CutResult cut(const PartitionInput& input, const PartitionOptions& options);

    /// The number of cuts that were found, and a sentence for each damaged file; the same on all ranks.
    [[nodiscard]] int found_count() const noexcept { return found_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  private:
    /// Collective.
    void keep(const std::string& file, const CutResult& cut) const;

    const Comm& comm_;
    const RunState& state_;
    std::string options_;
    int found_ = 0;
    std::vector<std::string> warnings_;
};

/// Calls cut_into_parts, through the checkpoint if there is one. Collective; throws as
/// PartitionCheckpoint::cut.
CutResult cut_or_found(const Comm& comm, const PartitionInput& input, const PartitionOptions& options,
                       PartitionCheckpoint* checkpoint);

/// Writes a cut as a file. Throws Error(output).
void write_cut(const std::string& path, const CutResult& cut);
/// Throws Error(input) for a damaged file.
CutResult read_cut(const std::string& path);

}  // namespace coseg
