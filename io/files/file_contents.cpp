#include "io/files/file_contents.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "src/base/error.hpp"

namespace coseg {

std::string read_file(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw Error(ExitCode::input, path + ": cannot be opened (" + std::strerror(errno) + ")");
    std::string bytes;
    std::string block(std::size_t{1} << 20U, '\0');
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get()))
        bytes.append(block, 0, count);
    if (std::ferror(file.get()) != 0) {
        throw Error(ExitCode::input, path + ": cannot be read (" + std::strerror(errno) + ")");
    }
    return bytes;
}

}  // namespace coseg
