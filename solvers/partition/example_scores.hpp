#pragma once
// Predicts from patches whose label is known how well each label suits all the others.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/records/position_frame.hpp"

namespace coseg {

/// What is known of the labels of patches, the same on all ranks.
struct ExampleLabels {
    /// K x N: the area of each patch that is said to have the label; columns of zeros where nothing is said.
    /// K is the number of parts. A row of zeros is a label without an example: a free part.
    Eigen::MatrixXd area;
    [[nodiscard]] bool empty() const noexcept { return area.size() == 0; }
};

/// The label of each patch of which at least half of the area is said: the one with the largest area, of
/// equal ones the lowest. -1 for the others.
std::vector<int> known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area);

/// Gives the patches of known_labels the score 1 for their label and 0 for the others. scores: K x N.
void hold_known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area,
                       Eigen::MatrixXd& scores);

/// What the prediction looks at, the same on all ranks.
struct ScoreInput {
    const FeatureMatrices& features;                     ///< D x N
    const std::vector<GlobalPatchNeighbors>& neighbors;  ///< of all patches
    const Eigen::Matrix3Xd* positions = nullptr;         ///< 3 x N; null: places do not count
    const PositionFrame& frame;                          ///< of these positions
    const std::vector<double>& patch_area;               ///< N
};

/// K x N: about 1 where the patch has the label and 0 elsewhere; the scores of a patch sum to 1 but for free
/// labels. A patch with a known label has 1 for it and 0 for the others. Labels without an example have 1 / K
/// everywhere else: nothing is said of them.
///
/// It is a ridge regression of the labels, weighted by the area that is said, on the features of the patch,
/// on the mean of the features of its neighbours (weighted by the length of the common boundary), and on its
/// place: its coordinates in the frame times their correlations, so that places count as far as shapes stand
/// alike. The ridge is 1 where the weights of the examples sum to their number. Serial; a function of the
/// arguments alone. Throws Error(input) where no patch has a label.
///
/// Source: Hoerl and Kennard 1970 (ridge regression).
Eigen::MatrixXd example_scores(const ScoreInput& input, const ExampleLabels& examples);

}  // namespace coseg
