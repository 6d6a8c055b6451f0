#include "io/files/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "src/base/error.hpp"

namespace coseg {

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), temporary_(path + ".partial-" + std::to_string(::getpid())) {
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
    errno = 0;
    stream_.close();
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
