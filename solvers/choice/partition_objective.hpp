#pragma once
// The part of the score that is a sum over the parts, prepared so that a search can try many partitions.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solvers/choice/partition_terms.hpp"
#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What two patches add to the objective where they are in the same part.
struct PatchTie {
    int other = 0;
    double gain = 0.0;  ///< >= 0
};

/// D x N numbers in single precision, column major: of one rank, or held once by the ranks of a node
/// together. Copies are handles of the same values.
class PatchDeviations {
  public:
    PatchDeviations() = default;
    explicit PatchDeviations(Eigen::MatrixXf own);
    /// `values` are those of D rows and N columns.
    PatchDeviations(std::shared_ptr<const float> values, Eigen::Index rows, Eigen::Index columns);

    [[nodiscard]] Eigen::Index rows() const noexcept { return rows_; }
    [[nodiscard]] Eigen::Map<const Eigen::MatrixXf> matrix() const noexcept {
        return {values_.get(), rows_, columns_};
    }
    /// The values of patch i.
    [[nodiscard]] Eigen::Map<const Eigen::VectorXf> col(Eigen::Index i) const noexcept {
        return {values_.get() + i * rows_, rows_};
    }

  private:
    std::shared_ptr<const float> values_;
    Eigen::Index rows_ = 0;
    Eigen::Index columns_ = 0;
};

/// The score of partition_score without concavity, which is a ratio and no sum over the parts, and but for a
/// constant: explained shares, crease, overlap agreement, size steadiness and links inside. The value of a
/// part S is
///     sum over meshes m of |X_m(S)|_1^2 / a_m(S) + |sum over m of X_m(S)|_2^2 / a(S)
///     + ties and links inside S
///     - weight of size steadiness * (variance over m of s_m(S)) / (mean of s_m(S)),
/// where X_m(S) is the sum of the deviations of the patches of S in m, the two norms weigh their rows by
/// `per_mesh` and by `pooled`, a is area, and s_m the share of the area of m.
struct PartitionObjective {
    /// D x N, column major: area times (x - mean of the mesh) over the square root of the spread, the
    /// descriptors below each other.
    PatchDeviations deviations;
    Eigen::VectorXf per_mesh;                 ///< D, the weight of each row
    Eigen::VectorXf pooled;                   ///< likewise
    std::vector<std::vector<PatchTie>> ties;  ///< of each patch, by both of its ends
    std::vector<int> mesh_of;                 ///< of each patch
    std::vector<double> area;                 ///< likewise
    std::vector<double> share;                ///< likewise: of the area of its mesh
    int meshes = 0;
    double size_weight = 0.0;
    std::optional<SparseRowsView> links;  ///< as in PartitionEvidence; not owned
    double link_gain = 0.0;               ///< of a link of weight 1 between patches of the same part
};

/// In the memory of this rank alone.
PartitionObjective partition_objective(const PartitionEvidence& evidence, const ChoiceWeights& weights);

/// The same, with deviations that a node holds once. `evidence` is the same on all ranks. Collective; the
/// last handle of the deviations must be destroyed at the same place on all ranks of a node.
PartitionObjective partition_objective(const Comm& comm, const PartitionEvidence& evidence,
                                       const ChoiceWeights& weights);

/// The patches of each mesh, which follow one another.
std::vector<BlockRange> patches_of_meshes(const PartitionObjective& objective);

/// Calls visit(other, gain) for each patch that patch i is tied or linked to.
template <class Visit>
void for_each_tie(const PartitionObjective& objective, int i, Visit&& visit) {
    for (const PatchTie& tie : objective.ties[at(i)]) visit(tie.other, tie.gain);
    if (!objective.links) return;
    const SparseRowsView& links = *objective.links;
    for (auto k = at(links.offsets[at(i)]); k < at(links.offsets[at(i) + 1]); ++k)
        visit(links.columns[k], objective.link_gain * links.values[k]);
}

/// (variance of s) / (mean of s) from the sum and the sum of squares of `meshes` numbers; 0 where the mean
/// is.
double relative_variance(double sum, double squares, int meshes);

}  // namespace coseg
