#pragma once
// One column of mesh scope on a working set of its pairs: the model on which the spectral projected gradient
// works.

#include <span>
#include <vector>

#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/group_shrinkage.hpp"
#include "solvers/subspace/spectral_projected_gradient.hpp"

namespace coseg {

/// Whether it pays to compute the bound that shifts the dual. Raising the price of a group costs in inverse
/// proportion to lambda, so that shifting pays where lambda is small against the columns' squared norms.
inline bool shift_pays(const FeatureStack& stack, const ColumnPenalties& penalties) {
    return penalties.lambda < stack.largest_inner;
}

/// The working set of a column: rows ascending by group, the H values of a pair together.
struct WorkingColumn {
    int column = 0;                ///< in the stack's order
    std::vector<int> rows;         ///< ascending
    std::vector<int> group_begin;  ///< the first row of each group, and rows.size() at the end
    std::vector<double> weights;   ///< rows.size() x H
};

/// Minimises sum_h ||X_h w_h - x_h||^2 - ||x_h||^2 + penalties over the pairs of `column`. This is minus the
/// decrease from W = 0, so that small decreases keep their digits.
class MeshScopeColumn {
  public:
    MeshScopeColumn(const FeatureStack& stack, const ColumnPenalties& penalties, WorkingColumn& column);

    [[nodiscard]] double objective() const noexcept { return objective_; }
    TrialPoint propose(double step);
    void accept();

    /// An upper bound of the decrease that any W on these pairs can reach. Rounding is not allowed for.
    [[nodiscard]] double largest_decrease();

    /// Per group of the working column: the sum of its pairs' norms.
    [[nodiscard]] const std::vector<double>& group_sums() const noexcept { return group_sums_; }
    /// X w of the current point, D values.
    [[nodiscard]] const std::vector<double>& reconstruction() const noexcept { return reconstruction_; }
    /// A step that suits the curvature along the negative gradient.
    [[nodiscard]] double first_step() const noexcept;

  private:
    double shrink_groups(double step);
    void reconstruct_trial();
    void compute_gradient();
    double raised_decrease();
    double shifted_decrease();

    const FeatureStack& stack_;
    const ColumnPenalties& penalties_;
    WorkingColumn& column_;
    const double* target_;
    std::vector<double> trial_weights_;
    std::vector<double> gradient_;
    std::vector<double> reconstruction_;
    std::vector<double> trial_reconstruction_;
    std::vector<double> group_sums_;
    std::vector<double> trial_group_sums_;
    std::vector<double> shift_;
    double objective_ = 0.0;
    double trial_objective_ = 0.0;
    ExclusiveShrinkScratch scratch_;
};

}  // namespace coseg
