#pragma once
// Initialises PETSc and SLEPc, and ends them.

#include <string>
#include <vector>

namespace coseg {

/// Initialises SLEPc, PETSc and, unless the program did, MPI; ends them in reverse order. One per process.
/// PETSc's signal handlers and its printing of errors are off: errors reach the user through check() alone.
/// BLAS is held to one thread per rank, so that results do not depend on how many cores a rank may see.
/// What PETSc reads by itself, the file ~/.petscrc and the variable PETSC_OPTIONS, is ignored. Collective
/// over PETSC_COMM_WORLD, which is MPI_COMM_WORLD unless the program has set another one.
///
/// Inside another session of the process it does nothing: the outer one stays as it is, and ends them.
class PetscSession {
  public:
    /// `arguments` are the words that the user gave for PETSc and SLEPc, for example {"-eps_ncv", "80"}.
    /// Throws Error(usage) where unknown_petsc_option finds one, Error(internal) if the libraries do not
    /// start.
    explicit PetscSession(const std::vector<std::string>& arguments);
    /// Does nothing while an exception is under way: a rank that unwinds alone must not enter a collective
    /// call.
    ~PetscSession();
    PetscSession(const PetscSession&) = delete;
    PetscSession& operator=(const PetscSession&) = delete;

  private:
    std::vector<std::string> words_;  // PETSc keeps pointers to these
    std::vector<char*> pointers_;
    bool is_outermost_ = true;
};

/// The number of threads that BLAS may use, or 0 where it cannot be told; and how to set it. A session sets
/// it to 1 for the whole process.
int blas_threads();
void set_blas_threads(int count);

/// The first of `arguments` that cannot be an option of the solvers in use, or "" if there is none. Options
/// start with one of the prefixes of PETSc's and SLEPc's classes (-eps_, -st_, -bv_, -ds_, -mat_, -vec_,
/// -log_ ...), and a value follows an option. This finds wrong words before the run; unused_petsc_options
/// finds misspelt ones after it.
std::string unknown_petsc_option(const std::vector<std::string>& arguments);

/// The options that were set but that no solver asked for, each as "-name" or "-name value". Most likely they
/// are misspelt. At the end of a run, before the session ends, the list is complete; for options of the
/// eigensolver (-eps_) it is complete at any time. The session's own options are not reported. Throws
/// Error(usage) if the eigensolver refuses a value.
std::vector<std::string> unused_petsc_options();

}  // namespace coseg
