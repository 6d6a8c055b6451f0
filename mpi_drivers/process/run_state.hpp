#pragma once
// What a run has with `--state DIR`: a locked folder that keeps results, and signals that ask the run to end.

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
    /// Makes and locks the folder on rank 0. Collective. Throws AgreedError(output) if it cannot be written,
    /// holds other things, or another run has it.
    RunState(const Comm& comm, const std::string& directory, LockMode mode, double checkpoint_seconds);

    [[nodiscard]] const StateFolder& folder() const noexcept { return *folder_; }
    [[nodiscard]] double checkpoint_seconds() const noexcept { return checkpoint_seconds_; }

    /// Whether this rank has been asked to end. Not collective.
    [[nodiscard]] bool stop_is_raised() const noexcept { return stop_.is_raised(); }
    /// Throws AgreedError(checkpointed) if any rank has been asked to end. `done` says what the state holds,
    /// for example "all meshes". Collective.
    void end_if_asked(const Comm& comm, const std::string& done) const;

  private:
    StopRequest stop_;
    std::optional<StateLock> lock_;  ///< rank 0
    std::optional<StateFolder> folder_;
    double checkpoint_seconds_;
};

/// The error that ends a run with its state written. `done` says what the state holds.
AgreedError checkpointed(const std::string& done);

}  // namespace coseg
