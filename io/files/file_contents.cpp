#include "io/files/file_contents.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16U;

/// What the file system says; 0 for pipes and others whose size shows only at their end.
std::size_t expected_bytes(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return 0;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : static_cast<std::size_t>(size);
}

/// What is at the path, where it is no regular file; empty where it is one.
std::string other_than_a_file(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code cause;
    const fs::file_status status = fs::status(path, cause);
    std::error_code ignored;
    const bool is_link = fs::is_symlink(fs::symlink_status(path, ignored));
    if (is_link && status.type() == fs::file_type::not_found)
        return "is a link to " + fs::read_symlink(path, ignored).string() + ", which is not there";
    if (cause == std::errc::too_many_symbolic_link_levels) return "is a link that leads back to itself";
    if (status.type() == fs::file_type::not_found) return {};  // for the one that opens it to say
    if (cause) return "cannot be opened (" + cause.message() + ")";
    if (fs::is_regular_file(status)) return {};
    if (fs::is_directory(status)) return "is a folder, not a file";
    if (fs::is_fifo(status)) return "is a pipe, not a file";
    return "is a device or a socket, not a file";
}

}  // namespace

void require_regular_file(const std::string& path) {
    if (const std::string other = other_than_a_file(path); !other.empty())
        throw Error(ExitCode::input, path + ": " + other);
}

std::string read_regular_file(const std::string& path) {
    require_regular_file(path);
    return read_file(path);
}

std::string read_file(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw Error(ExitCode::input, path + ": cannot be opened (" + std::strerror(errno) + ")");
    // Room for the whole file at once: a string that grows would hold a large mesh twice. The file may have
    // changed since its size was asked for, so reading goes on until its end.
    std::string bytes(expected_bytes(path), '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    std::string block(block_bytes, '\0');
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get()))
        bytes.append(block, 0, count);
    if (std::ferror(file.get()) != 0) {
        throw Error(ExitCode::input, path + ": cannot be read (" + std::strerror(errno) + ")");
    }
    return bytes;
}

}  // namespace coseg
