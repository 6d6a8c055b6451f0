#pragma once
// Faces that left the working mesh, and the neighbours whose label they take.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Per input face: itself if has_working_face, else the face with a working face that shares the most
/// vertices with it (ties: nearest centroid, then lowest number), else the one with the nearest centroid.
/// vertex_of maps a corner's vertex to the welded vertex. At least one face has a working face.
std::vector<int> label_donor_faces(const PolygonMesh& mesh, const std::vector<int>& vertex_of,
                                   const std::vector<char>& has_working_face);

}  // namespace coseg
