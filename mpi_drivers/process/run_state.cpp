#include "mpi_drivers/process/run_state.hpp"

#include "src/parallel/record_exchange.hpp"

namespace coseg {

RunState::RunState(const Comm& comm, const std::string& directory, LockMode mode, double checkpoint_seconds)
    : checkpoint_seconds_(checkpoint_seconds) {
    std::string path;
    agree(comm, [&] {
        if (!comm.is_root()) return;
        folder_ = StateFolder::make(directory);
        lock_.emplace(folder_->lock_file(), mode);
        path = folder_->path();
    });
    broadcast(comm, path);
    folder_ = StateFolder::at(path);
}

void RunState::end_if_asked(const Comm& comm, const std::string& done) const {
    if (any_rank(comm, stop_is_raised())) throw checkpointed(done);
}

AgreedError checkpointed(const std::string& done) {
    return {ExitCode::checkpointed, "ended on a signal; the state folder holds " + done +
                                        ", and the same command continues from there"};
}

}  // namespace coseg
