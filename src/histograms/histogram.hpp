#pragma once
// Makes histograms of a feature over the faces of each patch: the columns of X_h.

#include <Eigen/Core>
#include <vector>

#include "src/base/enum_names.hpp"
#include "src/histograms/feature_range.hpp"

namespace coseg {

/// Bin 0 .. bins-1 of every face. Throws Error(input) naming the face if a value is not finite.
std::vector<int> bin_of_face(const Eigen::VectorXd& values, const FeatureRange& range);

enum class HistogramScaling {
    counts,    ///< sums of weights as they are
    unit_sum,  ///< columns sum to 1
    /// Square root of unit_sum: columns of 2-norm 1, x_i . x_j is the Bhattacharyya coefficient.
    square_root,
};
constexpr std::array<EnumName<HistogramScaling>, 3> enum_names(HistogramScaling /*type*/) {
    return {{{HistogramScaling::counts, "counts"},
             {HistogramScaling::unit_sum, "unit-sum"},
             {HistogramScaling::square_root, "square-root"}}};
}

/// The matrix of histograms: bins x patches, column major, entries >= 0. Column p is the weight of patch p's
/// faces in each bin, scaled. Every patch with a face has a nonzero column: where all its weights are 0, its
/// faces count equally. A patch without faces has a zero column.
///
/// weights: face areas make the columns independent of the triangulation; ones give the paper's counts of
/// faces.
///
/// Throws Error(internal) if sizes differ or a bin or patch is out of range.
///
/// Source: Hu, Fan, Liu 2012, which counts faces and leaves the scaling open.
///
/// Deviates: areas, and the square root.
Eigen::MatrixXd patch_histograms(const std::vector<int>& bin_of_face, const std::vector<int>& patch_of_face,
                                 int patches, int bins, const Eigen::VectorXd& weights,
                                 HistogramScaling scaling = HistogramScaling::square_root);

}  // namespace coseg
