#include "io/folders/output_directory.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/folder_entries.hpp"
#include "io/files/path_beside.hpp"
#include "io/folders/absolute_folder.hpp"
#include "io/folders/state_lock.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

/// Whether not every run writes a file of this name, in DIR itself: such files, and a picture of every kind.
bool is_of_some_runs(const std::string& name) {
    const auto& files = result_files::of_some_runs;
    return std::find(files.begin(), files.end(), name) != files.end() ||
           (name.starts_with(result_files::sheet) && name.ends_with(result_files::picture_suffix));
}

/// The folders of DIR in which files are replaced, and the suffix of those files.
std::vector<MeshResult> replaced_results() {
    std::vector<MeshResult> results(result_files::of_meshes.begin(), result_files::of_meshes.end());
    results.push_back(result_files::sheet_pages);
    return results;
}

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::error_code& cause) {
    throw Error(ExitCode::output, path.string() + ": " + what + " (" + cause.message() + ")");
}

std::string absolute_directory(const std::string& directory) {
    if (directory.empty()) throw Error(ExitCode::output, "the output folder has no name; give one");
    std::error_code cause;
    const fs::path path = absolute_folder(directory, cause);
    if (cause) fail(directory, "the output folder's path cannot be followed", cause);
    if (path == path.root_path())
        throw Error(ExitCode::output, path.string() + ": cannot be an output folder; name another");
    return path.string();
}

constexpr const char* partial_mark = ".partial-";

/// What a killed run left in a folder does not count.
bool is_empty_or_missing(const fs::path& path) {
    std::error_code cause;
    if (!fs::exists(path, cause)) return true;
    for (const fs::path& entry : folder_entries(path, cause)) {
        if (!entry.filename().string().starts_with(partial_mark)) return false;
    }
    return !cause;
}

/// The names of this machine's partial folders begin so; the process number follows.
std::string own_mark() {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
    return partial_mark + std::string(host.data()) + "-";
}

/// The partial folder lies inside a folder that exists: this may be a mount point, or its parent may be
/// closed to us.
std::string staging_prefix(const std::string& path) {
    constexpr std::size_t digits_of_process = 10;
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return path + "/" + own_mark();
    return path_beside(path, own_mark(), digits_of_process);
}

/// The process has ended, but its parent has not collected its status, which in a container may never happen.
bool is_zombie(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string line;
    std::getline(file, line);  // number (name) state ..., where the name may hold anything
    const std::size_t name_end = line.rfind(')');
    return name_end != std::string::npos && line.compare(name_end, 3, ") Z") == 0;
}

bool is_of_dead_process(const std::string& number) {
    pid_t process = 0;
    const char* end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, process);
    if (error != std::errc() || stop != end || process <= 0) return false;
    if (::kill(process, 0) != 0) return errno == ESRCH;
    return is_zombie(process);
}

/// A process that is killed cannot tidy up. The next run on this machine that writes to the same place does
/// it instead.
void remove_leftovers(const fs::path& prefix) {
    const std::string mark = prefix.filename().string();
    std::error_code ignored;
    for (const fs::path& entry : folder_entries(prefix.parent_path(), ignored)) {
        const std::string name = entry.filename().string();
        if (name.starts_with(mark) && is_of_dead_process(name.substr(mark.size())))
            fs::remove_all(entry, ignored);
    }
}

void move_entry(const fs::path& from, const fs::path& to) {
    std::error_code cause;
    fs::rename(from, to, cause);
    if (cause) fail(to, "cannot be put in place", cause);
}

/// Files of meshes, or pages of pictures, that `fresh` does not bring anew. `folder` lies below both.
void remove_stale(const std::string& folder, const std::string& suffix, const fs::path& old,
                  const fs::path& fresh) {
    remove_earlier_files(old / folder, [&](const fs::path& path) {
        std::error_code ignored;
        return path.extension() == suffix && !fs::exists(fresh / folder / path.filename(), ignored);
    });
}

/// The same for the folders of levels, of which those that become empty go too.
void remove_stale_levels(const fs::path& old, const fs::path& fresh) {
    std::error_code ignored;
    for (const fs::path& entry : folder_entries(old / result_files::levels, ignored)) {
        const std::string level = result_files::levels + ("/" + entry.filename().string());
        remove_stale(level, label_suffix, old, fresh);
        if (fs::is_empty(entry, ignored)) fs::remove(entry, ignored);
    }
    if (fs::is_empty(old / result_files::levels, ignored)) fs::remove(old / result_files::levels, ignored);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::error_code cause;
    std::vector<fs::path> entries = folder_entries(folder, cause);
    if (cause) fail(folder, "cannot be read", cause);
    return entries;
}

void remove_stale_files(const fs::path& old, const fs::path& fresh) {
    remove_earlier_files(old, [&](const fs::path& path) {
        std::error_code ignored;
        return is_of_some_runs(path.filename().string()) && !fs::exists(fresh / path.filename(), ignored);
    });
}

