#include "src/descriptors/inside_rays.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>

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

/// Leaves in `mask` the rays whose nearest face is no exit, ready to be cast again as far as one may count;
/// false if there are none.
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

Eigen::Vector3d centre_of(const TriMesh& mesh) {
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d high = mesh.vertices.rowwise().maxCoeff();
    return 0.5 * (low + high);
}

double scale_to_unit_extent(const TriMesh& mesh) {
    const double extent =
        (mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff()).maxCoeff();
    return extent > 0.0 ? 1.0 / extent : 1.0;
}

}  // namespace

InsideRays::InsideRays(const TriMesh& mesh, const Eigen::Vector3d& centre, double scale)
    : centre_(centre),
      scale_(scale),
      scene_(((mesh.vertices.colwise() - centre) * scale).cast<float>(), mesh.faces,
             RayScene::Filter::per_ray) {}

InsideRays::InsideRays(const TriMesh& mesh) : InsideRays(mesh, centre_of(mesh), scale_to_unit_extent(mesh)) {}

void InsideRays::cast(const Eigen::Vector3d& origin, const Eigen::Matrix3Xd& directions,
                      std::span<double> distance) const {
    const Eigen::Vector3f from = ((origin - centre_) * scale_).cast<float>();
    const int rays = static_cast<int>(directions.cols());
    for (int first = 0; first < rays; first += packet) {
        alignas(32) RTCRayHit8 batch{};
        alignas(32) PacketMask mask{};
        const int count = std::min(packet, rays - first);
        for (int i = 0; i < count; ++i) {
            mask[at(i)] = -1;
            set_ray(batch.ray, i, from, directions.col(first + i).cast<float>(), nearest,
                    std::numeric_limits<float>::infinity());
            batch.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        EntryContext context{};
        rtcInitIntersectContext(&context.embree);
        context.entry.fill(std::numeric_limits<float>::infinity());
        rtcIntersect8(mask.data(), scene_.get(), &context.embree, &batch);
        // Almost every ray leaves by the first face it meets; calling the filter for all of them takes as
        // long as a third of the traversal.
        if (leave_undecided(batch, mask)) {
            context.embree.filter = keep_exits;
            rtcIntersect8(mask.data(), scene_.get(), &context.embree, &batch);
        }
        const std::span<double> found = distance.subspan(at(first));
        for (int i = 0; i < count; ++i) {
            const auto k = at(i);
            const float exit = batch.ray.tfar[i];
            const bool inside =
                has_hit(batch, static_cast<unsigned>(i)) && exit <= context.entry[k] + same_place;
            found[k] = inside ? static_cast<double>(exit) / scale_ : 0.0;
        }
    }
}

}  // namespace coseg
