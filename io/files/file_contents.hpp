#pragma once
// Reads a whole file into memory.

#include <string>

namespace coseg {

/// The bytes of the file. Throws Error(input) naming the path and the cause if it cannot be read whole.
std::string read_file(const std::string& path);

/// Throws Error(input), a sentence that says what the path is, for folders, links that lead nowhere, and
/// pipes, sockets and devices, on which reading would wait for ever. A path where nothing is passes.
void require_regular_file(const std::string& path);

/// The bytes of what was found in a folder, or is known to be a file otherwise: throws as both of these.
std::string read_regular_file(const std::string& path);

}  // namespace coseg
