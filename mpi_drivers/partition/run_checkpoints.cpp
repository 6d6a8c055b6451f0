#include "mpi_drivers/partition/run_checkpoints.hpp"

namespace coseg {

RunCheckpoints::RunCheckpoints(const Comm& comm, const RunState* state, const std::string& cut_options) {
    if (state == nullptr) return;
    tiles_.emplace(comm, *state);
    cuts_.emplace(comm, *state, cut_options);
}

RunCheckpoints::Counts RunCheckpoints::counts(const Comm& comm) const {
    if (!tiles_ || !cuts_) return {};
    return {all_sum(comm, std::int64_t{tiles_->found_count()}),
            all_sum(comm, std::int64_t{tiles_->kept_count()}), cuts_->found_count()};
}

void RunCheckpoints::warn_of_damage(StageLog& log) const {
    if (!tiles_ || !cuts_) return;
    for (const std::string& warning : tiles_->warnings()) log.warn(warning);
    for (const std::string& warning : cuts_->warnings()) log.warn(warning);
}

}  // namespace coseg
