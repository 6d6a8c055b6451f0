#pragma once
// Geodesic distances from a few hundred sample faces to every face: the one table that average geodesic
// distance and shape context are made from.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct GeodesicTable {
    Eigen::MatrixXf distance;       ///< samples x F, column major, in the mesh's unit, finite, >= 0
    std::vector<int> sample_face;   ///< distinct faces
    Eigen::VectorXd sample_weight;  ///< share of the area nearest to each sample, >= 0, sums to 1
};

/// Distances from `samples` farthest-point samples (fewer if the mesh has fewer faces) to every face of a
/// mesh.
/// - The first sample is the face whose centroid is farthest from the area-weighted centroid; each next one
/// the face
///   farthest from those before; `seed` decides only between faces equally far. Samples are stored grouped by
///   neighbourhood, not in the order found.
/// - A sample starts at its face's centroid; the distance of another face is the mean of its three vertices'
///   distances (the distance at its centroid where distances are locally linear), its own is 0.
/// - Distances are shortest paths in surface_graph, in single precision.
/// Sources: sample points and their Voronoi areas as in Kalogerakis, Hertzmann, Singh 2010, whose sums run
/// over all faces; farthest points: Gonzalez 1985; shortcuts: as in surface_graph.hpp. graph must be
/// connected by its edges, virtual ones included (dual_graph's is); throws Error(internal) if not. Throws
/// Error(internal) if samples < 1 or the mesh has no face.
GeodesicTable geodesic_table(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph,
                             int samples, std::uint64_t seed);

/// Distance of every vertex from one vertex; infinity where no path leads (a vertex of no face).
Eigen::VectorXf geodesic_distances(const TriMesh& mesh, const DualGraph& graph, int source_vertex);

}  // namespace coseg
