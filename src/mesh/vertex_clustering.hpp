#pragma once
// Makes a coarser mesh for display.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct ClusteredMesh {
    TriMesh mesh;
    std::vector<int> triangle;  ///< per triangle: the triangle of the input that it was
};

/// The mesh with at most `most_faces` triangles. Vertices in one cell of a grid are replaced by their mean.
/// Triangles that become equal or lose their area are removed. The grid is the finest that reaches the
/// number; a mesh that already has no more triangles is returned as it is. The topology is not kept.
/// Source: Rossignac and Borrel 1993.
ClusteredMesh clustered(const TriMesh& mesh, int most_faces);

}  // namespace coseg