/// Moves the content of `from` into `to`, folder by folder, replacing files of the same name.
void merge_folder(const fs::path& from, const fs::path& to) {
    for (const fs::path& entry : entries_of(from)) {
        const fs::path target = to / entry.filename();
        std::error_code ignored;
        if (fs::is_directory(entry, ignored) && fs::is_directory(target, ignored))
            merge_folder(entry, target);
        else
            move_entry(entry, target);
    }
}

/// Whether a file of a run that is no file of a mesh may have this name.
bool is_result_file(const std::string& name) {
    return name == result_files::report || name == result_files::corrections || is_of_some_runs(name);
}

/// What a person has written of an earlier run is not lost: where the new results replace the file or end
/// what it was about, it gets the name with a number.
void keep_work_of_a_person(const std::string& name, const fs::path& old, const fs::path& fresh) {
    const fs::path earlier = old / name;
    std::error_code ignored;
    const bool is_replaced = fs::exists(fresh / name, ignored);
    if (!fs::is_regular_file(earlier, ignored) || !(is_replaced || is_of_some_runs(name))) return;
    if (is_replaced && read_regular_file(earlier.string()) == read_file((fresh / name).string())) return;
    fs::path kept;
    for (int k = 1; kept.empty() || fs::exists(kept, ignored); ++k)
        kept = old / (earlier.stem().string() + "_" + std::to_string(k) + earlier.extension().string());
    move_entry(earlier, kept);
}

/// Whether a run has written the folder: nothing else in it is ours to remove.
bool is_of_a_run(const fs::path& folder) {
    std::ifstream report(folder / result_files::report, std::ios::binary);
    std::string begin(256, '\0');
    report.read(begin.data(), std::ssize(begin));
    return begin.find("\"coseg report") != std::string::npos;
}

void refuse_folders_for_files(const fs::path& folder, const auto& is_file_of_ours) {
    for (const fs::path& path : entries_of(folder)) {
        std::error_code ignored;
        if (!is_file_of_ours(path) || !fs::is_directory(path, ignored)) continue;
        throw Error(ExitCode::output,
                    path.string() + ": is a folder where a result is to be put; move it or name another");
    }
}

/// Throws Error(output) where it is there as a file.
bool is_there_as_folder(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::exists(folder, ignored)) return false;
    if (fs::is_directory(folder, ignored)) return true;
    throw Error(
        ExitCode::output,
        folder.string() + ": is a file where a folder of results is to be put; move it or name another");
}

void refuse_unwritable(const fs::path& folder) {
    const std::string probe = (folder / (own_mark() + std::to_string(::getpid()))).string();
    write_file(probe, "");
    std::error_code ignored;
    fs::remove(probe, ignored);
}

bool is_ascii(const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](char c) { return static_cast<signed char>(c) > 0; });
}

void try_name(const std::string& staging, const std::string& name) {
    for (const MeshResult& result : result_files::of_meshes) {
        const std::string path = result_files::path_of(result, staging, name);
        try {
            write_file(path, "");
        } catch (const Error& error) {
            throw Error(ExitCode::output,
                        std::string("a result of the mesh '") + name +
                            "' cannot be written under its name; rename the mesh: " + error.what());
        }
        std::error_code ignored;
        fs::remove(path, ignored);
    }
}

/// Labels and coloured meshes take between a fifth of a file of text with normals and colours and twice a
/// small binary one.
void refuse_too_little_space(const std::string& staging, std::uintmax_t input_bytes) {
    constexpr std::uintmax_t least_share = 5;
    std::error_code cause;
    const fs::space_info space = fs::space(staging, cause);
    if (cause || space.available >= input_bytes / least_share) return;
    constexpr std::uintmax_t mebibyte = std::uintmax_t{1} << 20U;
    throw Error(ExitCode::output, staging + ": only " + std::to_string(space.available / mebibyte) +
                                      " MiB are free, and the results of " +
                                      std::to_string(input_bytes / mebibyte) +
                                      " MiB of meshes need more; make room or name another folder");
}

/// A session of `coseg edit` would go on with results that are no longer there.
void refuse_open_session(const std::string& folder) {
    const std::string file = folder + "/" + session_lock_name;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return;
    try {
        const StateLock free(file, LockMode::shared);
    } catch (const LockHeld&) {
        throw Error(ExitCode::output, folder + ": coseg edit works on the run in it; end that first");
    } catch (const LockUnwritable&) {
        // Nor can the results be written, which is said of them.
    }
}

}  // namespace

OutputDirectory::OutputDirectory(const std::string& directory, bool force)
    : path_(absolute_directory(directory)),
      staging_(staging_prefix(path_) + std::to_string(::getpid())),
      force_(force) {
    refuse_what_is_there();
    refuse_what_is_in_the_way();
    try {
        create();
    } catch (...) {
        remove_partial();
        throw;
    }
}

