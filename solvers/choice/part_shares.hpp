#pragma once
// The sizes of the parts of a partition, their numbers, and whether they are parts worth the name.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// The share of each mesh's area that lies in a part: parts x meshes, each column sums to 1. `labels` 0 ..
/// parts-1, `patch_area` and `mesh_of` are per patch, with meshes 0 .. M-1. Where a mesh has several
/// over-segmentations, each of its faces counts once in each.
Eigen::MatrixXd area_shares(const std::vector<int>& labels, int parts, const std::vector<double>& patch_area,
                            const std::vector<int>& mesh_of);

/// For each part the mean over meshes of its share of a mesh's area; the sum is 1. Arguments as above.
std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Whether a part is hardly one: it has less than half a percent of the area, by its mean share over the
/// meshes, or occurs in less than half of them.
bool is_degenerate_part(double mean_share, int meshes_with_part, int meshes);

/// The same of its shares of the meshes, as one row of area_shares.
bool is_degenerate_part(const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& share_of_mesh);

/// Whether a part of the partition is. `shares` as area_shares gives them.
bool is_degenerate(const Eigen::MatrixXd& shares);

/// The labels numbered 0, 1, ... without gaps, in the order in which they first occur. `labels` are >= 0.
std::vector<int> renumbered(const std::vector<int>& labels);

/// The same partition with parts numbered by decreasing mean area share, of equal ones by the lowest patch.
/// Labels without a patch come last.
std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

}  // namespace coseg
