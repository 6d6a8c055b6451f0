#include "solvers/row_scope/working_set_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solvers/subspace/dual_bound.hpp"
#include "solvers/subspace/tile_sums.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// What is summed over all ranks.
struct ModelSums {
    enum : std::size_t { fit, distance2, curvature, penalty, count };
};

std::vector<int> all_rows(const WorkingSet& working) {
    std::vector<int> rows;
    for (const RowScopeColumn& column : working.fits)
        rows.insert(rows.end(), column.rows.begin(), column.rows.end());
    return rows;
}

/// Where each column's values begin.
std::vector<std::size_t> value_offsets(const WorkingSet& working) {
    std::vector<std::size_t> offsets{0};
    for (const RowScopeColumn& column : working.fits)
        offsets.push_back(offsets.back() + column.weights.size());
    return offsets;
}

}  // namespace

std::int64_t WorkingSet::pair_count() const {
    std::int64_t count = 0;
    for (const RowScopeColumn& column : fits) count += static_cast<std::int64_t>(column.rows.size());
    return count;
}

WorkingSetModel::WorkingSetModel(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                                 const WorkingSet& working, std::vector<double>& prices)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      working_(working),
      prices_(prices),
      offset_(value_offsets(working)),
      exchange_(comm, stack.size, stack.features, all_rows(working)),
      prox_(stack.features, problem.alpha, problem.beta, problem.lambda),
      proximal_(comm, problem, stack, {working.fits, offset_}, linear_, exchange_),
      sums_(ModelSums::count) {
    for (const RowScopeColumn& column : working.fits) {
        linear_.insert(linear_.end(), column.linear.begin(), column.linear.end());
        forward_.insert(forward_.end(), column.weights.begin(), column.weights.end());
    }
    current_.weights.assign(forward_.size(), 0.0);
    current_.product.assign(forward_.size(), 0.0);
    current_.row_sums.assign(prices.size(), 0.0);
    trial_ = current_;
    evaluate_forward();
    accept();
}

/// forward_ becomes the trial as it is: a row's prox of step 0 only sums.
TrialPoint WorkingSetModel::evaluate_forward() {
    exchange_.to_rows(forward_, by_row_);
    shrink_rows(0.0);
    measure_columns();
    return finish_trial();
}

std::optional<int> WorkingSetModel::proximal_step(double reach) {
    const ProximalPoint point = proximal_.minimise(current_.weights, current_.product, reach, prices_);
    forward_ = point.weights;
    if (evaluate_forward().objective < current_.objective) accept();
    return point.reached ? std::optional(point.newton_steps) : std::nullopt;
}

/// From forward_ to the trial's weights; the penalties are added up.
void WorkingSetModel::shrink_rows(double step) {
    const auto features = at(stack_.features);
    sums_.clear();
    add_by_tiles<1>(exchange_.owned_rows().size(), ModelSums::penalty, sums_,
                    [&](std::int64_t r, double* tile) {
                        const std::span<double> row = exchange_.row(by_row_, r);
                        const std::size_t entry = at(r) * features;
                        if (step > 0.0) prox_.shrink(row, step, std::span(prices_).subspan(entry, features));
                        tile[0] += prox_.penalty(row, std::span(trial_.row_sums).subspan(entry, features));
                    });
    exchange_.to_columns(by_row_, trial_.weights);
}

void WorkingSetModel::measure_columns() {
    add_by_tiles<3>(std::ssize(working_.fits), ModelSums::fit, sums_, [&](std::int64_t c, double* tile) {
        const auto column = at(c);
        apply_gram(stack_, working_.fits[column], trial_.weights.data() + offset_[column],
                   trial_.product.data() + offset_[column]);
        for (std::size_t entry = offset_[column]; entry < offset_[column + 1]; ++entry) {
            const double weight = trial_.weights[entry];
            const double change = weight - current_.weights[entry];
            tile[ModelSums::fit] += weight * (trial_.product[entry] - 2.0 * linear_[entry]);
            tile[ModelSums::distance2] += change * change;
            tile[ModelSums::curvature] += 2.0 * change * (trial_.product[entry] - current_.product[entry]);
        }
    });
}

TrialPoint WorkingSetModel::finish_trial() {
    sums_.reduce(comm_);
    TrialPoint trial;
    trial.objective = stack_.squared_norm + (sums_.scalar(ModelSums::fit) + sums_.scalar(ModelSums::penalty));
    if (sums_.overflowed()) trial.objective = std::numeric_limits<double>::infinity();
    trial.distance2 = sums_.scalar(ModelSums::distance2);
    trial.curvature = std::max(sums_.scalar(ModelSums::curvature), 0.0);
    trial_.objective = trial.objective;
    return trial;
}

TrialPoint WorkingSetModel::propose(double step) {
    for (std::size_t entry = 0; entry < forward_.size(); ++entry) {
        forward_[entry] = current_.weights[entry] - 2.0 * step * (current_.product[entry] - linear_[entry]);
    }
    exchange_.to_rows(forward_, by_row_);
    shrink_rows(step);
    measure_columns();
    return finish_trial();
}

double WorkingSetModel::lower_bound() const {
    const std::vector<double> sums = row_sums();
    PaperDualBound bound(stack_, problem_.alpha, problem_.beta, problem_.lambda, sums);
    const auto features = at(stack_.features);
    const auto dimension = at(stack_.dimension);
    std::vector<double> reconstruction(dimension * at(coefficient_tile));
    std::vector<double> scores(features);
    for (std::size_t begin = 0; begin < working_.fits.size(); begin += at(coefficient_tile)) {
        const std::size_t width = std::min<std::size_t>(coefficient_tile, working_.fits.size() - begin);
        for (std::size_t c = 0; c < width; ++c) {
            reconstruct(stack_, working_.fits[begin + c], current_.weights.data() + offset_[begin + c],
                        reconstruction.data() + c * dimension);
        }
        bound.begin_tile(static_cast<int>(working_.columns.begin) + static_cast<int>(begin),
                         static_cast<int>(width), reconstruction.data());
        for (std::size_t c = 0; c < width; ++c) {
            const std::vector<int>& rows = working_.fits[begin + c].rows;
            for (std::size_t p = 0; p < rows.size(); ++p) {
                const std::size_t entry = offset_[begin + c] + p * features;
                for (std::size_t h = 0; h < features; ++h) {
                    scores[h] = 2.0 * (linear_[entry + h] - current_.product[entry + h]);
                }
                bound.check_pair(static_cast<int>(c), rows[p], scores.data(),
                                 2.0 * stack_.inner_product_error());
            }
        }
        bound.end_tile();
    }
    return bound.finish(comm_);
}

std::vector<double> WorkingSetModel::row_sums() const {
    return all_gather(comm_, std::span<const double>(current_.row_sums));
}

void WorkingSetModel::store(WorkingSet& working) const {
    for (std::size_t c = 0; c < working.fits.size(); ++c) {
        std::copy_n(current_.weights.begin() + static_cast<std::ptrdiff_t>(offset_[c]),
                    offset_[c + 1] - offset_[c], working.fits[c].weights.begin());
    }
}

}  // namespace coseg
