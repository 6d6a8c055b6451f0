#pragma once
// The graph of faces: one node a face, one edge for every mesh edge between two faces, and virtual edges
// that join separate components.

#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct DualEdge {
    int face_a = -1;  ///< face_a < face_b
    int face_b = -1;
    int vertex_a = -1;  ///< the mesh edge's end points; -1 for a virtual edge
    int vertex_b = -1;
    double length = 0.0;  ///< of the mesh edge; for a virtual edge: a fictitious short boundary
    double dihedral =
        0.0;  ///< radians in (0, 2 pi), measured OUTSIDE the solid: < pi concave, pi flat, > pi convex
    bool is_virtual = false;  ///< joins two components that share no mesh edge
};

/// Edges are sorted by (face_a, face_b), so that every loop over them has one order.
struct DualGraph {
    int face_count = 0;
    std::vector<DualEdge> edges;
    std::vector<int> offsets;   ///< F + 1: face f's incident edges are incident[offsets[f] .. offsets[f+1])
    std::vector<int> incident;  ///< indices into `edges`, ascending within a face

    [[nodiscard]] int other_face(int edge, int face) const {
        const DualEdge& e = edges[at(edge)];
        return e.face_a == face ? e.face_b : e.face_a;
    }
};

/// The dual graph of a mesh, connected. Boundary edges have no entry. geometry = face_geometry(mesh).
/// Components that share no edge are joined by virtual edges: a minimum spanning tree over the components,
/// two of which are as far apart as their nearest face centroids. A virtual edge is flat (dihedral pi) and
/// 0.1 sqrt(mean face area) long, whatever the gap: short, because parts that touch nowhere should be cheap
/// to cut apart.
DualGraph dual_graph(const TriMesh& mesh, const FaceGeometry& geometry);

/// Fills `offsets` and `incident` from `face_count` and `edges`.
void index_incidence(DualGraph& graph);

/// Component number 0.. of every face when virtual edges are left out, numbered by lowest face.
std::vector<int> face_components(const DualGraph& graph);

}  // namespace coseg
