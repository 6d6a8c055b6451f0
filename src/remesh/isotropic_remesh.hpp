#pragma once
// Covers a given surface with even triangles of a wanted edge length.

#include <Eigen/Core>
#include <functional>
#include <limits>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct RemeshOptions {
    double edge_length = 0.0;  ///< the wanted mean, in the mesh's unit; see edge_length_for
    int iterations = 6;        ///< rounds of split, collapse, flip, relax
    /// Edges may shrink to this share of edge_length where the surface turns by more than a radian per edge,
    /// as on thin limbs and rims. With 1 the length is the same everywhere.
    double smallest_share = 1.0;
    double sharp_angle = 3.15;  ///< radians; edges that turn by more are kept (above pi: none)
    int most_faces = std::numeric_limits<int>::max();          ///< of the result
    int most_faces_at_once = std::numeric_limits<int>::max();  ///< while edges are split
};

/// Gives the point of the surface near `point` to which a relaxed vertex is moved; `normal` is the mesh's
/// normal there.
using SurfaceProjection =
    std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// The edge length at which an even mesh of that area has about `faces` faces.
double edge_length_for(double area, int faces);

/// Remeshes a manifold mesh. It splits edges longer than 4/3 and collapses edges shorter than 4/5 of the
/// wanted length, flips edges so that vertices have six neighbours, moves vertices tangentially to even
/// out areas, and projects them onto the surface. The topology is kept. Boundaries and sharp edges stay:
/// their vertices move along them only, and corners do not move. Deterministic.
///
/// Time and memory are bounded by most_faces_at_once and the number of rounds, whatever the ratio of
/// lengths in the mesh. A round that would pass it ends the rounds, and so does one that leaves more than
/// most_faces and more than the round before. If the last round left too many faces, the result is that
/// of the round that left the fewest. Throws Error(input) if no round stays within both limits, if the
/// mesh is not manifold, or if edge_length <= 0. Source: Botsch, Kobbelt 2004, "A remeshing approach to
/// multiresolution modeling", section 4.
TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options, const SurfaceProjection& project);

/// The same, with the triangles of the input as the surface, and its sharp edges and boundary as the lines.
/// nearest_faces (src/mesh/closest_point.hpp) carries labels from one mesh to the other.
TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options);

}  // namespace coseg
