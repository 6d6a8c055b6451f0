#pragma once
// How many ranks a command may start by itself.

namespace coseg {

/// More are no wish for one machine, but would fill it with processes.
inline constexpr int most_ranks_of_a_launch = 1024;

}  // namespace coseg
