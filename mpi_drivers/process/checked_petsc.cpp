#include "mpi_drivers/process/checked_petsc.hpp"

#include "solvers/numeric/blas.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

const std::vector<std::string>& known(const std::vector<std::string>& arguments) {
    const std::string unknown = unknown_petsc_option(arguments);
    if (!unknown.empty())
        throw AgreedError(ExitCode::usage, "after --: " + unknown + " is not an option of PETSc or SLEPc");
    return arguments;
}

void refuse_unused_with(const Comm& comm, const std::string& prefix) {
    agree(comm, [&] {
        std::string list;
        for (const std::string& option : unused_petsc_options()) {
            if (option.starts_with(prefix)) list += (list.empty() ? "" : ", ") + option;
        }
        if (list.empty()) return;
        throw Error(ExitCode::usage, "unused PETSc option: " + list + "; check its spelling or leave it out");
    });
}

}  // namespace

CheckedPetsc::CheckedPetsc(const Comm& comm, const std::vector<std::string>& arguments)
    : session_(known(arguments)) {
    agree(comm, reserve_blas_memory);
    refuse_unused_with(comm, "-eps_");  // the eigensolver's are all known before the run
}

void CheckedPetsc::refuse_unused(const Comm& comm) { refuse_unused_with(comm, "-"); }

}  // namespace coseg
