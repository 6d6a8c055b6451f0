#include "solvers/alignment/common_frame.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "solvers/alignment/rotation_fit.hpp"
#include "src/base/decomposition.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double same_way = 15.0;   ///< degrees
constexpr double end_share = 0.25;  ///< of the length along an axis: what stands on the ground
constexpr double good_footprint = 0.5;

/// Of the shapes that `pose` and others leave alike; empty where these are too few.
std::vector<const ShapePose*> largest_agreeing_group(const std::vector<ShapePose>& poses) {
    std::vector<const ShapePose*> proper;
    for (const ShapePose& pose : poses) {
        if (pose.found && !pose.reflected) proper.push_back(&pose);
    }
    std::vector<const ShapePose*> best;
    for (const ShapePose* one : proper) {
        std::vector<const ShapePose*> group;
        for (const ShapePose* other : proper) {
            if (angle_between(one->rotation, other->rotation) < same_way) group.push_back(other);
        }
        if (group.size() > best.size()) best = std::move(group);
    }
    return best.size() >= 2 && 4 * best.size() >= poses.size() ? best : std::vector<const ShapePose*>{};
}

/// What a shape is like along an axis.
struct AlongAxis {
    /// Of the lower and the upper end: the bounding rectangle of the end, as a share of that of the shape.
    std::array<double, 2> footprint{};
    std::array<double, 2> area{};    ///< of the two ends, shares of the shape's
    double mirror_difference = 0.0;  ///< see mirror_differences, by patches
};

double end_rectangle(const Eigen::Matrix3Xd& shape, const std::vector<Eigen::Index>& end, Eigen::Index axis) {
    Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
    Eigen::Vector3d most = -least;
    for (const Eigen::Index p : end) {
        least = least.cwiseMin(shape.col(p));
        most = most.cwiseMax(shape.col(p));
    }
    const Eigen::Vector3d extent = most - least;
    return extent[(axis + 1) % 3] * extent[(axis + 2) % 3];
}

AlongAxis along_axis(const Eigen::Matrix3Xd& shape, const Eigen::VectorXd& area, Eigen::Index axis) {
    constexpr int places = 8;
    const double low = shape.row(axis).minCoeff();
    const double extent = shape.row(axis).maxCoeff() - low;
    AlongAxis found;
    if (!(extent > 0.0)) return found;
    std::array<std::vector<Eigen::Index>, 2> ends;
    Eigen::Vector<double, places> areas = Eigen::Vector<double, places>::Zero();
    for (Eigen::Index p = 0; p < shape.cols(); ++p) {
        const double height = (shape(axis, p) - low) / extent;
        if (height < end_share) ends[0].push_back(p);
        if (height > 1.0 - end_share) ends[1].push_back(p);
        areas[std::clamp(static_cast<int>(places * height), 0, places - 1)] += area[p];
    }
    std::vector<Eigen::Index> all(at(static_cast<int>(shape.cols())));
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    const double whole = end_rectangle(shape, all, axis);
    for (std::size_t e = 0; e < 2; ++e) {
        found.footprint[e] = whole > 0.0 ? end_rectangle(shape, ends[e], axis) / whole : 0.0;
        for (const Eigen::Index p : ends[e]) found.area[e] += area[p] / area.sum();
    }
    found.mirror_difference = (areas - areas.reverse()).cwiseAbs().sum() / (2.0 * area.sum());
    return found;
}

/// The mean over the meshes.
AlongAxis mean_along(const Eigen::Matrix3Xd& placed, const PlacedPatches& patches, Eigen::Index axis) {
    AlongAxis mean;
    const double share = 1.0 / (patches.mesh_of.back() + 1.0);
    for (Eigen::Index begin = 0, end = 0; begin < placed.cols(); begin = end) {
        while (end < placed.cols() && patches.mesh_of[at(end)] == patches.mesh_of[at(begin)]) ++end;
        const Eigen::Map<const Eigen::VectorXd> areas(patches.patch_area.data() + begin, end - begin);
        const AlongAxis one = along_axis(placed.middleCols(begin, end - begin), areas, axis);
        for (std::size_t e = 0; e < 2; ++e) {
            mean.footprint[e] += share * one.footprint[e];
            mean.area[e] += share * one.area[e];
        }
        mean.mirror_difference += share * one.mirror_difference;
    }
    return mean;
}

/// 0 if shapes stand on the lower end, 1 if they stand on the upper one.
std::size_t ground_of(const AlongAxis& along) {
    if (std::min(along.footprint[0], along.footprint[1]) >= good_footprint)
        return along.area[0] <= along.area[1] ? 0 : 1;
    return along.footprint[0] >= along.footprint[1] ? 0 : 1;
}

Eigen::Matrix3d standing_frame(const Eigen::Matrix3Xd& placed, const PlacedPatches& patches) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (Eigen::Index p = 0; p < placed.cols(); ++p)
        spread += patches.patch_area[at(p)] * placed.col(p) * placed.col(p).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);  // ascending
    const Eigen::Matrix3d& axes = succeeded(solver, "the spread of the patches").eigenvectors();
    const Eigen::Matrix3Xd turned = axes.transpose() * placed;
    Eigen::Index up = 0;
    double best = -1.0;
    double sign = 1.0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const AlongAxis along = mean_along(turned, patches, axis);
        const std::size_t ground = ground_of(along);
        const double likely = along.mirror_difference * along.footprint[ground];
        if (likely <= best) continue;
        best = likely;
        up = axis;
        sign = ground == 0 ? 1.0 : -1.0;
    }
    Eigen::Matrix3d frame;
    frame.row(0) = axes.col(up == 2 ? 1 : 2).transpose();
    frame.row(1) = sign * axes.col(up).transpose();
    frame.row(2) = frame.row(0).cross(frame.row(1));
    return frame;
}

}  // namespace

Eigen::Matrix3d common_frame(const std::vector<ShapePose>& poses, const PlacedPatches& patches) {
    const std::vector<const ShapePose*> group = largest_agreeing_group(poses);
    if (!group.empty()) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const ShapePose* pose : group) sum += pose->rotation.transpose();
        return nearest_rotation(sum);
    }
    Eigen::Matrix3Xd placed = patches.positions;
    for (Eigen::Index p = 0; p < placed.cols(); ++p)
        placed.col(p) = poses[at(patches.mesh_of[at(p)])].rotation * patches.positions.col(p);
    return standing_frame(placed, patches);
}

}  // namespace coseg
