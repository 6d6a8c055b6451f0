#pragma once
// What `--state DIR` gives a run: a locked folder that keeps results, and the wish to end that signals express.

#include <functional>
#include <optional>
#include <string>

#include "io/folders/state_folder.hpp"
#include "io/folders/state_lock.hpp"
#include "mpi_drivers/process/signals.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

class RunState {
  public:
    /// Collective: rank 0 makes and locks the folder. Throws AgreedError(output): it cannot be written, holds other
    /// things, or another run has it.
    RunState(const Comm& comm, const std::string& directory, LockMode mode, double checkpoint_seconds);

    [[nodiscard]] const StateFolder& folder() const noexcept { return *folder_; }
    [[nodiscard]] double checkpoint_seconds() const noexcept { return checkpoint_seconds_; }

    /// Has this rank been asked to end? Not collective.
    [[nodiscard]] bool stop_is_raised() const noexcept { return stop_.is_raised(); }
    /// Collective: throws AgreedError(checkpointed) if any rank has. done: what the state holds, e.g. "all meshes".
    void end_if_asked(const Comm& comm, const std::string& done) const;

  private:
    StopRequest stop_;
    std::optional<StateLock> lock_;  ///< rank 0
    std::optional<StateFolder> folder_;
    double checkpoint_seconds_;
};

/// The error that ends a run with its state written. done: what the state holds.
AgreedError checkpointed(const std::string& done);

}  // namespace coseg
