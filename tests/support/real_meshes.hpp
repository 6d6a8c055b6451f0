#pragma once
// The real meshes beside the source tree, where there are any.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace coseg::test {

/// Folders that may hold measured meshes: COSEG_DATA, then ../shared/data of the source root COSEG_SOURCE and
/// of the current folder's parents.
inline std::vector<std::filesystem::path> data_folders() {
    namespace fs = std::filesystem;
    std::vector<fs::path> folders;
    if (const char* data = std::getenv("COSEG_DATA")) folders.emplace_back(data);
    if (const char* source = std::getenv("COSEG_SOURCE"))
        folders.push_back(fs::path(source) / "../shared/data");
    for (fs::path up = fs::current_path(); up != up.root_path(); up = up.parent_path())
        folders.push_back(up / "shared/data");
    return folders;
}

/// The path of a file below the first of these folders that has it; empty if none has.
inline std::string measured_file(const std::string& name) {
    for (const std::filesystem::path& folder : data_folders()) {
        std::error_code ignored;
        if (std::filesystem::exists(folder / name, ignored)) return (folder / name).string();
    }
    return {};
}

/// Every mesh file below the first of these folders that has any; empty if there are none. Files with
/// faults, which circulate as they are (the folder as_downloaded), are no part of it. Sorted by path.
inline std::vector<std::string> real_meshes() {
    namespace fs = std::filesystem;
    std::vector<std::string> meshes;
    for (const fs::path& root : data_folders()) {
        std::error_code cause;
        for (fs::recursive_directory_iterator entry(root, cause), end; !cause && entry != end;
             entry.increment(cause)) {
            if (entry->path().parent_path().filename() == "as_downloaded") continue;
            if (entry->path().extension() == ".off") meshes.push_back(entry->path().string());
        }
        if (!meshes.empty()) break;
    }
    std::sort(meshes.begin(), meshes.end());
    return meshes;
}

}  // namespace coseg::test
