#pragma once
// Where a folder is that a user names.

#include <filesystem>
#include <string>
#include <system_error>

namespace coseg {

/// The absolute path, links followed as far as there are any, without a slash at its end. The folder need not
/// be there. `cause` says why it cannot be told, as where the current folder has been removed.
inline std::filesystem::path absolute_folder(const std::string& directory, std::error_code& cause) {
    std::filesystem::path path = std::filesystem::absolute(directory, cause);
    if (!cause) path = std::filesystem::weakly_canonical(path, cause);
    return path.has_filename() ? path : path.parent_path();
}

}  // namespace coseg
