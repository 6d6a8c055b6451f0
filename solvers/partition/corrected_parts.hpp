#pragma once
// Follows a person's corrections: from a partition and what is said of some patches to the parts of all.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solvers/partition/cut_graphs.hpp"
#include "solvers/partition/part_expansion.hpp"
#include "solvers/partition/patch_partition.hpp"

namespace coseg {

/// What is known of the parts of patches, the same on all ranks.
struct SaidParts {
    std::vector<int> base;  ///< N: the part of each patch before anything is said, 0 .. K-1
    /// K x N: the area of each patch that is said to have the part; columns of zeros where nothing is said.
    Eigen::MatrixXd area;
    /// K x M: 1 where the mesh may have the part, else 0. Each mesh may have a part.
    Eigen::MatrixXi allowed;
};

struct CorrectedPartition {
    std::vector<int> parts;          ///< of all patches; each is allowed in its mesh
    std::vector<double> confidence;  ///< of all patches, see part_confidence
};

/// Everything that does not change from one correction to the next, so that these take little time.
class CorrectedParts {
  public:
    /// As partition_patches; input.features is needed, and nothing of `input` is referred to afterwards.
    /// confidence: of the part that each patch has at first, N, or nothing. Collective; throws
    /// AgreedError(internal).
    CorrectedParts(const Comm& comm, const CutInput& input, const CutOptions& options,
                   std::vector<double> confidence);
    CorrectedParts(const CorrectedParts&) = delete;
    CorrectedParts& operator=(const CorrectedParts&) = delete;
    ~CorrectedParts() = default;

    /// K x N: about 1 where a patch has the part and 0 elsewhere, from what is said and, with the weight of
    /// a tenth of a shape, from the base. A ridge regression as example_scores makes one, on the leading
    /// principal components of the features instead of these. A patch of which at least half is said has 1
    /// for its part. Parts that no patch has, and of which nothing is said, have 0. Serial; a function of the
    /// arguments alone.
    [[nodiscard]] Eigen::MatrixXd scores(const SaidParts& said) const;

    /// The parts of all patches: expansions from the base, or from the best scores if this comes to a higher
    /// objective, with these scores as gains. Patches of which at least half is said keep the part that is
    /// said, and no patch gets a part that its mesh may not have. The same bytes on any number of ranks.
    /// Collective.
    [[nodiscard]] CorrectedPartition corrected(const Comm& comm, const SaidParts& said,
                                               const Eigen::MatrixXd& scores) const;

    /// What the expansions climb.
    [[nodiscard]] const PartitionObjective& objective() const noexcept { return objective_; }

  private:
    void reduce_features(const FeatureMatrices& features);
    void add_neighborhoods(const std::vector<GlobalPatchNeighbors>& pairs);
    void sum_base();

    std::vector<double> patch_area_;
    std::vector<int> mesh_of_;
    std::vector<double> weight_;  ///< of each patch as an example of the base: area times confidence
    GraphTerms terms_;
    Eigen::MatrixXf x_;             ///< d x N: reduced features, those of the neighbourhood, places
    Eigen::MatrixXd base_squares_;  ///< d x d: sum over the patches of weight x x^T
    PartitionObjective objective_;
    ExampleWeights weights_;
};

}  // namespace coseg
