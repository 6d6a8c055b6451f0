#pragma once
// Chooses the axes of the frame in which aligned shapes stand.

#include <Eigen/Core>
#include <vector>

#include "src/records/shape_alignment.hpp"

namespace coseg {

struct PlacedPatches {
    const Eigen::Matrix3Xd& positions;  ///< of all patches, as patch_positions gives them
    const std::vector<int>& mesh_of;
    const std::vector<double>& patch_area;
};

/// The rotation of the frame that leaves as many shapes as possible as they stand in their files: where for a
/// quarter of the shapes, and at least two, one rotation does so to 15 degrees, it is their mean. Elsewhere
/// it makes the shapes stand: of the principal axes, y becomes the one with the largest product of footprint
/// (how far one end reaches, compared with the whole) and difference of above and below. The shapes stand on
/// the end of the larger footprint, and where both are large, on that of less area. x is the longer of the
/// others. Poses have no scale or translation yet. The same on all ranks; does not communicate.
Eigen::Matrix3d common_frame(const std::vector<ShapePose>& poses, const PlacedPatches& patches);

}  // namespace coseg
