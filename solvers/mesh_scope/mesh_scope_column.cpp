#include "solvers/mesh_scope/mesh_scope_column.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/subspace/row_scope_column.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

double positive_norm(const double* gradient, std::size_t features, double beta) noexcept {
    double squares = 0.0;
    for (std::size_t h = 0; h < features; ++h) {
        const double excess = std::max(-gradient[h] - beta, 0.0);
        squares += excess * excess;
    }
    return std::sqrt(squares);
}

}  // namespace

MeshScopeColumn::MeshScopeColumn(const FeatureStack& stack, const ColumnPenalties& penalties,
                                 WorkingColumn& column)
    : stack_(stack),
      penalties_(penalties),
      column_(column),
      target_(stack.columns.data() + static_cast<std::int64_t>(column.column) * stack.dimension),
      trial_weights_(column.weights.size(), 0.0),
      gradient_(column.weights.size(), 0.0),
      reconstruction_(at(stack.dimension), 0.0),
      trial_reconstruction_(reconstruction_),
      group_sums_(column.group_begin.size() - 1, 0.0),
      trial_group_sums_(group_sums_),
      shift_(at(stack.features), 0.0) {
    // A step of length 0 turns the given weights, which already are a fixed point of it, into the current
    // point.
    propose(0.0);
    accept();
}

double MeshScopeColumn::shrink_groups(double step) {
    const auto features = at(stack_.features);
    double penalty = 0.0;
    for (std::size_t g = 0; g + 1 < column_.group_begin.size(); ++g) {
        const auto begin = at(column_.group_begin[g]) * features;
        const auto end = at(column_.group_begin[g + 1]) * features;
        for (std::size_t entry = begin; entry < end; ++entry)
            trial_weights_[entry] = column_.weights[entry] - step * gradient_[entry];
        const double sum = exclusive_shrink(std::span(trial_weights_).subspan(begin, end - begin),
                                            stack_.features, step, penalties_, scratch_);
        trial_group_sums_[g] = sum;
        penalty += penalties_.lambda * sum * sum + penalties_.alpha * sum;
    }
    return penalty;
}

COSEG_VECTOR_CLONES
void MeshScopeColumn::reconstruct_trial() {
    std::fill(trial_reconstruction_.begin(), trial_reconstruction_.end(), 0.0);
    double* z = trial_reconstruction_.data();
    const auto features = at(stack_.features);
    for (std::size_t p = 0; p < column_.rows.size(); ++p) {
        const double* x =
            stack_.columns.data() + static_cast<std::int64_t>(column_.rows[p]) * stack_.dimension;
        for (std::size_t h = 0; h < features; ++h) {
            const double weight = trial_weights_[p * features + h];
            if (weight == 0.0) continue;
            for (int k = stack_.offset[h]; k < stack_.offset[h + 1]; ++k) z[k] += weight * x[k];
        }
    }
}

TrialPoint MeshScopeColumn::propose(double step) {
    TrialPoint trial;
    double penalty = shrink_groups(step);
    for (std::size_t entry = 0; entry < trial_weights_.size(); ++entry) {
        const double change = trial_weights_[entry] - column_.weights[entry];
        trial.distance2 += change * change;
        penalty += penalties_.beta * trial_weights_[entry];
    }
    reconstruct_trial();
    double fit = 0.0;
    for (std::size_t k = 0; k < trial_reconstruction_.size(); ++k) {
        const double z = trial_reconstruction_[k];
        const double change = z - reconstruction_[k];
        fit += z * (z - 2.0 * target_[k]);
        trial.curvature += 2.0 * change * change;
    }
    trial_objective_ = trial.objective = fit + penalty;
    return trial;
}

void MeshScopeColumn::accept() {
    column_.weights.swap(trial_weights_);
    reconstruction_.swap(trial_reconstruction_);
    group_sums_.swap(trial_group_sums_);
    objective_ = trial_objective_;
    compute_gradient();
}

void MeshScopeColumn::compute_gradient() {
    // trial_reconstruction_ is free until the next proposal: it holds the residual here.
    for (std::size_t k = 0; k < reconstruction_.size(); ++k) {
        trial_reconstruction_[k] = 2.0 * (reconstruction_[k] - target_[k]);
    }
    for (std::size_t p = 0; p < column_.rows.size(); ++p) {
        feature_products(stack_, column_.rows[p], trial_reconstruction_.data(),
                         gradient_.data() + p * at(stack_.features));
    }
}

double MeshScopeColumn::first_step() const noexcept { return 1.0 / (2.0 * stack_.largest_inner); }

double MeshScopeColumn::raised_decrease() {
    const auto features = at(stack_.features);
    double decrease = 0.0;
    for (const double z : reconstruction_) decrease += z * z;
    for (std::size_t g = 0; g + 1 < column_.group_begin.size(); ++g) {
        double price = 0.0;
        for (int p = column_.group_begin[g]; p < column_.group_begin[g + 1]; ++p) {
            const double* gradient = gradient_.data() + at(p) * features;
            price = std::max(price, positive_norm(gradient, features, penalties_.beta) - penalties_.alpha);
        }
        if (price > 0.0) decrease += price * price / (4.0 * penalties_.lambda);
    }
    return decrease;
}

double MeshScopeColumn::shifted_decrease() {
    const auto features = at(stack_.features);
    std::fill(shift_.begin(), shift_.end(), 0.0);
    double decrease = 0.0;
    for (std::size_t g = 0; g + 1 < column_.group_begin.size(); ++g) {
        const double limit = penalties_.alpha + 2.0 * penalties_.lambda * group_sums_[g];
        decrease += penalties_.lambda * group_sums_[g] * group_sums_[g];
        for (int p = column_.group_begin[g]; p < column_.group_begin[g + 1]; ++p) {
            const double* gradient = gradient_.data() + at(p) * features;
            const double norm = positive_norm(gradient, features, penalties_.beta);
            if (norm <= limit) continue;
            for (std::size_t h = 0; h < features; ++h) {
                const double needed = std::max(-gradient[h] - penalties_.beta, 0.0) * (1.0 - limit / norm);
                const auto row = static_cast<Eigen::Index>(column_.rows[at(p)]);
                shift_[h] = std::max(shift_[h], needed / stack_.entry_sum(static_cast<Eigen::Index>(h), row));
            }
        }
    }
    for (std::size_t h = 0; h < features; ++h) {
        for (int k = stack_.offset[h]; k < stack_.offset[h + 1]; ++k) {
            const double z = reconstruction_[at(k)] + 0.5 * shift_[h];
            decrease += z * z;
        }
    }
    return decrease;
}

double MeshScopeColumn::largest_decrease() {
    const double raised = raised_decrease();
    return shift_pays(stack_, penalties_) ? std::min(raised, shifted_decrease()) : raised;
}

}  // namespace coseg
