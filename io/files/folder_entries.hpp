#pragma once
// What lies in a folder, and the removal of files in it.

#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

namespace coseg {

/// The paths of all files and folders in `folder`, sorted, as file systems give them in any order. Where the
/// folder cannot be read, or no further, `cause` says why and the list has what was read until then; else
/// `cause` is clear. Whether that is an error is for the caller to say, who knows what the folder is for.
std::vector<std::filesystem::path> folder_entries(const std::filesystem::path& folder,
                                                  std::error_code& cause);

/// Removes the files in `folder` that `is_earlier` takes for those of an earlier result. Folders in it stay.
/// Does nothing where there is no such folder. Throws Error(output) naming the folder that cannot be read or
/// the file that cannot be removed.
void remove_earlier_files(const std::filesystem::path& folder,
                          const std::function<bool(const std::filesystem::path&)>& is_earlier);

}  // namespace coseg
