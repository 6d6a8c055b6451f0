#pragma once
// The features of all patches in single precision, laid out for the passes over all pairs.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/subspace/feature_stack.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

/// The columns of a stack in the panels of pair_score_kernel.hpp: they are the rows against which columns are
/// scored. A panel holds rows of one group only, and is filled up with zeros. There is one copy on each node.
class PanelColumns {
  public:
    /// Group g is the stack's columns group_begin[g] .. group_begin[g + 1]; the groups hold all of them.
    /// Collective over `comm`, whose ranks all have this stack and these groups.
    PanelColumns(const Comm& comm, const FeatureStack& stack, std::span<const int> group_begin);

    [[nodiscard]] int count() const noexcept { return static_cast<int>(first_row_.size()); }
    /// The panels of group g are first_panel(g) .. first_panel(g + 1).
    [[nodiscard]] int first_panel(int group) const { return group_panel_[at(group)]; }
    [[nodiscard]] int first_row(int panel) const { return first_row_[at(panel)]; }
    /// Of 1 .. panel_rows places of the panel.
    [[nodiscard]] int row_count(int panel) const { return row_count_[at(panel)]; }
    /// Bit r is set where place r of the panel has a row, as find_above numbers them.
    [[nodiscard]] std::uint64_t row_bits(int panel) const;
    /// The rows of a panel from the features' value `offset` on, panel_rows values together.
    [[nodiscard]] const float* values(int panel, int offset) const noexcept;

  private:
    void deal_panels(std::span<const int> group_begin);

    int dimension_;
    std::vector<int> group_panel_;
    std::vector<int> first_row_;
    std::vector<int> row_count_;
    NodeSharedArray<float> values_;
};

}  // namespace coseg
