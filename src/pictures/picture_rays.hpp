#pragma once
// Traces rays into a mesh for drawing: what the eye meets, and what blocks the light.

#include <Eigen/Core>
#include <array>

#include "src/mesh/ray_scene.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// A mesh of about unit size, prepared for rays in single precision. Serial: it starts no threads. Throws
/// Error(internal) if the ray tracer cannot be set up.
class PictureRays {
  public:
    static constexpr int packet = 16;

    struct Hit {
        int triangle = -1;  ///< -1: nothing met
        float u = 0.0F;     ///< barycentric coordinates of the second and third corner
        float v = 0.0F;
        float distance = 0.0F;
    };

    explicit PictureRays(const TriMesh& mesh);

    /// The nearest triangle along each of 16 rays from one eye, whichever side of it is met.
    std::array<Hit, packet> look(const Eigen::Vector3f& eye,
                                 const std::array<Eigen::Vector3f, packet>& directions) const;

    /// How many of 16 rays from a point on the surface meet something before `reach`.
    int blocked(const Eigen::Vector3f& from, const std::array<Eigen::Vector3f, packet>& directions,
                float reach) const;

  private:
    RayScene scene_;
};

}  // namespace coseg
