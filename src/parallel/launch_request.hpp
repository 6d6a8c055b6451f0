#pragma once
// What a user asks for of a command that starts its ranks by itself.

#include <optional>

namespace coseg {

/// More are no wish for one machine, but would fill it with processes.
inline constexpr int most_ranks_of_a_launch = 1024;

/// How a command that divides its work over ranks is to be started.
struct LaunchRequest {
    std::optional<int> ranks;  ///< of --ranks, 0 .. most_ranks_of_a_launch; 0: one for each core
    bool keeps_state = false;  ///< whether there is a state folder, which ranks write when they are stopped
};

}  // namespace coseg
