#pragma once
// The versions of the program and of the libraries that it uses.

#include <string>
#include <utility>
#include <vector>

namespace coseg {

/// (name, version) of coseg, the compiler and every library, for --version and the report.
std::vector<std::pair<std::string, std::string>> library_versions();

/// The same as text, one line for each.
std::string version_text();

}  // namespace coseg
