#pragma once
// PETSc's own account of its events, objects and messages.

#include <string>

#include "src/parallel/comm.hpp"

namespace coseg {

/// Turns PETSc's log on; after PetscSession has begun. Throws Error(internal) if PETSc does not.
void begin_petsc_log();

/// What PETSc prints for -log_view, on rank 0; empty on the others. Collective over all of PETSc's ranks.
std::string petsc_log_text(const Comm& comm);

}  // namespace coseg
