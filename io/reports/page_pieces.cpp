#include "io/reports/page_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/files/byte_cursor.hpp"
#include "src/base/error.hpp"

namespace coseg {

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = (group << 8U) | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[(group >> (18U - 6U * k)) & 63U] : '=';
    }
    return text;
}

std::string inside_script(std::string_view text) {
    std::string safe;
    for (std::size_t i = 0; i < text.size(); ++i) {
        safe += text[i];
        if (text[i] == '<' && i + 1 < text.size() && text[i + 1] == '/') safe += '\\';
    }
    return safe;
}

std::string hex_color(const Color& color) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t channel : color) {
        text += digits[channel >> 4U];
        text += digits[channel & 15U];
    }
    return text;
}

std::string packed_vertices(const TriMesh& mesh) {
    std::string bytes;
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.vertex_count()));
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.face_count()));
    for (const double place : mesh.vertices.reshaped()) {
        const double share = std::clamp(0.5 * (place + 1.0), 0.0, 1.0);
        append_little_endian(bytes, static_cast<std::uint16_t>(std::lround(65535.0 * share)));
    }
    while (bytes.size() % 4 != 0) bytes += '\0';
    return bytes;
}

const WebAssets& assets_of_page(const std::string& lack) {
    const WebAssets& assets = web_assets();
    if (assets.has_libraries()) return assets;
    throw Error(ExitCode::internal, "this coseg was built without three.js and Chart.js, so " + lack +
                                        "; install libjs-three and libjs-chart.js and build it again");
}

std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& pieces) {
    std::string text;
    while (!page.empty()) {
        const std::size_t begin = page.find('@');
        const std::size_t end = begin == std::string_view::npos ? begin : page.find('@', begin + 1);
        if (end == std::string_view::npos) break;
        const auto piece = pieces.find(page.substr(begin + 1, end - begin - 1));
        text += page.substr(0, begin);
        if (piece != pieces.end()) text += piece->second;
        page.remove_prefix(end + 1);
    }
    return text += page;
}

}  // namespace coseg
