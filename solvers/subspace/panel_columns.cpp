#include "solvers/subspace/panel_columns.hpp"

#include <algorithm>

#include "solvers/numeric/pair_score_kernel.hpp"
#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

namespace {

std::size_t panels_of(std::span<const int> group_begin) {
    std::size_t panels = 0;
    for (std::size_t g = 0; g + 1 < group_begin.size(); ++g)
        panels += at((group_begin[g + 1] - group_begin[g] + panel_rows - 1) / panel_rows);
    return panels;
}

}  // namespace

PanelColumns::PanelColumns(const Comm& comm, const FeatureStack& stack, std::span<const int> group_begin)
    : dimension_(stack.dimension), values_(comm, panels_of(group_begin) * at(panel_rows * stack.dimension)) {
    deal_panels(group_begin);
    const Comm& here = values_.ranks().here();
    const BlockRange part = block_range(count(), here.size(), here.rank());
    for (std::int64_t panel = part.begin; panel < part.end; ++panel) {
        float* rows = values_.data() + panel * panel_rows * dimension_;
        const int first = first_row(static_cast<int>(panel));
        for (int r = 0; r < row_count(static_cast<int>(panel)); ++r) {
            for (Eigen::Index k = 0; k < dimension_; ++k)
                rows[k * panel_rows + r] = static_cast<float>(stack.columns(k, first + r));
        }
    }
    values_.fence();
}

void PanelColumns::deal_panels(std::span<const int> group_begin) {
    group_panel_.push_back(0);
    for (std::size_t g = 0; g + 1 < group_begin.size(); ++g) {
        for (int row = group_begin[g]; row < group_begin[g + 1]; row += panel_rows) {
            first_row_.push_back(row);
            row_count_.push_back(std::min(panel_rows, group_begin[g + 1] - row));
        }
        group_panel_.push_back(count());
    }
}

std::uint64_t PanelColumns::row_bits(int panel) const {
    static_assert(panel_rows <= 64);
    return ~std::uint64_t{0} >> (64 - row_count(panel));
}

const float* PanelColumns::values(int panel, int offset) const noexcept {
    return values_.data() + (static_cast<std::int64_t>(panel) * dimension_ + offset) * panel_rows;
}

}  // namespace coseg
