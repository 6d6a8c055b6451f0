#pragma once
// The program's version and those of the libraries it runs with.

#include <string>
#include <utility>
#include <vector>

namespace coseg {

/// (name, version) of coseg, the compiler and every library, for --version and the report.
std::vector<std::pair<std::string, std::string>> library_versions();

/// The same as text, a line each.
std::string version_text();

}  // namespace coseg
