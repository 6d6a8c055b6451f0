#pragma once
// A coarser mesh for looking at.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct ClusteredMesh {
    TriMesh mesh;
    std::vector<int> triangle;  ///< per triangle the one of the input that it was
};

/// The mesh with at most `most_faces` triangles: vertices in one cell of a grid become their mean, and triangles that
/// fall together or lose their area go. The finest grid that does it; the mesh as it is if it has no more. Keeps no topology.
/// Source: Rossignac and Borrel 1993.
ClusteredMesh clustered(const TriMesh& mesh, int most_faces);

}  // namespace coseg
