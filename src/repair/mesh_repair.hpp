#pragma once
// From the polygons of a file to a triangle mesh that every geometric stage can rely on.

#include <string>
#include <vector>

#include "src/mesh/face_map.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct RepairedMesh {
    TriMesh mesh;  ///< at most two faces an edge, in opposite directions; one fan a vertex
    FaceMap map;   ///< working faces -> input faces; refers to input_faces = input.face_count()
    std::vector<std::string>
        warnings;  ///< one short sentence with counts per kind of repair, beginning with name
};

/// Triangulates polygons (polygon_triangulation.hpp), welds repeated vertices (vertex_welding.hpp), takes out
/// faces without area (degenerate_faces.hpp; they get a stand-in, label_donor_faces.hpp), cuts non-manifold
/// edges and vertices and orients (manifold_cut.hpp), and leaves out vertices without a face. A closed,
/// outward, manifold triangle mesh comes back as it is: same faces, same vertices, no warning. Working faces
/// keep the order of their input faces, except that pieces of a face split to close the gap of a degenerate
/// neighbour come last. Depends on nothing but the input; name is for messages only. Throws Error(input) if a
/// corner is no vertex, a coordinate is not finite, or no face has an area.
RepairedMesh repair(const PolygonMesh& input, const std::string& name);

}  // namespace coseg
