#pragma once
// The real meshes beside the source tree, where there are any.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace coseg::test {

/// Every mesh file below COSEG_DATA, else below ../shared/data of the source root COSEG_SOURCE or of one of
/// the current folder's parents; empty if there are none. Files with faults, which circulate as they are (the
/// folder as_downloaded), are no part of it. Sorted by path.
inline std::vector<std::string> real_meshes() {
    namespace fs = std::filesystem;
    std::vector<fs::path> roots;
    if (const char* data = std::getenv("COSEG_DATA")) roots.emplace_back(data);
    if (const char* source = std::getenv("COSEG_SOURCE"))
        roots.push_back(fs::path(source) / "../shared/data");
    for (fs::path up = fs::current_path(); up != up.root_path(); up = up.parent_path())
        roots.push_back(up / "shared/data");
    std::vector<std::string> meshes;
    for (const fs::path& root : roots) {
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
