#pragma once
// Predicts from patches whose part is said, and from a partition that is there, how well each part suits all
// patches.

#include <Eigen/Core>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/partition/part_scores.hpp"

namespace coseg {

/// What is known of the parts of patches, the same on all ranks.
struct SaidParts {
    /// N: the part of each patch before anything is said, 0 .. K-1; or nothing, where no partition is there.
    std::vector<int> base;
    /// K x N: the area of each patch that is said to have the part; columns of zeros where nothing is said.
    Eigen::MatrixXd area;
    /// K x M: 1 where the mesh may have the part, else 0. Each mesh may have a part. Not looked at by the
    /// regression.
    Eigen::MatrixXi allowed;
};

/// What a regression looks at of a patch, d numbers: the leading principal components of its features, the
/// mean of those of its neighbours, weighted by the length of the common boundary, and its place, its
/// coordinates in the frame times their correlations, so that places count as far as shapes stand alike.
class PatchReduction {
  public:
    /// The components are those of `looks`, patches weighted by area, at most 96. Serial.
    explicit PatchReduction(const PatchLooks& looks);

    /// d x n, of n patches with these features, D x n, and positions, 3 x n or null, and `pairs`, 0 .. n-1,
    /// of neighbours. Serial.
    [[nodiscard]] Eigen::MatrixXf operator()(const SinglePrecisionFeatures::ConstBlock& features,
                                             const Eigen::Matrix3Xd* positions,
                                             const std::vector<GlobalPatchNeighbors>& pairs) const;

  private:
    Eigen::VectorXd mean_;  ///< D
    Eigen::MatrixXd axes_;  ///< D x components
    PositionFrame frame_;
};

/// score = slope x + constant.
struct LinearScore {
    Eigen::MatrixXd slope;  ///< K x d
    Eigen::VectorXd constant;
    /// K x n, of reduced patches, d x n.
    [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXf& x) const;
};

/// Everything that does not change with what is said, so that a prediction takes little time.
///
/// It is a ridge regression of the parts on what a patch looks like, see PatchReduction. What is said counts
/// by its area, and the base, all of its patches together, as much as a tenth of a shape. The ridge is 1
/// where the weights sum to the number of patches that they are of.
///
/// Source: Hoerl and Kennard 1970 (ridge regression).
class PartRegression {
  public:
    /// Nothing of the arguments is referred to afterwards. confidence: in the part that each patch of the
    /// base has, N; or nothing, for 1. A rank holds 195 values in single precision for each patch. Serial.
    PartRegression(const PatchLooks& looks, const std::vector<GlobalPatchNeighbors>& neighbors,
                   const std::vector<double>& confidence);

    /// K x N: about 1 where a patch has the part and about 0 elsewhere. A patch of which at least half is
    /// said has 1 for its part and 0 for the others. Of a part of which nothing is said nothing is predicted:
    /// it has 1 / K everywhere where there is no base, and 0 where the base has no patch of it. Neither is
    /// anything of one part alone, without a base: all patches would seem to have it. Serial; a function of
    /// the arguments alone. Throws Error(input) where nothing is known of any patch.
    [[nodiscard]] Eigen::MatrixXd scores(const SaidParts& said) const;

    /// How other patches are scored, which nothing is said of. Throws as scores().
    [[nodiscard]] LinearScore learnt(const SaidParts& said) const;
    [[nodiscard]] const PatchReduction& reduction() const noexcept { return reduction_; }

  private:
    void sum_base();

    PatchReduction reduction_;
    std::vector<double> patch_area_;
    int meshes_ = 0;
    std::vector<double> weight_;    ///< of each patch as an example of the base: area times confidence
    Eigen::MatrixXf x_;             ///< d x N: the reduced patches
    Eigen::MatrixXd base_squares_;  ///< d x d: sum over the patches of weight x x^T
};

}  // namespace coseg
