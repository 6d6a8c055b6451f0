#include "io/folders/state_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "io/files/folder_entries.hpp"
#include "io/folders/absolute_folder.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

constexpr const char* mark_name = "coseg-state";
constexpr const char* mark_text = "coseg state 1\n";

[[noreturn]] void fail(const std::string& path, const std::string& what, const std::error_code& cause) {
    throw Error(ExitCode::output, path + ": " + what + " (" + cause.message() + "); name another --state");
}

std::string state_path(const std::string& directory) {
    if (directory.empty()) throw Error(ExitCode::usage, "the state folder has no name; give one");
    std::error_code cause;
    const fs::path path = absolute_folder(directory, cause);
    if (cause) fail(directory, "the state folder's path cannot be followed", cause);
    return path.string();
}

bool is_marked(const std::string& path) {
    const std::string mark = path + "/" + mark_name;
    std::error_code ignored;
    if (!fs::is_regular_file(mark, ignored)) return false;  // reading a pipe would wait for ever
    std::ifstream file(mark);
    std::string line;
    return std::getline(file, line) && line + "\n" == mark_text;
}

/// Time that passed since the file was last written or marked, by the clock that also gives "now".
std::int64_t age_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return 0;
    return std::max<std::int64_t>(0, std::time(nullptr) - status.st_mtim.tv_sec);
}

bool is_temporary(const fs::path& path) {
    return path.filename().string().find(".partial-") != std::string::npos;
}

/// Others may be making the same folder at this moment.
bool holds_other_things(const std::string& path) {
    std::error_code cause;
    for (const fs::path& entry : folder_entries(path, cause)) {
        if (!entry.filename().string().starts_with(mark_name)) return true;
    }
    if (cause) fail(path, "the state folder cannot be read", cause);
    return false;
}

template <class Wanted>
void collect(const fs::path& folder, Wanted wanted, std::vector<StateFile>& found) {
    std::error_code cause;
    for (fs::recursive_directory_iterator entry(folder, cause), end; !cause && entry != end;
         entry.increment(cause)) {
        std::error_code ignored;
        if (!entry->is_regular_file(ignored) || !wanted(entry->path())) continue;
        const std::uintmax_t bytes = entry->file_size(ignored);
        found.push_back({entry->path().string(), ignored ? 0 : bytes, age_of(entry->path())});
    }
}

void sort_by_path(std::vector<StateFile>& files) {
    std::sort(files.begin(), files.end(),
              [](const StateFile& a, const StateFile& b) { return a.path < b.path; });
}

}  // namespace

StateFolder StateFolder::make(const std::string& directory) {
    StateFolder folder(state_path(directory));
    std::error_code cause;
    fs::create_directories(folder.path_, cause);
    if (cause) fail(folder.path_, "the state folder cannot be made", cause);
    if (is_marked(folder.path_)) return folder;
    if (holds_other_things(folder.path_)) {
        throw Error(ExitCode::output, folder.path_ +
                                          ": holds other files and is no state folder; name a new or "
                                          "empty folder with --state");
    }
    write_file(folder.path_ + "/" + mark_name, mark_text);
    return folder;
}

StateFolder StateFolder::open(const std::string& directory) {
    StateFolder folder(state_path(directory));
    if (!is_marked(folder.path_)) {
        throw Error(ExitCode::input,
                    folder.path_ + ": is no state folder (it has no file " + mark_name + "); check the path");
    }
    return folder;
}

std::string StateFolder::mesh_file(const ContentHash& key) const {
    const std::string hex = key.hex();
    return path_ + "/meshes/" + hex.substr(0, 2) + "/" + hex + ".h5";
}

std::string StateFolder::solver_folder(const ContentHash& key) const {
    return path_ + "/solver/" + key.hex();
}

std::string StateFolder::cut_file(const ContentHash& key) const {
    return path_ + "/cuts/" + key.hex() + ".h5";
}

std::string StateFolder::set_aside(const std::string& file) const {
    const fs::path folder = fs::path(path_) / "damaged";
    std::error_code cause;
    fs::create_directories(folder, cause);
    const fs::path target = folder / fs::path(file).filename();
    fs::rename(file, target, cause);
    if (!cause) return target.string();
    fs::remove(file, cause);
    return file;
}

std::vector<StateFile> StateFolder::files() const {
    std::vector<StateFile> found;
    for (const char* kind : {"meshes", "solver", "cuts"}) {
        collect(
            fs::path(path_) / kind,
            [](const fs::path& path) { return path.extension() == ".h5" && !is_temporary(path); }, found);
    }
    sort_by_path(found);
    return found;
}

std::vector<StateFile> StateFolder::leftovers() const {
    const std::string damaged = (fs::path(path_) / "damaged").string() + "/";
    std::vector<StateFile> found;
    collect(
        path_, [&](const fs::path& path) { return is_temporary(path) || path.string().starts_with(damaged); },
        found);
    sort_by_path(found);
    return found;
}

void mark_as_used(const std::string& file) noexcept { ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0); }

void make_parent_folders(const std::string& file) {
    const fs::path parent = fs::path(file).parent_path();
    std::error_code cause;
    fs::create_directories(parent, cause);
    if (cause) fail(parent.string(), "the folder cannot be made", cause);
}

}  // namespace coseg
