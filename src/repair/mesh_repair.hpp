#pragma once
// Makes of the polygons of a file a triangle mesh that every geometric stage can rely on.

#include <string>
#include <vector>

#include "src/mesh/face_map.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/repair/border_welding.hpp"

namespace coseg {

struct RepairedMesh {
    TriMesh mesh;  ///< at most two faces an edge, in opposite directions; one fan a vertex
    FaceMap map;   ///< working faces -> input faces; refers to input_faces = input.face_count()
    /// One short sentence with counts for each kind of repair, beginning with the mesh's name.
    std::vector<std::string> warnings;
};

/// Repairs in seven steps: it welds repeated vertices (vertex_welding.hpp) and borders that nearly touch
/// (border_welding.hpp; within `welding`), lets faces that lie upon each other share a label
/// (doubled_faces.hpp), triangulates polygons (polygon_triangulation.hpp), removes spikes to single vertices
/// far away (outlying_vertices.hpp) and faces without area (degenerate_faces.hpp; label_donor_faces.hpp says
/// whose label either take), cuts non-manifold edges and vertices and orients the faces (manifold_cut.hpp),
/// and leaves out vertices without a face. Borders that nearly touch and stay apart are warned of. A closed,
/// outward, manifold triangle mesh comes back as it is, with the same faces and vertices and without a
/// warning. Working faces keep the order of their input faces. Only the pieces of a face that was split to
/// close the gap of a degenerate neighbour come last. Coordinates beyond 1e100 or all below 1e-100, whose
/// squares doubles do not hold, are scaled by a power of two. The result depends on nothing but the input;
/// name is for messages only. Throws Error(input) if a corner refers to no vertex, a coordinate is not
/// finite, or no face has an area.
RepairedMesh repair(const PolygonMesh& input, const std::string& name, const BorderLimits& welding = {});

}  // namespace coseg
