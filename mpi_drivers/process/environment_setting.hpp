#pragma once
// Variables of the environment that tell Open MPI how to start.

#include <cstdlib>

namespace coseg {

/// A variable that is set where the user has not done so.
struct EnvironmentSetting {
    const char* variable;
    const char* value;
};

inline bool is_set(const char* variable) { return std::getenv(variable) != nullptr; }

}  // namespace coseg
