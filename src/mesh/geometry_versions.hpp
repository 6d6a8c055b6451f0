#pragma once
// Versions of the geometry libraries, which only the sources of this folder may name.

#include <string>
#include <utility>
#include <vector>

namespace coseg {

std::vector<std::pair<std::string, std::string>> geometry_library_versions();

}  // namespace coseg
