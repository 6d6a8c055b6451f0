#include "mpi_drivers/interface/library_call.hpp"

#include <mpi.h>
#include <petscsys.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>

#include "mpi_drivers/process/mpi_start.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

std::atomic_flag at_work = ATOMIC_FLAG_INIT;

/// Ends a call of one process whose caller has thrown; LibraryCall knows what.
struct StoppedByCaller : std::exception {};

bool mpi_is_finalized() {
    int flag = 0;
    MPI_Finalized(&flag);
    return flag != 0;
}

/// A process that was forked from ours has our MPI in its memory and nothing of it: what it would end there
/// is the parent's.
pid_t process_of_mpi = 0;
bool is_forked() { return ::getpid() != process_of_mpi; }

void end_mpi() {
    if (!is_forked() && !mpi_is_finalized()) MPI_Finalize();
}

void start_mpi() {
    int is_started = 0;
    MPI_Initialized(&is_started);
    if (mpi_is_finalized())
        throw Error(ExitCode::usage, "MPI has been finalised in this process; call coseg before that");
    if (is_started != 0) return;
    initialise_mpi(MPI_THREAD_SERIALIZED);
    process_of_mpi = ::getpid();
    std::atexit(end_mpi);
}

/// Ends PETSc before whoever has started MPI ends that: after it, PETSc must be left as it is.
PetscSession* session_of_process = nullptr;
void end_petsc() {
    if (!is_forked() && !mpi_is_finalized()) delete session_of_process;
}

/// Between PetscInitialize and PetscFinalize objects may be made on any communicator; the two themselves are
/// collective over PETSC_COMM_WORLD, which is why that is this process alone.
void start_petsc() {
    if (session_of_process != nullptr) return;
    PetscBool is_started = PETSC_FALSE;
    PetscInitialized(&is_started);
    if (is_started == PETSC_FALSE) PETSC_COMM_WORLD = MPI_COMM_SELF;
    if (process_of_mpi == 0) process_of_mpi = ::getpid();
    session_of_process = std::make_unique<PetscSession>(std::vector<std::string>{}).release();
    std::atexit(end_petsc);
}

/// MPI ends the process where it is handed what is no communicator of a group.
MPI_Comm communicator_of(const Call& call) {
    if (call.communicator == nullptr) return MPI_COMM_SELF;
    MPI_Comm given = *static_cast<const MPI_Comm*>(call.communicator);
    int is_between_groups = 0;
    if (given != MPI_COMM_NULL) MPI_Comm_test_inter(given, &is_between_groups);
    if (given == MPI_COMM_NULL || is_between_groups != 0)
        throw Error(
            ExitCode::usage,
            "the communicator is MPI_COMM_NULL or joins two groups; give one of this process's group");
    return given;
}

}  // namespace

LibraryCall::Turn::Turn() {
    if (at_work.test_and_set())
        throw Error(ExitCode::usage,
                    "another call of coseg is at work in this process; wait until it has returned");
}

LibraryCall::Turn::~Turn() { at_work.clear(); }

LibraryCall::LibraryCall(const Call& call) {
    start_mpi();
    comm_.emplace(communicator_of(call));
    blas_threads_before_ = blas_threads();
    start_petsc();
    set_blas_threads(1);
    StageListener listener;
    listener.progress = [this, &call](const std::string& stage, std::int64_t done, std::int64_t total) {
        tell(call, {stage, done, total});
    };
    listener.warning = [this](const std::string& sentence) { warnings_.push_back(sentence); };
    log_.emplace(*comm_, std::move(listener));
}

LibraryCall::~LibraryCall() { set_blas_threads(blas_threads_before_); }

void LibraryCall::tell(const Call& call, const Progress& progress) {
    if (!call.progress || thrown_) return;
    try {
        call.progress(progress);
    } catch (...) {
        thrown_ = std::current_exception();
    }
    // Other ranks would wait for one that leaves.
    if (thrown_ && comm().size() == 1) throw StoppedByCaller{};
}

void interface_1::start() { with_failures(start_mpi); }

}  // namespace coseg
