#pragma once
// Rays that start inside a solid and end where they leave it.

#include <Eigen/Core>
#include <span>

#include "src/mesh/ray_scene.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// A mesh prepared for ray casting in single precision, relative to its own centre and extent, so that
/// neither unit nor position matters. Serial: starts no threads. Errors: Error(internal) if the ray tracer
/// cannot be set up.
class InsideRays {
  public:
    /// mesh: at least one face, finite.
    explicit InsideRays(const TriMesh& mesh);

    /// Distance, in the unit of the mesh, from `origin` along each of n directions (3 x n, unit length) to
    /// the nearest face that the ray meets from inside (direction . normal > 0). `distance`: n values, 0
    /// where there is none, and where the ray has met a face from outside before: then it was not inside.
    /// What is nearer than 1e-6 of the mesh's extent is not seen. Faces within 1e-5 of it count as one place,
    /// where the exit counts: a ray that reaches a touching component has left its own.
    void cast(const Eigen::Vector3d& origin, const Eigen::Matrix3Xd& directions,
              std::span<double> distance) const;

  private:
    InsideRays(const TriMesh& mesh, const Eigen::Vector3d& centre, double scale);
    Eigen::Vector3d centre_;
    double scale_;
    RayScene scene_;
};

}  // namespace coseg
