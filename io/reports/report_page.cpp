#include "io/reports/report_page.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/reports/page_pieces.hpp"
#include "io/reports/web_assets.hpp"
#include "src/base/text.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

constexpr std::uint16_t wrong_bit = 0x8000;
constexpr int most_short_vertices = 65535;

nlohmann::ordered_json or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string page_data(const ReportPage& page) {
    nlohmann::ordered_json data;
    data["report"] = nlohmann::ordered_json::parse(page.report_json);
    data["accuracy"] = or_null(page.accuracy);
    data["towards"] = {page.view.towards.x(), page.view.towards.y(), page.view.towards.z()};
    data["up"] = {page.view.up.x(), page.view.up.y(), page.view.up.z()};
    for (int part = 0; part < part_color_count; ++part) data["colors"].push_back(hex_color(part_color(part)));
    for (const PageShape& shape : page.shapes)
        data["shapes"].push_back({{"accuracy", or_null(shape.accuracy)}});
    std::string text = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string safe;
    for (const char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
    return safe;
}

std::string mesh_elements(const ReportPage& page) {
    std::string text;
    for (std::size_t k = 0; k < page.shapes.size(); ++k) {
        if (page.shapes[k].packed.empty()) continue;
        text += "<script type=\"text/plain\" id=\"mesh" + std::to_string(k) + "\">" + page.shapes[k].packed +
                "</script>\n";
    }
    return text;
}

}  // namespace

std::string packed_mesh(const TriMesh& mesh, const std::vector<int>& labels,
                        const std::vector<bool>& is_wrong) {
    std::string bytes = packed_vertices(mesh);
    const bool is_long = mesh.vertex_count() > most_short_vertices;
    for (const int vertex : mesh.faces.reshaped()) {
        if (is_long)
            append_little_endian(bytes, static_cast<std::uint32_t>(vertex));
        else
            append_little_endian(bytes, static_cast<std::uint16_t>(vertex));
    }
    for (std::size_t f = 0; f < labels.size(); ++f) {
        const auto label = static_cast<std::uint16_t>(labels[f]);
        append_little_endian(bytes, static_cast<std::uint16_t>(is_wrong[f] ? label | wrong_bit : label));
    }
    return base64(bytes);
}

bool can_write_report_page() { return web_assets().has_libraries(); }

void write_report_page(const std::string& path, const ReportPage& page) {
    const WebAssets& assets = assets_of_page("it cannot make report.html");
    const std::string sheet =
        page.sheet_png.empty()
            ? "<p class=\"faint\">The run drew no contact sheet.</p>"
            : "<img class=\"sheet\" alt=\"all shapes, coloured by part\" src=\"data:image/png;base64," +
                  base64(page.sheet_png) + "\">";
    write_file(path, filled(assets.page, {{"TITLE", escaped(page.title)},
                                          {"STYLE", std::string(assets.style)},
                                          {"SHEET", sheet},
                                          {"LICENCES", escaped(assets.licences)},
                                          {"DATA", page_data(page)},
                                          {"MESHES", mesh_elements(page)},
                                          {"THREE", inside_script(assets.three)},
                                          {"CONTROLS", inside_script(assets.controls)},
                                          {"CHART", inside_script(assets.chart)},
                                          {"ELEMENTS", inside_script(assets.elements)},
                                          {"SCRIPT", inside_script(assets.script)}}));
}

}  // namespace coseg
