#include "io/files/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/files/path_beside.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

/// Whether the path leads to a pipe, a device or a socket, which takes what is written and is never replaced.
bool is_channel(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// The file that a link leads to, so that the link stays; the path itself where it is none.
std::string target_of(const std::string& path) {
    std::error_code cause;
    if (!fs::is_symlink(path, cause)) return path;
    const fs::path target = fs::canonical(path, cause);
    return cause ? path : target.string();
}

std::string temporary_path(const std::string& path) {
    return path_beside(path, ".partial-" + std::to_string(::getpid()));
}

/// Of a path that no file can have, the cause; else 0. Renaming would fail, but only when all is written.
int cause_against(const std::string& path) {
    std::error_code cause;
    const fs::file_status status = fs::status(path, cause);
    if (fs::is_directory(status)) return EISDIR;
    return cause == std::errc::filename_too_long ? ENAMETOOLONG : 0;
}

bool is_cause_of_writing(int cause) {
    return cause == ENOSPC || cause == EDQUOT || cause == EFBIG || cause == EIO;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), target_(target_of(path)), temporary_(is_channel(path) ? "" : temporary_path(target_)) {
    errno = cause_against(path_);
    if (errno != 0) fail("cannot be written");
    if (temporary_.empty())
        stream_.open(path_, std::ios::binary);
    else
        stream_.open(temporary_, std::ios::binary | std::ios::trunc);
    if (!stream_) fail("cannot be created");
}

AtomicFile::~AtomicFile() {
    if (is_committed_) return;
    stream_.close();
    remove_temporary();
}

void AtomicFile::remove_temporary() {
    if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
    // Where an earlier write has failed, its cause may still be there.
    const bool has_failed = !stream_;
    if (!has_failed || !is_cause_of_writing(errno)) errno = 0;
    const int cause = errno;
    stream_.close();
    if (has_failed) errno = cause;
    if (!stream_) fail("cannot be written");
    if (!temporary_.empty() && std::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail("cannot be put in place");
    is_committed_ = true;
}

void AtomicFile::fail(const std::string& what) {
    const std::string cause = errno != 0 ? std::strerror(errno) : "write error";
    stream_.close();
    remove_temporary();
    throw Error(ExitCode::output,
                path_ + ": " + what + " (" + cause + "); check the folder and the free space");
}

void try_file(const std::string& path) {
    if (!path.empty() && !is_channel(path)) const AtomicFile tried(path);
}

void write_file(const std::string& path, std::string_view content) {
    AtomicFile file(path);
    file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
    file.commit();
}

}  // namespace coseg
