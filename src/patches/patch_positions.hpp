#pragma once
// Where the patches of a mesh lie in it.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/face_geometry.hpp"

namespace coseg {

/// 3 x count, column major: the centroid of each patch by area, in the axes of the mesh, with the mesh's own centroid as origin and
/// the root mean square of a coordinate over its area (of face centroids) as unit. 0 for a patch without area, and where
/// all faces lie at one point. patch_of_face: 0 .. count - 1.
Eigen::Matrix3Xd patch_positions(const FaceGeometry& geometry, const std::vector<int>& patch_of_face,
                                 int count);

}  // namespace coseg
