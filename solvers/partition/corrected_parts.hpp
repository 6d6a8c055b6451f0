#pragma once
// Follows what is said of some patches: from a partition and scores of the parts to the parts of all patches.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solvers/partition/cut_input.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/part_regression.hpp"
#include "solvers/partition/prepared_cut.hpp"

namespace coseg {

struct CorrectedPartition {
    std::vector<int> parts;          ///< of all patches; each is allowed in its mesh
    std::vector<double> confidence;  ///< of all patches, see part_confidence
};

/// The parts of all patches: expansions from the base, or from the best scores if this comes to a higher
/// objective, with the scores as gains. Patches of which at least half is said keep the part that is said,
/// and no patch gets a part that its mesh may not have. scores: K x N, see PartRegression. The same bytes on
/// any number of ranks. Collective; throws AgreedError(internal) where a mesh may have no part.
CorrectedPartition corrected_partition(const Comm& comm, const PartitionObjective& objective,
                                       const SaidParts& said, const Eigen::MatrixXd& scores,
                                       const ExampleWeights& weights);

/// Everything that does not change from one correction to the next, so that these take little time.
class CorrectedParts {
  public:
    /// As partition_patches; input.features is needed, and nothing of `input` is referred to afterwards.
    /// confidence: of the part that each patch has at first, N, or nothing. Collective; throws
    /// AgreedError(internal).
    CorrectedParts(const Comm& comm, const CutInput& input, const CutOptions& options,
                   const std::vector<double>& confidence);
    CorrectedParts(const CorrectedParts&) = delete;
    CorrectedParts& operator=(const CorrectedParts&) = delete;
    ~CorrectedParts() = default;

    /// See PartRegression::scores.
    [[nodiscard]] Eigen::MatrixXd scores(const SaidParts& said) const { return regression_->scores(said); }

    /// See corrected_partition. Collective.
    [[nodiscard]] CorrectedPartition corrected(const Comm& comm, const SaidParts& said,
                                               const Eigen::MatrixXd& scores) const {
        return corrected_partition(comm, objective_, said, scores, weights_);
    }

    /// What the expansions climb.
    [[nodiscard]] const PartitionObjective& objective() const noexcept { return objective_; }

  private:
    PreparedCut cut_;  ///< what the objective looks at; without relations, which nothing looks at any more
    std::optional<PartRegression> regression_;
    PartitionObjective objective_;
    ExampleWeights weights_;
};

}  // namespace coseg
