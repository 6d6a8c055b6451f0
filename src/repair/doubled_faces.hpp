#pragma once
// Finds faces that lie exactly upon each other, as in files that hold every face twice or sheets with a face
// for either side.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// Faces are doubles if their corners have the same coordinates, in any order (-0 equals 0).
struct DoubledFaces {
    /// Per vertex the one that stands for it: as given, and in pieces that are left out in part the lowest
    /// one with the same coordinates.
    std::vector<int> vertex_of;
    /// Per face the one whose label it shares, which is not left out and shares that of no other; itself if
    /// it shares none.
    std::vector<int> label_of;
    std::vector<char> left_out;  ///< per face whether another one stands for it in the working mesh
    int count = 0;               ///< faces that share the label of another one
};

/// A piece (polygon_edges.hpp) at least nine tenths of whose faces have doubles lies wholly upon itself or
/// another piece. Of the doubles in such pieces one is kept, the lowest, or none where a face of another
/// piece is there as well. The surface is then what it would be if the file held each face once. Elsewhere
/// doubles stay, because to leave one out would open a solid or take a fin from its body; they share a label
/// if they also have the same vertices. vertex_of: the stand-ins found so far. Without doubles nothing
/// changes. Time: O(n log n).
DoubledFaces find_doubled_faces(const PolygonMesh& mesh, std::vector<int> vertex_of);

}  // namespace coseg
