#include "src/pictures/picture_rays.hpp"

#include <embree3/rtcore.h>

#include <limits>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void check(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw Error(ExitCode::internal, "Embree cannot prepare a picture (error " +
                                        std::to_string(static_cast<int>(error)) +
                                        "); check the memory available");
}

RTCGeometry triangles(RTCDevice device, const TriMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                static_cast<std::size_t>(mesh.vertex_count())));
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                static_cast<std::size_t>(mesh.face_count())));
    if (points != nullptr && corners != nullptr) {
        Eigen::Map<Eigen::Matrix3Xf>(points, 3, mesh.vertices.cols()) = mesh.vertices.cast<float>();
        Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(corners, 3, mesh.faces.cols()) =
            mesh.faces.cast<unsigned>();
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

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

constexpr std::array<int, PictureRays::packet> all_valid = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                            -1, -1, -1, -1, -1, -1, -1, -1};

}  // namespace

struct PictureRays::Scene {
    std::unique_ptr<RTCDeviceTy, DeviceRelease> device;  // released last
    std::unique_ptr<RTCSceneTy, SceneRelease> scene;
};

PictureRays::PictureRays(const TriMesh& mesh) : scene_(std::make_unique<Scene>()) {
    scene_->device.reset(rtcNewDevice("threads=1,set_affinity=0"));
    if (!scene_->device) check(nullptr);
    scene_->scene.reset(rtcNewScene(scene_->device.get()));
    rtcSetSceneFlags(scene_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = triangles(scene_->device.get(), mesh);
    rtcAttachGeometry(scene_->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    check(scene_->device.get());
    rtcCommitScene(scene_->scene.get());
    check(scene_->device.get());
}

PictureRays::~PictureRays() = default;

std::array<PictureRays::Hit, PictureRays::packet> PictureRays::look(
    const Eigen::Vector3f& eye, const std::array<Eigen::Vector3f, packet>& directions) const {
    alignas(64) RTCRayHit16 batch{};
    alignas(64) const std::array<int, packet> valid = all_valid;
    for (int i = 0; i < packet; ++i) {
        set_ray(batch.ray, i, eye, directions[at(i)], 0.0F, std::numeric_limits<float>::infinity());
        batch.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_->scene.get(), &context, &batch);
    std::array<Hit, packet> hits;
    for (int i = 0; i < packet; ++i) {
        if (batch.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        hits[at(i)] = {static_cast<int>(batch.hit.primID[i]), batch.hit.u[i], batch.hit.v[i],
                       batch.ray.tfar[i]};
    }
    return hits;
}

int PictureRays::blocked(const Eigen::Vector3f& from, const std::array<Eigen::Vector3f, packet>& directions,
                         float reach) const {
    alignas(64) RTCRay16 batch{};
    alignas(64) const std::array<int, packet> valid = all_valid;
    for (int i = 0; i < packet; ++i) set_ray(batch, i, from, directions[at(i)], 0.0F, reach);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid.data(), scene_->scene.get(), &context, &batch);
    int count = 0;
    for (const float far : batch.tfar) count += far < 0.0F ? 1 : 0;
    return count;
}

}  // namespace coseg
