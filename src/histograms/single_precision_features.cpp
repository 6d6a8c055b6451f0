#include "src/histograms/single_precision_features.hpp"

#include <utility>

#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

SinglePrecisionFeatures::SinglePrecisionFeatures(const Comm& comm, const FeatureMatrices& features)
    : offsets_(features.offsets()),
      columns_(features.columns()),
      values_(std::make_shared<NodeSharedArray<float>>(comm, at(features.dimension() * features.columns()))) {
    const Comm& here = values_->ranks().here();
    const BlockRange mine = block_range(columns_, here.size(), here.rank());
    const Eigen::Index rows = features.dimension();
    const Eigen::Map<const Eigen::MatrixXd> all(features.data(), rows, columns_);
    Eigen::Map<Eigen::MatrixXf>(values_->data(), rows, columns_).middleCols(mine.begin, mine.size()) =
        all.middleCols(mine.begin, mine.size()).cast<float>();
    values_->fence();
}

SinglePrecisionFeatures::ConstBlock SinglePrecisionFeatures::operator[](std::size_t h) const {
    return {std::as_const(*values_).data() + offsets_[h], offsets_[h + 1] - offsets_[h], columns_,
            Eigen::OuterStride<>(offsets_.back())};
}

SinglePrecisionFeatures::ConstBlock SinglePrecisionFeatures::all() const {
    const float* values = values_ ? std::as_const(*values_).data() : nullptr;
    return {values, offsets_.back(), columns_, Eigen::OuterStride<>(offsets_.back())};
}

}  // namespace coseg
