#include "src/families/distance_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace coseg {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A segment of a chain with what its distance needs prepared: the tangent cone of two spheres touches them
/// where the normal leans by `lean` = (r0 - r1) / length along the axis.
struct ConeSegment {
    Vector3d start;
    Vector3d axis;
    double length;
    double radius;
    double lean;
    double lean_over_cosine;
};

ConeSegment cone_segment(const ChainSphere& a, const ChainSphere& b) {
    ConeSegment s{a.head<3>(), Vector3d::Zero(), (b - a).head<3>().norm(), a[3], 0.0, 0.0};
    if (s.length <= std::abs(a[3] - b[3])) {  // one sphere holds the other: the larger alone
        if (b[3] > a[3]) s = {b.head<3>(), Vector3d::Zero(), 0.0, b[3], 0.0, 0.0};
        s.length = 0.0;
        return s;
    }
    s.axis = (b - a).head<3>() / s.length;
    s.lean = (a[3] - b[3]) / s.length;
    s.lean_over_cosine = s.lean / std::sqrt(1.0 - s.lean * s.lean);
    return s;
}

class RoundChain final : public DistancePrimitive {
  public:
    RoundChain(const std::vector<ChainSphere>& spheres, const Vector3d& thin, double factor)
        : thin_(thin), factor_(factor), origin_(spheres.front().head<3>()) {
        std::vector<ChainSphere> scaled = spheres;
        for (ChainSphere& s : scaled) s.head<3>() = stretched(s.head<3>());
        if (scaled.size() == 1) segments_.push_back(cone_segment(scaled[0], scaled[0]));
        for (std::size_t i = 0; i + 1 < scaled.size(); ++i)
            segments_.push_back(cone_segment(scaled[i], scaled[i + 1]));
        thickness_ = infinity;
        for (const ChainSphere& s : spheres) {
            thickness_ = std::min(thickness_, 2.0 * s[3] / factor);
            bounds_.extend(
                AlignedBox3d(s.head<3>() - Vector3d::Constant(s[3]), s.head<3>() + Vector3d::Constant(s[3])));
        }
    }

    [[nodiscard]] double distance(const Vector3d& point) const override {
        const Vector3d p = stretched(point);
        double nearest = infinity;
        Vector3d direction = Vector3d::Zero();
        for (const ConeSegment& s : segments_) {
            const Vector3d q = p - s.start;
            const double along = q.dot(s.axis);
            const double across = std::sqrt(std::max(0.0, q.squaredNorm() - along * along));
            const double foot = std::clamp(along - across * s.lean_over_cosine, 0.0, s.length);
            const Vector3d arm = q - foot * s.axis;
            const double reach = arm.norm();
            const double d = reach - (s.radius - s.lean * foot);
            if (d < nearest) {
                nearest = d;
                direction = reach > 0.0 ? Vector3d(arm / reach) : Vector3d::Zero();
            }
        }
        if (factor_ == 1.0) return nearest;
        if (nearest <= 0.0) return nearest / factor_;
        // Distances of the stretched space are too long by the gradient of the stretched distance.
        return nearest / (direction + (factor_ - 1.0) * direction.dot(thin_) * thin_).norm();
    }

    [[nodiscard]] AlignedBox3d bounds() const override { return bounds_; }
    [[nodiscard]] double thickness() const override { return thickness_; }

  private:
    [[nodiscard]] Vector3d stretched(const Vector3d& p) const {
        return p + (factor_ - 1.0) * (p - origin_).dot(thin_) * thin_;
    }

    Vector3d thin_;
    double factor_;
    Vector3d origin_;
    std::vector<ConeSegment> segments_;
    AlignedBox3d bounds_;
    double thickness_;
};

AlignedBox3d posed_box(const Isometry3d& pose, const Vector3d& low, const Vector3d& high) {
    AlignedBox3d box;
    for (int corner = 0; corner < 8; ++corner) {
        box.extend(pose * Vector3d((corner & 1) != 0 ? high[0] : low[0], (corner & 2) != 0 ? high[1] : low[1],
                                   (corner & 4) != 0 ? high[2] : low[2]));
    }
    return box;
}

class Ellipsoid final : public DistancePrimitive {
  public:
    Ellipsoid(const Isometry3d& pose, const Vector3d& radii)
        : to_local_(pose.inverse()), radii_(radii), bounds_(posed_box(pose, -radii, radii)) {}

    [[nodiscard]] double distance(const Vector3d& point) const override {
        const Vector3d scaled = (to_local_ * point).cwiseQuotient(radii_);
        const double level = scaled.norm();
        if (level <= 1.0) return (level - 1.0) * radii_.minCoeff();
        return level * (level - 1.0) / scaled.cwiseQuotient(radii_).norm();
    }

    [[nodiscard]] AlignedBox3d bounds() const override { return bounds_; }
    [[nodiscard]] double thickness() const override { return 2.0 * radii_.minCoeff(); }

  private:
    Isometry3d to_local_;
    Vector3d radii_;
    AlignedBox3d bounds_;
};

