#pragma once
// The graph of faces: each face is a node, each mesh edge between two faces is an edge, and virtual edges
// join components that share no mesh edge.

#include <tuple>
#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct DualEdge {
    int face_a = -1;  ///< face_a < face_b
    int face_b = -1;
    int vertex_a = -1;  ///< the mesh edge's end points; -1 for a virtual edge, and only there
    int vertex_b = -1;
    double length = 0.0;  ///< the mesh edge's; a virtual edge has a fictitious short one
    /// Radians in (0, 2 pi), measured OUTSIDE the solid: less than pi is concave, pi flat, more than pi
    /// convex.
    double dihedral = 0.0;
    /// Whether it joins two components that share no mesh edge.
    [[nodiscard]] bool is_virtual() const noexcept { return vertex_a < 0; }
    static constexpr auto fields() {
        return std::tuple(field("face_a", &DualEdge::face_a), field("face_b", &DualEdge::face_b),
                          field("vertex_a", &DualEdge::vertex_a), field("vertex_b", &DualEdge::vertex_b),
                          field("length", &DualEdge::length), field("dihedral", &DualEdge::dihedral));
    }
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
    /// The rest follows from these, see index_incidence.
    static constexpr auto fields() {
        return std::tuple(field("face_count", &DualGraph::face_count), field("edges", &DualGraph::edges),
                          local(&DualGraph::offsets), local(&DualGraph::incident));
    }
};

/// The dual graph of a mesh; it is always connected. Boundary edges of the mesh have no entry. geometry is
/// face_geometry(mesh). Components that share no edge are joined by virtual edges along a minimum spanning
/// tree, in which the distance of two components is that of their nearest face centroids. A virtual edge is
/// flat (dihedral pi) and 0.1 sqrt(mean face area) long, however wide the gap is. It is short because parts
/// that do not touch should be cheap to cut apart.
DualGraph dual_graph(const TriMesh& mesh, const FaceGeometry& geometry);

/// Fills `offsets` and `incident` from `face_count` and `edges`.
void index_incidence(DualGraph& graph);

/// Frees both, for a graph that waits among those of a collection until its faces get labels.
void release_incidence(DualGraph& graph);

/// The component of every face when virtual edges are left out. Components are numbered from 0 in the order
/// of their lowest face.
std::vector<int> face_components(const DualGraph& graph);

}  // namespace coseg
