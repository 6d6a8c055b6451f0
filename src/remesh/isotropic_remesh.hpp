#pragma once
// Even triangles of a wanted edge length on a given surface.

#include <Eigen/Core>
#include <functional>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct RemeshOptions {
    double edge_length = 0.0;  ///< wanted mean, in the mesh's unit; see edge_length_for
    int iterations = 6;        ///< rounds of split, collapse, flip, relax
    double smallest_share =
        1.0;  ///< edges may shrink to this share of edge_length where the surface turns by more
              ///< than a radian per edge (thin limbs, rims); 1: the same length everywhere
    double sharp_angle = 3.15;  ///< radians; edges that turn by more are kept as lines (above pi: none are)
};

/// Where a relaxed vertex goes: a point of the surface near `point`; `normal` is the mesh's there.
using SurfaceProjection =
    std::function<Eigen::Vector3d(const Eigen::Vector3d& point, const Eigen::Vector3d& normal)>;

/// The edge length at which an even mesh of that area has about `faces` faces.
double edge_length_for(double area, int faces);

/// Remeshes a manifold mesh: splits edges longer than 4/3, collapses those shorter than 4/5 of the wanted
/// length, flips towards six neighbours, moves vertices tangentially to even out areas and projects them.
/// Topology is kept. Boundaries and sharp edges stay: their vertices move along them only, corners not at
/// all. Deterministic. Throws Error(input) if the mesh is not manifold or edge_length <= 0. Source: Botsch,
/// Kobbelt 2004, "A remeshing approach to multiresolution modeling", section 4.
TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options, const SurfaceProjection& project);

/// The same with the input's own triangles as the surface and its sharp edges and boundary as the lines.
/// nearest_faces (src/mesh/closest_point.hpp) carries labels to and fro.
TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options);

}  // namespace coseg
