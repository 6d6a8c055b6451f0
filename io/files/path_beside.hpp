#pragma once
// Paths of files and folders that stand beside another one until they are complete.

#include <cstddef>
#include <string>

namespace coseg {

/// The path with the suffix behind it. Where its last name would then have more than 255 bytes, which file
/// systems do not allow, a hash stands for the end of the name. `spare` bytes may still follow the suffix.
std::string path_beside(const std::string& path, const std::string& suffix, std::size_t spare = 0);

}  // namespace coseg
