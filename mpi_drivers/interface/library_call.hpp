#pragma once
// What every function of the interface does around its work: MPI and PETSc are there, one call is at work,
// and every failure is the exception of the interface.

#include <coseg/coseg.hpp>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "io/interface/failures.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// One call of the interface that is at work. It starts MPI and PETSc where the process has not; PETSc is
/// started for this process alone, so that later calls may have any communicator. Collective over the
/// communicator of the call. Throws Error(usage) while there is another one in the process, or where MPI has
/// been finalised.
class LibraryCall {
  public:
    explicit LibraryCall(const Call& call);
    ~LibraryCall();
    LibraryCall(const LibraryCall&) = delete;
    LibraryCall& operator=(const LibraryCall&) = delete;

    [[nodiscard]] const Comm& comm() const { return comm_.value(); }
    [[nodiscard]] StageLog& log() { return log_.value(); }
    /// What the stages have warned of up to now; the same on all ranks that warn alike.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// Throws what the caller's progress function has thrown.
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

  private:
    /// Held first and let go of last.
    struct Turn {
        Turn();
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
    };
    void tell(const Call& call, const Progress& progress);

    Turn turn_;
    std::optional<Comm> comm_;
    std::optional<StageLog> log_;
    std::vector<std::string> warnings_;
    std::exception_ptr thrown_;
    int blas_threads_before_ = 0;
};

/// Runs `work` as one call; what it returns or throws is that of the interface.
template <class Work>
auto in_call(const Call& call, Work&& work) {
    return with_failures([&] {
        LibraryCall library(call);
        try {
            auto result = work(library);
            library.rethrow();
            return result;
        } catch (...) {
            library.rethrow();
            throw;
        }
    });
}

}  // namespace coseg
