#include "src/base/text.hpp"

#include <cstdio>

namespace coseg {

std::string significant(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string decimal(double value, int digits) {
    std::string text(32, '\0');
    const int length = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    if (length >= static_cast<int>(text.size())) {
        text.resize(static_cast<std::size_t>(length) + 1);
        std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    }
    text.resize(static_cast<std::size_t>(length));
    return text;
}

std::string percent(double share, int digits) { return decimal(100.0 * share, digits) + " %"; }

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

}  // namespace coseg
