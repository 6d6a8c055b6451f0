#pragma once
// Sums up over the patches of a mesh what is known of the labels of its faces.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// labels x count: the area of each patch on faces of each label. patch_of_face: 0 .. count-1, label_of_face:
/// 0 .. labels-1, or -1 for a face of which nothing is known, and area: one value a face.
Eigen::MatrixXd patch_label_areas(const std::vector<int>& patch_of_face, int count,
                                  const std::vector<int>& label_of_face, int labels,
                                  const Eigen::VectorXd& area);

}  // namespace coseg
