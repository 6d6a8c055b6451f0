#pragma once
// Writes numbers into text with as many digits as they need to be read back unchanged.

#include <Eigen/Core>
#include <charconv>
#include <string>

namespace coseg {

/// The fewest digits that give the same number again, and a character behind them.
template <typename Number>
void append_number(std::string& text, Number number, char separator) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
    text.push_back(separator);
}

/// The rest of a line: three numbers with blanks between them.
inline void append_point(std::string& text, const Eigen::Vector3d& p) {
    append_number(text, p.x(), ' ');
    append_number(text, p.y(), ' ');
    append_number(text, p.z(), '\n');
}

}  // namespace coseg
