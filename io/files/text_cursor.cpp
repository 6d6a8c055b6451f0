#include "io/files/text_cursor.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

/// A space, or one of the control characters \t \n \v \f \r, which follow each other in ASCII.
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool is_blank_to_the_end(std::string_view rest) { return std::all_of(rest.begin(), rest.end(), is_blank); }

/// The sign of a comment behind a point is part of a number, "1.#QNAN".
std::size_t comment_begin(std::string_view line, char comment) {
    std::size_t begin = line.find(comment);
    while (begin != std::string_view::npos && begin > 0 && line[begin - 1] == '.')
        begin = line.find(comment, begin + 1);
    return begin;
}

/// What Microsoft's older libraries write for numbers that are none: "1.#QNAN", "-1.#IND", "1.#INF".
bool is_windows_no_number(std::string_view word) {
    if (!word.empty() && (word.front() == '-' || word.front() == '+')) word.remove_prefix(1);
    return word.starts_with("1.#");
}

}  // namespace

TextCursor::TextCursor(std::string_view text, std::string path, char comment)
    : text_(text), path_(std::move(path)), comment_(comment) {
    if (text_.substr(0, byte_order_mark.size()) == byte_order_mark) next_ = byte_order_mark.size();
}

void TextCursor::take_line() {
    const std::size_t begin = next_;
    std::size_t end = begin;
    while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') ++end;
    next_ = std::min(end + 1, text_.size());
    if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++next_;
    rest_ = text_.substr(begin, end - begin);
    if (comment_ != 0) rest_ = rest_.substr(0, comment_begin(rest_, comment_));
    ++line_;
}

bool TextCursor::next_line() {
    while (next_ < text_.size()) {
        take_line();
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
        if (!rest_.empty()) return true;
    }
    rest_ = {};
    return false;
}

std::string_view TextCursor::word() {
    while (true) {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
        if (!joins_lines_ || rest_.empty() || rest_.front() != '\\') break;
        if (!is_blank_to_the_end(rest_.substr(1)) || next_ >= text_.size()) break;
        take_line();
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length])) ++length;
    const bool may_join = joins_lines_ && length > 1 && rest_[length - 1] == '\\';
    if (may_join && is_blank_to_the_end(rest_.substr(length))) --length;
    const std::string_view found = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return found;
}

std::string_view TextCursor::word_on_any_line() {
    while (true) {
        if (rest_.empty() && !next_line()) return {};
        const std::string_view found = word();
        if (!found.empty()) return found;
    }
}

void TextCursor::fail(const std::string& sentence) const {
    throw Error(ExitCode::input,
                path_ + ":" + std::to_string(std::max<std::int64_t>(line_, 1)) + ": " + sentence);
}

bool parse_real(std::string_view word, double& value) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [end, cause] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) {
        const auto read = static_cast<std::size_t>(end - word.data());
        if (read > 0 && (word[read] == 'd' || word[read] == 'D'))
            return parse_real(std::string(word.substr(0, read)).append("e").append(word.substr(read + 1)),
                              value);
        value = std::numeric_limits<double>::quiet_NaN();
        return is_windows_no_number(word);
    }
    if (cause == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
    return cause == std::errc() || cause == std::errc::result_out_of_range;
}

bool parse_integer(std::string_view word, std::int64_t& value) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [end, cause] = std::from_chars(word.data(), word.data() + word.size(), value);
    return cause == std::errc() && end == word.data() + word.size() && !word.empty();
}

bool parse_whole(std::string_view word, std::int64_t& value) {
    if (parse_integer(word, value)) return true;
    constexpr double largest = 9e15;  // whole numbers below it are exact
    double real = 0.0;
    if (!parse_real(word, real) || !(std::abs(real) <= largest) || real != std::floor(real)) return false;
    value = static_cast<std::int64_t>(real);
    return true;
}

std::string printable(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string shown;
    for (const char c : word.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (word.size() > longest ? "..." : "");
}

std::string in_quotes(std::string_view word) { return "'" + printable(word) + "'"; }

std::string no_number(std::string_view word) {
    const bool has_comma = word.find(',') != std::string_view::npos;
    return in_quotes(word) +
           (has_comma ? "; export the mesh with decimal points, and with blanks between numbers" : "");
}

}  // namespace coseg
