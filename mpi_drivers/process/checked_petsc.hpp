#pragma once
// PETSc and SLEPc for a run whose user gives them options: what they do not know ends the run.

#include <string>
#include <vector>

#include "solvers/petsc/petsc_session.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

class CheckedPetsc {
  public:
    /// arguments: what follows `--` on the command line. Collective; throws AgreedError(usage) for what
    /// cannot be an option of PETSc or SLEPc, and for options of the eigensolver that it does not know, and
    /// AgreedError(internal) where a rank has no memory for the products of matrices.
    CheckedPetsc(const Comm& comm, const std::vector<std::string>& arguments);

    /// At the end of a run, when all options that a solver asks for have been asked for. Collective; throws
    /// AgreedError(usage) for those that none has asked for.
    static void refuse_unused(const Comm& comm);

  private:
    PetscSession session_;
};

}  // namespace coseg
