#include "solvers/petsc/petsc_session.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "solvers/petsc/petsc_handle.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::array<std::string_view, 3> own_options = {"-no_signal_handler", "-skip_petscrc",
                                                         "-options_left"};

constexpr std::array<std::string_view, 17> known_prefixes = {
    "-eps_", "-st_", "-bv_",  "-ds_",  "-fn_",    "-rg_",      "-ksp_",    "-pc_",      "-mat_",
    "-vec_", "-sf_", "-log_", "-info", "-malloc", "-options_", "-viewer_", "-citations"};

/// Asked for only where something is solved.
constexpr std::array<std::string_view, 3> output_prefixes = {"-eps_view", "-eps_converged_reason",
                                                             "-eps_error_"};

template <std::size_t Count>
bool starts_with_any(std::string_view word, const std::array<std::string_view, Count>& prefixes) {
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](std::string_view prefix) { return word.starts_with(prefix); });
}

/// A solver that solves nothing asks for every option that it knows. An option that is left over is misspelt,
/// even where the problem was too small for this rank to need a solver. A value that the solver refuses is a
/// mistake of the user's.
void mark_solver_options() {
    EigenSolver solver;
    check(EPSCreate(PETSC_COMM_SELF, solver.out()), "EPSCreate");
    check(EPSSetType(solver.get(), EPSKRYLOVSCHUR), "EPSSetType");
    try {
        check(EPSSetFromOptions(solver.get()), "EPSSetFromOptions");
    } catch (const Error& error) {
        throw Error(ExitCode::usage, std::string("after --: ") + error.what());
    }
}

bool is_option_name(const std::string& word) {
    return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

/// PETSc would take options from the environment, unseen by the checks of those on the command line. They
/// could change labels, or end the process.
void forget_options_of_environment() {
    unsetenv("PETSC_OPTIONS");
    unsetenv("PETSC_OPTIONS_YAML");
}

}  // namespace

int blas_threads() {
    using ThreadCount = int (*)();
    void* symbol = dlsym(RTLD_DEFAULT, "openblas_get_num_threads");
    return symbol != nullptr ? reinterpret_cast<ThreadCount>(symbol)() : 0;
}

/// OpenBLAS divides products by its number of threads, which it takes from the number of cores that a rank
/// may use.
void set_blas_threads(int count) {
    using SetThreads = void (*)(int);
    if (void* symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"); symbol != nullptr && count > 0)
        reinterpret_cast<SetThreads>(symbol)(count);
}

std::string unknown_petsc_option(const std::vector<std::string>& arguments) {
    bool value_may_follow = false;
    for (const std::string& word : arguments) {
        if (!is_option_name(word)) {
            if (!value_may_follow) return word;
            value_may_follow = false;
            continue;
        }
        if (!starts_with_any(word, known_prefixes)) return word;
        value_may_follow = true;
    }
    return {};
}

PetscSession::PetscSession(const std::vector<std::string>& arguments)
    : words_{"coseg", "-no_signal_handler", "-skip_petscrc", "-options_left", "no"} {
    if (const std::string word = unknown_petsc_option(arguments); !word.empty()) {
        throw Error(ExitCode::usage,
                    "'" + word +
                        "' after '--' is not an option of PETSc or SLEPc that coseg can use; "
                        "see 'EPS' in SLEPc's manual");
    }
    words_.insert(words_.end(), arguments.begin(), arguments.end());
    PetscBool is_inner = PETSC_FALSE;
    check(SlepcInitialized(&is_inner), "SlepcInitialized");
    is_outermost_ = is_inner == PETSC_FALSE;
    if (!is_outermost_) return;
    for (std::string& word : words_) pointers_.push_back(word.data());
    pointers_.push_back(nullptr);
    forget_options_of_environment();
    int count = static_cast<int>(words_.size());
    char** values = pointers_.data();
    check(SlepcInitialize(&count, &values, nullptr, nullptr), "SlepcInitialize");
    check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "PetscPushErrorHandler");
    set_blas_threads(1);
}

PetscSession::~PetscSession() {
    if (is_outermost_ && std::uncaught_exceptions() == 0) SlepcFinalize();
}

std::vector<std::string> unused_petsc_options() {
    mark_solver_options();
    PetscInt count = 0;
    char** names = nullptr;
    char** values = nullptr;
    check(PetscOptionsLeftGet(nullptr, &count, &names, &values), "PetscOptionsLeftGet");
    std::vector<std::string> unused;
    for (PetscInt i = 0; i < count; ++i) {
        const std::string name = std::string("-") + names[i];
        if (std::find(own_options.begin(), own_options.end(), name) != own_options.end()) continue;
        if (starts_with_any(name, output_prefixes)) continue;
        unused.push_back(values[i] != nullptr && *values[i] != '\0' ? name + " " + values[i] : name);
    }
    check(PetscOptionsLeftRestore(nullptr, &count, &names, &values), "PetscOptionsLeftRestore");
    return unused;
}

}  // namespace coseg
