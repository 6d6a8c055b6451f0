#pragma once
// Owners of PETSc and SLEPc objects: move-only, the raw handle exposed, every call checked.

#include <petscmat.h>
#include <slepceps.h>

#include <cstdint>
#include <utility>

#include "src/parallel/comm.hpp"

namespace coseg {

/// Throws Error(internal) with PETSc's own message if `code` is not zero. `call` names the function that
/// failed.
void check(PetscErrorCode code, const char* call);

/// `value` as a PetscInt (32 bits in distribution packages). Throws Error(internal) that names `what` if it
/// does not fit.
PetscInt petsc_int(std::int64_t value, const char* what);

/// How many ranks own a PETSc object together.
int rank_count(PetscObject object) noexcept;

/// Owns one handle and destroys it. Destruction is collective over the object's communicator: where
/// `may_free_together` forbids it, the handle is given up instead.
template <class Handle, PetscErrorCode (*Destroy)(Handle*)>
class PetscHandle {
  public:
    PetscHandle() = default;
    /// Takes over the caller's reference.
    explicit PetscHandle(Handle owned) noexcept : handle_(owned) {}
    PetscHandle(PetscHandle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    PetscHandle& operator=(PetscHandle&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    PetscHandle(const PetscHandle&) = delete;
    PetscHandle& operator=(const PetscHandle&) = delete;
    ~PetscHandle() {
        if (handle_ != nullptr && may_free_together(rank_count(reinterpret_cast<PetscObject>(handle_))))
            Destroy(&handle_);
    }

    [[nodiscard]] Handle get() const noexcept { return handle_; }
    /// For calls that create: `check(MatCreate(comm, matrix.out()), "MatCreate")`. The handle must be empty.
    [[nodiscard]] Handle* out() noexcept { return &handle_; }
    [[nodiscard]] explicit operator bool() const noexcept { return handle_ != nullptr; }

  private:
    Handle handle_ = nullptr;
};

using PetscMatrix = PetscHandle<Mat, MatDestroy>;
using PetscVector = PetscHandle<Vec, VecDestroy>;
using EigenSolver = PetscHandle<EPS, EPSDestroy>;

}  // namespace coseg
