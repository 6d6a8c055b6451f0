#include "src/mesh/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <new>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

void check(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw Error(ExitCode::internal, "Embree cannot prepare a mesh for rays (error " +
                                        std::to_string(static_cast<int>(error)) + ")");
}

RTCGeometry triangles(RTCDevice device, const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xi& corners) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* point_buffer = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), at(points.cols())));
    auto* corner_buffer = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), at(corners.cols())));
    if (point_buffer != nullptr && corner_buffer != nullptr) {
        Eigen::Map<Eigen::Matrix3Xf>(point_buffer, 3, points.cols()) = points;
        Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(corner_buffer, 3, corners.cols()) =
            corners.cast<unsigned>();
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

}  // namespace

void RayScene::DeviceRelease::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void RayScene::SceneRelease::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

RayScene::RayScene(const Eigen::Matrix3Xf& points, const Eigen::Matrix3Xi& corners, Filter filter)
    : device_(rtcNewDevice("threads=1,set_affinity=0")) {
    if (!device_) check(nullptr);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), filter == Filter::per_ray
                                       ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
                                       : RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = triangles(device_.get(), points, corners);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    check(device_.get());
    rtcCommitScene(scene_.get());
    check(device_.get());
}

}  // namespace coseg