double squared_distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
    const Vector2d edge = b - a;
    const double length2 = edge.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
    return (p - a - t * edge).squaredNorm();
}

double distance_to_polyline(const Vector2d& p, const std::vector<Vector2d>& line) {
    double best = line.size() == 1 ? (p - line[0]).squaredNorm() : infinity;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        best = std::min(best, squared_distance_to_segment(p, line[i], line[i + 1]));
    return std::sqrt(best);
}

/// Even-odd rule along a ray in +x; the polygon is closed from its last to its first point.
bool is_inside_polygon(const Vector2d& p, const std::vector<Vector2d>& polygon) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vector2d& a = polygon[i];
        const Vector2d& b = polygon[j];
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
    }
    return inside;
}

AlignedBox3d revolved_box(const Isometry3d& pose, const std::vector<Vector2d>& profile, double grown) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : profile) box.extend(p);
    const double r = box.max()[0] + grown;
    return posed_box(pose, {-r, -r, box.min()[1] - grown}, {r, r, box.max()[1] + grown});
}

class Revolved final : public DistancePrimitive {
  public:
    Revolved(const Isometry3d& pose, std::vector<Vector2d> profile, double grown, bool solid)
        : to_local_(pose.inverse()), profile_(std::move(profile)), grown_(grown), solid_(solid) {
        bounds_ = revolved_box(pose, profile_, grown);
        Eigen::AlignedBox2d box;
        for (const Vector2d& p : profile_) box.extend(p);
        thickness_ = 2.0 * grown + (solid ? std::min(2.0 * box.max()[0], box.sizes()[1]) : 0.0);
    }

    [[nodiscard]] double distance(const Vector3d& point) const override {
        const Vector3d local = to_local_ * point;
        const Vector2d p(local.head<2>().norm(), local[2]);
        const double d = distance_to_polyline(p, profile_);
        return (solid_ && is_inside_polygon(p, profile_) ? -d : d) - grown_;
    }

    [[nodiscard]] AlignedBox3d bounds() const override { return bounds_; }
    [[nodiscard]] double thickness() const override { return thickness_; }

  private:
    Isometry3d to_local_;
    std::vector<Vector2d> profile_;
    double grown_;
    bool solid_;
    AlignedBox3d bounds_;
    double thickness_;
};

class ExtrudedPolygon final : public DistancePrimitive {
  public:
    ExtrudedPolygon(const Isometry3d& pose, std::vector<Vector2d> outline, double half_thickness,
                    double rounding)
        : to_local_(pose.inverse()),
          outline_(std::move(outline)),
          half_thickness_(half_thickness),
          rounding_(rounding) {
        Eigen::AlignedBox2d box;
        for (const Vector2d& p : outline_) box.extend(p);
        bounds_ = posed_box(pose, {box.min()[0], box.min()[1], -half_thickness},
                            {box.max()[0], box.max()[1], half_thickness});
        outline_.push_back(outline_.front());
    }

    [[nodiscard]] double distance(const Vector3d& point) const override {
        const Vector3d local = to_local_ * point;
        const Vector2d p = local.head<2>();
        const double outline =
            distance_to_polyline(p, outline_) * (is_inside_polygon(p, outline_) ? -1.0 : 1.0);
        const Vector2d w(outline + rounding_, std::abs(local[2]) - half_thickness_ + rounding_);
        return std::min(w.maxCoeff(), 0.0) + w.cwiseMax(0.0).norm() - rounding_;
    }

    [[nodiscard]] AlignedBox3d bounds() const override { return bounds_; }
    [[nodiscard]] double thickness() const override { return 2.0 * half_thickness_; }

  private:
    Isometry3d to_local_;
    std::vector<Vector2d> outline_;
    double half_thickness_;
    double rounding_;
    AlignedBox3d bounds_;
};

}  // namespace

PrimitivePointer round_chain(const std::vector<ChainSphere>& spheres) {
    return std::make_unique<RoundChain>(spheres, Vector3d::UnitZ(), 1.0);
}

PrimitivePointer flat_chain(const std::vector<ChainSphere>& spheres, const Vector3d& thin, double factor) {
    return std::make_unique<RoundChain>(spheres, thin.normalized(), factor);
}

PrimitivePointer ellipsoid(const Isometry3d& pose, const Vector3d& radii) {
    return std::make_unique<Ellipsoid>(pose, radii);
}

PrimitivePointer revolved_solid(const Isometry3d& pose, std::vector<Vector2d> profile, double rounding) {
    return std::make_unique<Revolved>(pose, std::move(profile), rounding, true);
}

PrimitivePointer revolved_wall(const Isometry3d& pose, std::vector<Vector2d> profile, double half_thickness) {
    return std::make_unique<Revolved>(pose, std::move(profile), half_thickness, false);
}

PrimitivePointer extruded_polygon(const Isometry3d& pose, std::vector<Vector2d> outline,
                                  double half_thickness, double rounding) {
    return std::make_unique<ExtrudedPolygon>(pose, std::move(outline), half_thickness, rounding);
}

}  // namespace coseg
