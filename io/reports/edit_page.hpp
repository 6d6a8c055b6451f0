#pragma once
// The page in which a person corrects a run, as coseg edit serves it.

#include <string>
#include <vector>

#include "src/mesh/tri_mesh.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

/// A shape's triangles as the page reads them, in base64: as packed_mesh, but with uint32 corners always, and
/// in place of labels the number of each triangle's face in the file, uint32.
std::string packed_edit_mesh(const TriMesh& mesh, const std::vector<int>& face_of_triangle);

/// The page. It asks the server that it came from for everything else, and nobody else for anything. Throws
/// Error(internal) as write_report_page does where the libraries that draw are not built in.
std::string edit_page(const std::string& title, const View& view);

}  // namespace coseg
