#include "src/descriptors/inside_rays.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int packet = 8;
constexpr float nearest = 1e-6F;     // of the extent: below it, single precision cannot tell sides
constexpr float same_place = 1e-5F;  // of the extent: faces of touching components

using PacketMask = std::array<int, packet>;  // -1 for the rays to be cast, else 0

/// One packet's context: Embree hands it to the filter. `entry`: the nearest face met from outside, per ray.
struct EntryContext {
    RTCIntersectContext embree;  // must come first
    std::array<float, packet> entry;
};

/// Positive where ray i of n leaves the solid.
float along_normal(RTCRayN* ray, RTCHitN* hit, unsigned n, unsigned i) {
    return RTCRayN_dir_x(ray, n, i) * RTCHitN_Ng_x(hit, n, i) +
           RTCRayN_dir_y(ray, n, i) * RTCHitN_Ng_y(hit, n, i) +
           RTCRayN_dir_z(ray, n, i) * RTCHitN_Ng_z(hit, n, i);
}

/// Keeps hits on faces that point along the ray and notes the others. Traversal tests every face before the
/// kept hit, so an entry before the exit is always noted.
void keep_exits(const RTCFilterFunctionNArguments* arguments) {
    auto* context = reinterpret_cast<EntryContext*>(arguments->context);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const float along = along_normal(arguments->ray, arguments->hit, n, i);
        if (along > 0.0F) continue;
        arguments->valid[i] = 0;
        float& entry = context->entry[RTCRayN_id(arguments->ray, n, i)];
        if (along < 0.0F) entry = std::min(entry, RTCRayN_tfar(arguments->ray, n, i));
    }
}

bool has_hit(const RTCRayHit8& batch, unsigned i) { return batch.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; }

/// Leaves in `mask` the rays whose nearest face is no exit, ready to be cast again as far as one may count; false if
/// there are none.
bool leave_undecided(RTCRayHit8& batch, PacketMask& mask) {
    auto* ray = reinterpret_cast<RTCRayN*>(&batch.ray);
    auto* hit = reinterpret_cast<RTCHitN*>(&batch.hit);
    bool any = false;
    for (unsigned i = 0; i < packet; ++i) {
        const float along = has_hit(batch, i) ? along_normal(ray, hit, packet, i) : 1.0F;
        if (mask[i] == 0 || along > 0.0F) {
            mask[i] = 0;
            continue;
        }
        any = true;
        batch.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        batch.ray.tfar[i] =
            along < 0.0F ? batch.ray.tfar[i] + 2.0F * same_place : std::numeric_limits<float>::infinity();
    }
    return any;
}

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneRelease>;

void check(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw Error(ExitCode::internal, "Embree cannot prepare the mesh for ray casting (error " +
                                        std::to_string(static_cast<int>(error)) +
                                        "); check the memory available");
}

/// Vertices centred and scaled to an extent of 1, as Embree reads them.
RTCGeometry triangles(RTCDevice device, const TriMesh& mesh, const Eigen::Vector3d& centre, double scale) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                static_cast<std::size_t>(mesh.vertex_count())));
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                static_cast<std::size_t>(mesh.face_count())));
    if (points != nullptr && corners != nullptr) {
        Eigen::Map<Eigen::Matrix3Xf>(points, 3, mesh.vertices.cols()) =
            ((mesh.vertices.colwise() - centre) * scale).cast<float>();
        Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(corners, 3, mesh.faces.cols()) =
            mesh.faces.cast<unsigned>();
    }
    rtcCommitGeometry(geometry);
    return geometry;
}

void set_ray(RTCRayHit8& batch, int i, const Eigen::Vector3f& from, const Eigen::Vector3f& direction) {
    batch.ray.org_x[i] = from.x();
    batch.ray.org_y[i] = from.y();
    batch.ray.org_z[i] = from.z();
    batch.ray.dir_x[i] = direction.x();
    batch.ray.dir_y[i] = direction.y();
    batch.ray.dir_z[i] = direction.z();
    batch.ray.tnear[i] = nearest;
    batch.ray.tfar[i] = std::numeric_limits<float>::infinity();
    batch.ray.mask[i] = ~0U;
    batch.ray.id[i] = static_cast<unsigned>(i);
    batch.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
}

}  // namespace

struct InsideRays::Scene {
    Device device;  // released last
    SceneHandle scene;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double scale = 1.0;
};

InsideRays::InsideRays(const TriMesh& mesh) : scene_(std::make_unique<Scene>()) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d high = mesh.vertices.rowwise().maxCoeff();
    const double extent = (high - low).maxCoeff();
    scene_->centre = 0.5 * (low + high);
    scene_->scale = extent > 0.0 ? 1.0 / extent : 1.0;

    scene_->device.reset(rtcNewDevice("threads=1,set_affinity=0"));
    if (!scene_->device) check(nullptr);
    scene_->scene.reset(rtcNewScene(scene_->device.get()));
    rtcSetSceneFlags(scene_->scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    RTCGeometry geometry = triangles(scene_->device.get(), mesh, scene_->centre, scene_->scale);
    rtcAttachGeometry(scene_->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    check(scene_->device.get());
    rtcCommitScene(scene_->scene.get());
    check(scene_->device.get());
}

InsideRays::~InsideRays() = default;
InsideRays::InsideRays(InsideRays&&) noexcept = default;
InsideRays& InsideRays::operator=(InsideRays&&) noexcept = default;

void InsideRays::cast(const Eigen::Vector3d& origin, const Eigen::Matrix3Xd& directions,
                      std::span<double> distance) const {
    const Eigen::Vector3f from = ((origin - scene_->centre) * scene_->scale).cast<float>();
    const int rays = static_cast<int>(directions.cols());
    for (int first = 0; first < rays; first += packet) {
        alignas(32) RTCRayHit8 batch{};
        alignas(32) PacketMask mask{};
        const int count = std::min(packet, rays - first);
        for (int i = 0; i < count; ++i) {
            mask[at(i)] = -1;
            set_ray(batch, i, from, directions.col(first + i).cast<float>());
        }
        EntryContext context{};
        rtcInitIntersectContext(&context.embree);
        context.entry.fill(std::numeric_limits<float>::infinity());
        rtcIntersect8(mask.data(), scene_->scene.get(), &context.embree, &batch);
        // Almost every ray leaves by the first face it meets; calling the filter for all of them takes as long as a
        // third of the traversal.
        if (leave_undecided(batch, mask)) {
            context.embree.filter = keep_exits;
            rtcIntersect8(mask.data(), scene_->scene.get(), &context.embree, &batch);
        }
        const std::span<double> found = distance.subspan(static_cast<std::size_t>(first));
        for (int i = 0; i < count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const float exit = batch.ray.tfar[i];
            const bool inside =
                has_hit(batch, static_cast<unsigned>(i)) && exit <= context.entry[k] + same_place;
            found[k] = inside ? static_cast<double>(exit) / scene_->scale : 0.0;
        }
    }
}

}  // namespace coseg
