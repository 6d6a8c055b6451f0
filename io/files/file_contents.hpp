#pragma once
// Reads a whole file into memory.

#include <string>

namespace coseg {

/// The bytes of the file. Throws Error(input) naming the path and the cause if it cannot be read whole.
std::string read_file(const std::string& path);

}  // namespace coseg
