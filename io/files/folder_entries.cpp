#include "io/files/folder_entries.hpp"

#include <algorithm>
#include <string>

#include "src/base/error.hpp"

namespace coseg {

namespace fs = std::filesystem;

std::vector<fs::path> folder_entries(const fs::path& folder, std::error_code& cause) {
    std::vector<fs::path> entries;
    cause.clear();
    for (fs::directory_iterator entry(folder, cause), end; !cause && entry != end; entry.increment(cause))
        entries.push_back(entry->path());
    std::sort(entries.begin(), entries.end());
    return entries;
}

void remove_earlier_files(const fs::path& folder, const std::function<bool(const fs::path&)>& is_earlier) {
    std::error_code cause;
    if (!fs::is_directory(folder, cause)) return;
    const auto require = [&](const fs::path& path, const std::string& what) {
        if (cause) throw Error(ExitCode::output, path.string() + ": " + what + " (" + cause.message() + ")");
    };
    const std::vector<fs::path> entries = folder_entries(folder, cause);
    require(folder, "cannot be read");
    for (const fs::path& path : entries) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored) || !is_earlier(path)) continue;
        fs::remove(path, cause);
        require(path, "the earlier result cannot be removed");
    }
}

}  // namespace coseg
