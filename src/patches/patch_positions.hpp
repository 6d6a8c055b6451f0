#pragma once
// Computes where the patches of a mesh lie in it.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/face_geometry.hpp"

namespace coseg {

/// 3 x count, column major: the area-weighted centroid of each patch in the axes of the mesh. The mesh's own
/// centroid is the origin. The unit is the root mean square of a coordinate over the mesh's area (of face
/// centroids). A patch without area is at 0, and so are all patches where all faces lie at one point.
/// patch_of_face: 0 .. count-1.
Eigen::Matrix3Xd patch_positions(const FaceGeometry& geometry, const std::vector<int>& patch_of_face,
                                 int count);

}  // namespace coseg
