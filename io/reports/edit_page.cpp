#include "io/reports/edit_page.hpp"

#include <nlohmann/json.hpp>

#include "io/files/byte_cursor.hpp"
#include "io/reports/page_pieces.hpp"
#include "src/base/text.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

std::string packed_edit_mesh(const TriMesh& mesh, const std::vector<int>& face_of_triangle) {
    std::string bytes = packed_vertices(mesh);
    for (const int vertex : mesh.faces.reshaped())
        append_little_endian(bytes, static_cast<std::uint32_t>(vertex));
    for (const int face : face_of_triangle) append_little_endian(bytes, static_cast<std::uint32_t>(face));
    return base64(bytes);
}

std::string edit_page(const std::string& title, const View& view) {
    const WebAssets& assets = assets_of_page("it has no page to edit in");
    nlohmann::ordered_json data;
    data["towards"] = {view.towards.x(), view.towards.y(), view.towards.z()};
    data["up"] = {view.up.x(), view.up.y(), view.up.z()};
    for (int part = 0; part < part_color_count; ++part) data["colors"].push_back(hex_color(part_color(part)));
    return filled(assets.edit_page, {{"TITLE", escaped(title)},
                                     {"STYLE", std::string(assets.edit_style)},
                                     {"DATA", data.dump()},
                                     {"LICENCES", escaped(assets.licences)},
                                     {"THREE", inside_script(assets.three)},
                                     {"CONTROLS", inside_script(assets.controls)},
                                     {"ELEMENTS", inside_script(assets.elements)},
                                     {"SCRIPT", inside_script(assets.edit_script)}});
}

}  // namespace coseg
