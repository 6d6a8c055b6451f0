#include "src/parallel/shared_counter.hpp"

#include <exception>

#include "src/base/error.hpp"

namespace coseg {

SharedCounter::SharedCounter(const Comm& comm) : ranks_(comm.size()) {
    const MPI_Aint bytes = comm.is_root() ? static_cast<MPI_Aint>(sizeof(std::int64_t)) : 0;
    MPI_Comm_set_errhandler(comm.raw(), MPI_ERRORS_RETURN);
    const int outcome =
        MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, comm.raw(), &value_, &window_);
    MPI_Comm_set_errhandler(comm.raw(), MPI_ERRORS_ARE_FATAL);
    if (outcome != MPI_SUCCESS) {
        throw Error(ExitCode::internal,
                    "MPI has no shared memory left for its windows; make room in /dev/shm");
    }
    if (comm.is_root()) {
        MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_);
        *value_ = 0;
        MPI_Win_unlock(0, window_);
    }
    MPI_Barrier(comm.raw());
    MPI_Win_lock_all(0, window_);
}

SharedCounter::~SharedCounter() {
    if (!may_free_together(ranks_)) return;
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
}

std::int64_t SharedCounter::fetch_and_add(std::int64_t addend) {
    std::int64_t before = 0;
    MPI_Fetch_and_op(&addend, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return before;
}

std::int64_t SharedCounter::next() { return fetch_and_add(1); }

void SharedCounter::exhaust() {
    if (!is_exhausted()) fetch_and_add(exhausted);  // two ranks at once stay far from the integer's end
}

bool SharedCounter::is_exhausted() { return fetch_and_add(0) >= exhausted; }

}  // namespace coseg
