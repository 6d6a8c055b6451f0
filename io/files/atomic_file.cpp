#include "io/files/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// Beside the file. Where its name is so long that none longer is allowed, a hash stands for its end.
std::string temporary_path(const std::string& path) {
    constexpr std::size_t longest = 200;
    const std::string mark = ".partial-" + std::to_string(::getpid());
    const std::size_t name_begin = path.rfind('/') + 1;  // 0 if there is no folder
    if (path.size() - name_begin <= longest) return path + mark;
    return path.substr(0, name_begin + longest - 16) + std::to_string(hash_text(path)) + mark;
}

bool is_cause_of_writing(int cause) {
    return cause == ENOSPC || cause == EDQUOT || cause == EFBIG || cause == EIO;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), temporary_(temporary_path(path)) {
    errno = 0;
    stream_.open(temporary_, std::ios::binary | std::ios::trunc);
    if (!stream_) fail("cannot be created");
}

AtomicFile::~AtomicFile() {
    if (is_committed_) return;
    stream_.close();
    std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
    // Where an earlier write has failed, its cause may still be there.
    const bool has_failed = !stream_;
    if (!has_failed || !is_cause_of_writing(errno)) errno = 0;
    const int cause = errno;
    stream_.close();
    if (has_failed) errno = cause;
    if (!stream_) fail("cannot be written");
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be put in place");
    is_committed_ = true;
}

void AtomicFile::fail(const std::string& what) {
    const std::string cause = errno != 0 ? std::strerror(errno) : "write error";
    stream_.close();
    std::remove(temporary_.c_str());
    throw Error(ExitCode::output,
                path_ + ": " + what + " (" + cause + "); check the folder and the free space");
}

void write_file(const std::string& path, std::string_view content) {
    AtomicFile file(path);
    file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
    file.commit();
}

}  // namespace coseg
