#pragma once
// What pages that are one file are put together with.

#include <map>
#include <string>
#include <string_view>

#include "io/reports/web_assets.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/pictures/image.hpp"

namespace coseg {

std::string base64(std::string_view bytes);

/// The text of a script without what would end the script's element.
std::string inside_script(std::string_view text);

/// "#rrggbb".
std::string hex_color(const Color& color);

/// The beginning of a packed mesh: the numbers of vertices and of triangles, 32 bits each, and the
/// coordinates, which lie in [-1, 1], as 16 bits each, filled up to a multiple of 4 bytes. Little endian.
std::string packed_vertices(const TriMesh& mesh);

/// The texts of pages. Throws Error(internal) where the program was built without the libraries that pages
/// draw with: "this coseg was built without ..., so `lack`; install ...".
const WebAssets& assets_of_page(const std::string& lack);

/// The page's text with the pieces in place of their @NAME@; names that no piece has become nothing.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& pieces);

}  // namespace coseg
