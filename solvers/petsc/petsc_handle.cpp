#include "solvers/petsc/petsc_handle.hpp"

#include <string>

#include "src/base/error.hpp"

namespace coseg {

void check(PetscErrorCode code, const char* call) {
    if (code == 0) return;
    const char* general = nullptr;
    char* specific = nullptr;
    PetscErrorMessage(code, &general, &specific);
    std::string sentence = std::string(call) + " failed";
    if (general != nullptr) sentence += std::string(": ") + general;
    if (specific != nullptr && *specific != '\0') sentence += std::string(" (") + specific + ")";
    throw Error(ExitCode::internal, sentence);
}

int rank_count(PetscObject object) noexcept {
    int ranks = 0;
    MPI_Comm_size(PetscObjectComm(object), &ranks);
    return ranks;
}

PetscInt petsc_int(std::int64_t value, const char* what) {
    if (value < 0 || value > PETSC_MAX_INT) {
        throw Error(ExitCode::internal,
                    std::string(what) + ": " + std::to_string(value) +
                        " does not fit PETSc's integers; use more ranks or fewer patches");
    }
    return static_cast<PetscInt>(value);
}

}  // namespace coseg
