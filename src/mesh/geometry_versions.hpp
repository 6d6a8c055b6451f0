#pragma once
// The names and versions of the libraries of geometry. Their headers may be included in sources only, so that
// a function must give the versions.

#include <string>
#include <utility>
#include <vector>

namespace coseg {

std::vector<std::pair<std::string, std::string>> geometry_library_versions();

}  // namespace coseg