OutputDirectory::~OutputDirectory() { abandon(); }

void OutputDirectory::abandon() noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_committed_) remove_partial();
}

void OutputDirectory::refuse_what_is_there() const {
    std::error_code cause;
    if (fs::exists(path_, cause) && !fs::is_directory(path_, cause)) {
        throw Error(ExitCode::output, path_ + ": is a file, not a folder; name another output folder");
    }
    if (!fs::exists(path_, cause) && fs::is_symlink(fs::symlink_status(path_, cause))) {
        throw Error(ExitCode::output,
                    path_ + ": is a symbolic link to nothing; make the folder or name another");
    }
    if (!force_ && !is_empty_or_missing(path_)) {
        throw Error(
            ExitCode::output,
            path_ +
                ": the output folder is not empty; name another or allow replacing its results with --force");
    }
}

void OutputDirectory::refuse_what_is_in_the_way() const {
    std::error_code ignored;
    if (!fs::is_directory(path_, ignored)) return;
    refuse_open_session(path_);
    refuse_folders_for_files(path_,
                             [](const fs::path& path) { return is_result_file(path.filename().string()); });
    for (const MeshResult& result : replaced_results()) {
        const fs::path folder = fs::path(path_) / result.folder;
        if (!is_there_as_folder(folder)) continue;
        refuse_folders_for_files(folder,
                                 [&](const fs::path& path) { return path.extension() == result.suffix; });
        refuse_unwritable(folder);
    }
    const fs::path levels = fs::path(path_) / result_files::levels;
    if (is_there_as_folder(levels)) refuse_unwritable(levels);
}

void OutputDirectory::try_names(const std::vector<std::string>& names, std::uintmax_t input_bytes) const {
    const auto longest =
        std::max_element(names.begin(), names.end(),
                         [](const std::string& a, const std::string& b) { return a.size() < b.size(); });
    if (longest != names.end()) try_name(staging_, *longest);
    for (const std::string& name : names) {
        if (!is_ascii(name)) try_name(staging_, name);
    }
    refuse_too_little_space(staging_, input_bytes);
}

void OutputDirectory::create() {
    std::error_code cause;
    std::vector<fs::path> missing;
    for (fs::path parent = fs::path(path_).parent_path(); !fs::exists(parent, cause);
         parent = parent.parent_path())
        missing.push_back(parent);
    std::reverse(missing.begin(), missing.end());
    for (const fs::path& parent : missing) {
        if (fs::create_directory(parent, cause)) created_parents_.push_back(parent);
        if (cause) fail(parent, "the folder cannot be created", cause);
    }
    remove_leftovers(staging_prefix(path_));
    fs::remove_all(staging_, cause);  // of a dead process with the same number
    fs::create_directory(staging_, cause);
    if (cause) fail(path_, "the output folder cannot be created", cause);
    for (const MeshResult& result : result_files::of_meshes) {
        fs::create_directory(fs::path(staging_) / result.folder, cause);
        if (cause) fail(path_, "the output folder cannot be created", cause);
    }
}

void OutputDirectory::commit() {
    const std::lock_guard<std::mutex> lock(mutex_);
    refuse_what_is_there();
    std::error_code cause;
    if (fs::exists(path_, cause)) {
        move_into_existing();
        fs::remove_all(staging_, cause);
    } else {
        fs::rename(staging_, path_, cause);
        if (cause) fail(path_, "the output folder cannot be put in place", cause);
    }
    is_committed_ = true;
}

void OutputDirectory::move_into_existing() const {
    if (is_of_a_run(path_)) {
        for (const std::string name : {result_files::names, result_files::corrections})
            keep_work_of_a_person(name, path_, staging_);
        for (const MeshResult& result : replaced_results())
            remove_stale(result.folder, result.suffix, path_, staging_);
        remove_stale_levels(path_, staging_);
        remove_stale_files(path_, staging_);
    }
    merge_folder(staging_, path_);
}

void OutputDirectory::remove_partial() noexcept {
    std::error_code ignored;
    // Folders that are still empty go without a file being opened, which a process may not be able to do.
    for (const MeshResult& result : result_files::of_meshes)
        fs::remove(fs::path(staging_) / result.folder, ignored);
    fs::remove(staging_, ignored);
    // Other ranks may still be writing: a file that appears while the folder is emptied keeps it.
    constexpr int attempts = 20;
    for (int k = 0; k < attempts; ++k) {
        fs::remove_all(staging_, ignored);
        if (!fs::exists(staging_, ignored)) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    for (auto parent = created_parents_.rbegin(); parent != created_parents_.rend(); ++parent)
        fs::remove(*parent, ignored);
}

}  // namespace coseg
