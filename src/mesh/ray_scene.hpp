#pragma once
// Gives a triangle mesh to the ray tracer Embree.

#include <Eigen/Core>
#include <memory>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace coseg {

/// Owns Embree's device and the scene of one mesh. Serial: it starts no threads. It can be moved, not copied.
class RayScene {
  public:
    /// Whether rays may have a filter of their own. Testing for one costs every ray a little time.
    enum class Filter { none, per_ray };

    /// points: 3 x V, corners: 3 x F. Hits are tested in Embree's robust mode, which misses no ray between
    /// two triangles that share an edge. Throws Error(internal) if Embree cannot prepare the scene.
    RayScene(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xi& corners, Filter filter);

    ~RayScene() = default;
    RayScene(RayScene&&) noexcept = default;
    RayScene& operator=(RayScene&&) = delete;
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// The scene for Embree's functions, valid during the lifetime of this object.
    [[nodiscard]] RTCSceneTy* get() const noexcept { return scene_.get(); }

  private:
    struct DeviceRelease {
        void operator()(RTCDeviceTy* device) const;
    };
    struct SceneRelease {
        void operator()(RTCSceneTy* scene) const;
    };
    std::unique_ptr<RTCDeviceTy, DeviceRelease> device_;  // released last
    std::unique_ptr<RTCSceneTy, SceneRelease> scene_;
};

/// Sets ray number i of `rays`, which is one of Embree's packets (RTCRay8, RTCRay16): from `from` along
/// `direction` between the distances `near` and `far`.
template <class Rays>
void set_ray(Rays& rays, int i, const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float near,
             float far) {
    rays.org_x[i] = from.x();
    rays.org_y[i] = from.y();
    rays.org_z[i] = from.z();
    rays.dir_x[i] = direction.x();
    rays.dir_y[i] = direction.y();
    rays.dir_z[i] = direction.z();
    rays.tnear[i] = near;
    rays.tfar[i] = far;
    rays.mask[i] = ~0U;
    rays.id[i] = static_cast<unsigned>(i);
}

}  // namespace coseg
