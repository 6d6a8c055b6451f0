#include "src/families/implicit_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace coseg {

using Eigen::Vector3d;

void ImplicitShape::add(int label, double blend, PrimitivePointer primitive) {
    const Eigen::AlignedBox3d box = primitive->bounds();
    // How far the smooth minimum moves the surface out.
    const Vector3d margin = Vector3d::Constant(0.25 * blend);
    bounds_.extend(Eigen::AlignedBox3d(box.min() - margin, box.max() + margin));
    thickness_ = std::min(thickness_, primitive->thickness());
    if (blend > 0.0) smallest_blend_ = std::min(smallest_blend_, blend);
    parts_.push_back({std::move(primitive), label, blend, box.center(), 0.5 * box.diagonal().norm()});
}

double ImplicitShape::distance(const Vector3d& point) const {
    double value = std::numeric_limits<double>::infinity();
    for (const Part& part : parts_) {
        // Farther away, the part has no influence here. Twice the blend is taken because distances may come
        // out too short.
        const double reach = value + 2.0 * part.blend + part.radius;
        if (reach < 0.0 || (point - part.centre).squaredNorm() > reach * reach) continue;
        const double d = part.primitive->distance(point);
        const double overlap = part.blend > 0.0 ? std::max(0.0, 1.0 - std::abs(value - d) / part.blend) : 0.0;
        value = std::min(value, d) - 0.25 * part.blend * overlap * overlap;
    }
    return value;
}

int ImplicitShape::nearest_label(const Vector3d& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    int label = -1;
    for (const Part& part : parts_) {
        const double d = part.primitive->distance(point);
        if (d < nearest) {
            nearest = d;
            label = part.label;
        }
    }
    return label;
}

Vector3d ImplicitShape::gradient(const Vector3d& point, double step) const {
    Vector3d sum = Vector3d::Zero();  // four corners of a tetrahedron about the point
    for (const Vector3d& corner :
         {Vector3d(1, -1, -1), Vector3d(-1, -1, 1), Vector3d(-1, 1, -1), Vector3d(1, 1, 1)}) {
        sum += corner * distance(point + step * corner);
    }
    return sum / (4.0 * step);
}

Vector3d ImplicitShape::project(const Vector3d& point) const {
    const double size = bounds_.diagonal().norm();
    Vector3d p = point;
    for (int step = 0; step < 4; ++step) {
        const double value = distance(p);
        if (std::abs(value) < 1e-5 * size) break;
        const Vector3d slope = gradient(p, 1e-5 * size);
        p -= value * slope / std::max(0.25, slope.squaredNorm());
    }
    return p;
}

}  // namespace coseg
