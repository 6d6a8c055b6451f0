#pragma once
// Computes geodesic distances from a few hundred sample faces to every face. Average geodesic distance and
// shape context are both made from this one table.

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
/// - The first sample is the face whose centroid is farthest from the area-weighted centroid. Each next one
///   is the face farthest from those before it; `seed` decides only between faces at the same distance.
///   Samples are stored grouped by neighbourhood, not in the order in which they were found.
/// - A sample starts at the centroid of its face. The distance of another face is the mean of the distances
///   of its three vertices, which is the distance at its centroid where distances are locally linear. The
///   distance of a sample to its own face is 0.
/// - Distances are lengths of shortest paths in surface_graph, in single precision.
/// The edges of graph, virtual ones included, must connect it, as those of dual_graph do. Throws
/// Error(internal) if they do not, if samples < 1, or if the mesh has no face.
/// Sources: sample points and their Voronoi areas: Kalogerakis, Hertzmann, Singh 2010, whose sums run over
/// all faces; farthest points: Gonzalez 1985; shortcuts: as in surface_graph.hpp.
GeodesicTable geodesic_table(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph,
                             int samples, std::uint64_t seed);

}  // namespace coseg
