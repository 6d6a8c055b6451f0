#pragma once
// Asks of each patch how well each part suits it, by what the patches of other meshes in that part look like.

#include <Eigen/Core>
#include <vector>

#include "src/histograms/single_precision_features.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/position_frame.hpp"

namespace coseg {

/// What patches look like and where they are, the same on all ranks.
struct PatchLooks {
    const SinglePrecisionFeatures& features;      ///< D x N in all
    const Eigen::Matrix3Xd* positions = nullptr;  ///< 3 x N; null: places do not count
    const PositionFrame& frame;                   ///< of these positions
    const std::vector<double>& area;              ///< of each patch
    const std::vector<int>& mesh_of;              ///< of each patch, 0 .. M-1, ascending
};

/// K x N: about 1 where the patch looks like the patches of the part in other meshes, and about 0 where it
/// does not; a patch's scores sum to about 1. part_of_patch: 0 .. K-1. Empty (0 x 0) with fewer than two
/// meshes.
///
/// It is a ridge regression of the parts, each patch weighted by its area, on features and places. The meshes
/// are dealt into at most 10 groups in turn, and the patches of a group are scored by the regression over the
/// other groups: a part that only one mesh has there is not confirmed by this mesh itself. The ridge is 30
/// where the weights of all patches sum to their number. Above 100,000 patches every second, third, .. mesh
/// of a group is learnt from.
///
/// The groups are shared out among the ranks; the result has the same bytes on any number of them. A rank
/// holds (D + 4)^2 values in single precision for each group. Collective.
///
/// Source: Hoerl and Kennard 1970 (ridge regression); Stone 1974 (cross-validation).
Eigen::MatrixXf part_scores(const Comm& comm, const PatchLooks& looks, const std::vector<int>& part_of_patch,
                            int parts);

}  // namespace coseg
