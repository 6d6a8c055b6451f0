#pragma once
// Finds, for faces that the working mesh no longer has, the neighbours whose label they take.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// For each input face the face whose label it takes: itself if has_working_face, else the face with a
/// working face that shares the most vertices with it (of several the one with the nearest centroid, then the
/// lowest number), else the face with a working face whose centroid is nearest. vertex_of maps a corner's
/// vertex to the welded vertex. At least one face must have a working face.
std::vector<int> label_donor_faces(const PolygonMesh& mesh, const std::vector<int>& vertex_of,
                                   const std::vector<char>& has_working_face);

}  // namespace coseg
