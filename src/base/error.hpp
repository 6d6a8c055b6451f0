#pragma once
// Errors that end the program with a documented exit code and one sentence for the user.

#include <stdexcept>
#include <string>

namespace coseg {

/// Exit codes of every subcommand; README.md lists them for users.
enum class ExitCode : int {
    success = 0,
    internal = 1,       ///< a defect of coseg or of the machine (out of memory, a library that fails)
    usage = 2,          ///< unknown option, value out of range, unused PETSc option
    input = 3,          ///< a mesh, label file, problem or list that cannot be used
    output = 4,         ///< a file or folder that cannot be written
    not_converged = 5,  ///< a gap was not reached (results are written), or an eigenproblem failed
    checkpointed = 75,  ///< ended on a signal with the state written; the same command continues
};

/// A failure with the sentence that the user sees: it names file, line or face, and what to do.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
    [[nodiscard]] ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

/// An Error that every rank of the communicator throws together, so that ranks may unwind and finalise.
class AgreedError : public Error {
  public:
    using Error::Error;
};

}  // namespace coseg
