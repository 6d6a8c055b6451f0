#pragma once
// The folders of a run: that of its results, and that of its state if one is kept.

#include <optional>
#include <string>
#include <vector>

#include "io/folders/output_directory.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "mpi_drivers/process/signals.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The folder that all ranks write into: rank 0 makes it beside DIR and renames it at the end, so that a run
/// that fails or is told to end leaves DIR as it was.
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

class RunFolders {
  public:
    /// Makes and locks both. Collective; throws AgreedError(output) where one of them cannot be used.
    RunFolders(const Comm& comm, const OutputOptions& output, const ProcessOptions& process);

    /// Where results are written until commit.
    [[nodiscard]] const std::string& results() const noexcept { return results_.staging(); }
    /// Null where none is kept.
    [[nodiscard]] const RunState* state() const noexcept { return state_ ? &*state_ : nullptr; }

    /// Where a state is kept: ends the run if a rank has been asked to. kept: what the state holds by now.
    /// Collective; throws AgreedError(checkpointed).
    void end_if_asked(const Comm& comm, const std::string& kept) const;

    /// After it the folder of results is complete and in its place. Collective; throws AgreedError(output).
    void commit(const Comm& comm) { results_.commit(comm); }

  private:
    std::optional<RunState> state_;
    ResultFolder results_;
};

/// The meshes that a command line names, in the collection's order, on all ranks. None of them may lie in
/// what --force replaces: labels/, patches/ and ply/ of the folder of results. Collective; throws
/// AgreedError: input as expand_mesh_list does, output.
std::vector<MeshEntry> list_meshes_outside(const Comm& comm, const std::vector<std::string>& inputs,
                                           const std::string& results);

}  // namespace coseg
