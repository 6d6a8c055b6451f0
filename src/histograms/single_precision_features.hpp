#pragma once
// The features of all patches in single precision, which is what the cut looks at.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "src/histograms/feature_matrices.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

/// The values of a FeatureMatrices, rounded to half the memory. The optimiser, whose optimum is certified,
/// needs the other half; means and shares over patches do not. Copies are handles of the same values. The
/// last handle must be destroyed at the same place on all ranks of a node, because that frees shared memory.
class SinglePrecisionFeatures {
  public:
    using ConstBlock = Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;

    /// No features.
    SinglePrecisionFeatures() = default;
    /// Once a node of `comm`, whose ranks all have `features`, see NodeSharedMemory. Collective.
    SinglePrecisionFeatures(const Comm& comm, const FeatureMatrices& features);

    /// H.
    [[nodiscard]] std::size_t size() const noexcept { return offsets_.size() - 1; }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    /// Feature h, d_h x N.
    [[nodiscard]] ConstBlock operator[](std::size_t h) const;
    /// All features below each other, D x N.
    [[nodiscard]] ConstBlock all() const;

  private:
    std::vector<Eigen::Index> offsets_{0};  ///< as FeatureMatrices::offsets
    Eigen::Index columns_ = 0;
    std::shared_ptr<NodeSharedArray<float>> values_;
};

}  // namespace coseg
