#include "solvers/subspace/pair_scorer.hpp"

#include <algorithm>

#include "solvers/numeric/pair_score_kernel.hpp"
#include "src/base/index.hpp"

namespace coseg {

void DualColumns::reset(const FeatureStack& stack, int columns) {
    groups_ = (columns + group_columns - 1) / group_columns;
    offset_ = stack.offset;
    const auto filled = at(groups_ * group_columns);
    values_.assign(at(stack.dimension) * filled, 0.0F);
    errors_.assign(at(stack.features) * filled, 0.0F);
}

void DualColumns::set(int column, const double* dual, const double* errors) {
    for (std::size_t h = 0; h + 1 < offset_.size(); ++h) {
        const int depth = offset_[h + 1] - offset_[h];
        float* to = column_in_groups(values_.data() + static_cast<std::ptrdiff_t>(offset_[h]) * columns(),
                                     column, depth);
        for (int k = 0; k < depth; ++k)
            to[static_cast<std::ptrdiff_t>(k) * group_columns] = static_cast<float>(dual[offset_[h] + k]);
        errors_[h * at(columns()) + at(column)] = static_cast<float>(errors[h]);
    }
}

int DualColumns::columns() const noexcept { return groups_ * group_columns; }

const float* DualColumns::values(int h) const {
    return values_.data() + static_cast<std::ptrdiff_t>(offset_[at(h)]) * columns();
}

const float* DualColumns::errors(int h) const {
    return errors_.data() + static_cast<std::ptrdiff_t>(h) * columns();
}

void PanelScores::resize(int panels, int features, int columns) {
    features_ = features;
    columns_ = columns;
    const std::size_t size = at(panels) * at(columns) * panel_rows;
    if (squares_.size() < size) squares_.resize(size);
    if (scores_.size() < size * at(features)) scores_.resize(size * at(features));
}

std::int64_t PanelScores::feature_stride() const noexcept {
    return static_cast<std::int64_t>(columns_) * panel_rows;
}

std::int64_t PanelScores::scores_place(int panel, int h, int column) const noexcept {
    return (std::int64_t{panel} * features_ + h) * feature_stride() + std::int64_t{column} * panel_rows;
}

std::int64_t PanelScores::squares_place(int panel, int column) const noexcept {
    return panel * feature_stride() + std::int64_t{column} * panel_rows;
}

namespace {

class ProcessorPairScorer final : public PairScorer {
  public:
    ProcessorPairScorer(const FeatureStack& stack, const PanelColumns& panels)
        : stack_(stack), panels_(panels) {}

    [[nodiscard]] int batch_panels() const override { return 1; }
    void set_prices(const std::vector<float>& prices) override { prices_ = prices.data(); }
    void set_columns(const DualColumns& columns) override { columns_ = &columns; }

    void score(int first, int count, PanelScores& to) override {
        const std::size_t places = at(panels_.count()) * panel_rows;
        for (int p = 0; p < count; ++p) {
            const int panel = first + p;
            std::fill_n(to.squares(p, 0), to.feature_stride(), 0.0F);
            for (int h = 0; h < stack_.features; ++h) {
                const float* prices = prices_ + at(h) * places + at(panel) * panel_rows;
                score_pairs({panels_.values(panel, stack_.offset[at(h)]), prices, panels_.row_count(panel)},
                            {columns_->values(h), columns_->errors(h), columns_->groups()}, stack_.rows_of(h),
                            {to.scores(p, h, 0), to.squares(p, 0)});
            }
        }
    }

  private:
    const FeatureStack& stack_;
    const PanelColumns& panels_;
    const float* prices_ = nullptr;
    const DualColumns* columns_ = nullptr;
};

}  // namespace

std::unique_ptr<PairScorer> processor_pair_scorer(const FeatureStack& stack, const PanelColumns& panels) {
    return std::make_unique<ProcessorPairScorer>(stack, panels);
}

}  // namespace coseg
