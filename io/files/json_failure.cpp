#include "io/files/json_failure.hpp"

#include <string_view>

namespace coseg {

namespace {

constexpr std::size_t most_shown = 80;
constexpr std::size_t longest_sentence = 300;

std::string with_printable_end(std::string_view text) {
    const bool is_cut = text.size() > most_shown;
    if (is_cut) text.remove_prefix(text.size() - most_shown);
    std::string shown = is_cut ? "..." : "";
    for (const char c : text) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown;
}

}  // namespace

std::string json_failure(const std::exception& failure) {
    std::string_view what = failure.what();
    if (what.empty()) return {};
    if (const std::size_t number = what.find("] "); what.starts_with("[json.") && number != what.npos)
        what.remove_prefix(number + 2);
    constexpr std::string_view mark = "last read: '";
    const std::size_t begin = what.find(mark);
    std::size_t end = what.rfind("'; expected ");
    if (end == std::string_view::npos || what.size() - end > most_shown) end = what.size() - 1;
    if (begin == std::string_view::npos || end < begin + mark.size())
        return std::string(what.substr(0, longest_sentence));
    const std::size_t read = begin + mark.size();
    return std::string(what.substr(0, read)) + with_printable_end(what.substr(read, end - read)) +
           std::string(what.substr(end));
}

}  // namespace coseg
