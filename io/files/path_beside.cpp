#include "io/files/path_beside.hpp"

#include "src/base/seeded_random.hpp"

namespace coseg {

std::string path_beside(const std::string& path, const std::string& suffix, std::size_t spare) {
    constexpr std::size_t longest_name = 255;
    constexpr std::size_t hash_digits = 20;              // of 64 bits, in decimal
    const std::size_t name_begin = path.rfind('/') + 1;  // 0 if there is no folder
    const std::size_t taken = suffix.size() + spare;
    if (path.size() - name_begin + taken <= longest_name) return path + suffix;
    return path.substr(0, name_begin + longest_name - hash_digits - taken) + std::to_string(hash_text(path)) +
           suffix;
}

}  // namespace coseg
