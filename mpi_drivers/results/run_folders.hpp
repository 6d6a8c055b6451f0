#pragma once
// The folders of a run: the one of its results, and the one of its state if a state is kept.

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

/// The folder into which all ranks write. Rank 0 makes it beside DIR and renames it at the end, so that a run
/// that fails or is told to end leaves DIR as it was.
class ResultFolder {
  public:
    /// Makes the folder. With `watched`, a signal that ends the process removes it first. Collective; throws
    /// AgreedError(output) if DIR is not empty and `force` is off, or cannot be made.
    ResultFolder(const Comm& comm, const std::string& path, bool force, bool watched);

    /// Where files are written until commit.
    [[nodiscard]] const std::string& staging() const noexcept { return staging_; }

    /// Sees to it that results of these meshes can be written (OutputDirectory::try_names). Collective;
    /// throws AgreedError(output).
    void try_results_of(const Comm& comm, const std::vector<MeshEntry>& entries) const;

    /// Moves the results to DIR. Collective.
    void commit(const Comm& comm);

  private:
    std::optional<OutputDirectory> on_root_;
    std::optional<TerminationWatch> watch_;
    std::string staging_;
};

class RunFolders {
  public:
    /// Makes and locks both; where output.folder is empty, there is none for results. Collective; throws
    /// AgreedError(output) where one of them cannot be used.
    RunFolders(const Comm& comm, const OutputOptions& output, const ProcessOptions& process);

    /// Whether there is a folder for results.
    [[nodiscard]] bool keeps_results() const noexcept { return results_.has_value(); }
    /// Where results are written until commit.
    [[nodiscard]] const std::string& results() const { return results_.value().staging(); }
    /// The state, or null where none is kept.
    [[nodiscard]] const RunState* state() const noexcept { return state_ ? &*state_ : nullptr; }

    /// The meshes `given`, or where this is null those that a command line names, in the collection's order,
    /// on all ranks. None of them may lie in what --force replaces: labels/, patches/ and ply/ of the folder
    /// of results; and the results of each must be possible to write under its name. Collective; throws
    /// AgreedError: input as expand_mesh_list does, output.
    [[nodiscard]] std::vector<MeshEntry> meshes_outside(const Comm& comm, const std::vector<MeshEntry>* given,
                                                        const std::vector<std::string>& inputs) const;

    /// Refuses a folder of examples, "" for none, that lies in what the results replace. Collective; throws
    /// AgreedError(output).
    void keep_apart(const Comm& comm, const std::string& examples) const;

    /// Ends the run if a state is kept and a rank has been asked to end. `kept` says what the state holds by
    /// now. Collective; throws AgreedError(checkpointed).
    void end_if_asked(const Comm& comm, const std::string& kept) const;

    /// Completes the folder of results, if there is one, and moves it to its place. Collective; throws
    /// AgreedError(output).
    void commit(const Comm& comm);

  private:
    std::optional<RunState> state_;
    std::string results_path_;
    std::optional<ResultFolder> results_;
};

}  // namespace coseg
