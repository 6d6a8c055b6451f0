#pragma once
// alignment.json: how the shapes of a run are turned so that all stand alike.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace coseg {

/// x -> scale * rotation * x + translation takes the coordinates of the shape's file to the common frame, in
/// which shapes have their centre near the origin and the root mean square of a coordinate is about 1.
struct AlignedShape {
    std::string name;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    double scale = 1.0;
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    double agreement = 0.0;  ///< the last four as ShapePose has them
    double residual = 0.0;
    bool reflected = false;
    bool found = false;
};

struct AlignmentFile {
    bool aligned = false;  ///< if not, all rotations are the identity: the shapes stand as in their files
    std::string reason;
    double standing_share = 0.0;
    double agreement_before = 0.0;
    double agreement_after = 0.0;
    std::vector<AlignedShape> shapes;  ///< in the order of the run
};

std::string alignment_text(const AlignmentFile& alignment);

/// Throws Error(input) for a file that is not what alignment_text gives.
AlignmentFile read_alignment(const std::string& path);

}  // namespace coseg
