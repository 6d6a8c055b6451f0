#pragma once
// Gives PETSc's own log of its events, objects and messages.

#include <string>

#include "src/parallel/comm.hpp"

namespace coseg {

/// Turns PETSc's log on. Call it after PetscSession has begun. Throws Error(internal) if PETSc cannot.
void begin_petsc_log();

/// The text that PETSc prints for -log_view, on rank 0; empty on the others. Collective over all of PETSc's
/// ranks.
std::string petsc_log_text(const Comm& comm);

}  // namespace coseg
