#include "src/pictures/picture_rays.hpp"

#include <embree3/rtcore.h>

#include <limits>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr std::array<int, PictureRays::packet> all_valid = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                            -1, -1, -1, -1, -1, -1, -1, -1};

}  // namespace

PictureRays::PictureRays(const TriMesh& mesh)
    : scene_(mesh.vertices.cast<float>(), mesh.faces, RayScene::Filter::none) {}

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
    rtcIntersect16(valid.data(), scene_.get(), &context, &batch);
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
    rtcOccluded16(valid.data(), scene_.get(), &context, &batch);
    int count = 0;
    for (const float far : batch.tfar) count += far < 0.0F ? 1 : 0;
    return count;
}

}  // namespace coseg
