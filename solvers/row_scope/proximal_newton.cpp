#include "solvers/row_scope/proximal_newton.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "solvers/subspace/tile_sums.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int ascent_limit = 20;
constexpr int ascent_halving_limit = 12;
constexpr double sufficient_increase = 1e-4;
/// ||X W - X V|| <= this * ||W - centre|| / sqrt(reach) is near enough to the proximal point.
constexpr double sufficient_gradient = 0.3;
constexpr double smallest_gradient = 1e-14;  ///< relative to ||X||
/// What is summed over all ranks.
struct DualSums {
    enum : std::size_t { value, gradient2, distance2, count };
};

}  // namespace

ProximalNewton::ProximalNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                               const ColumnValues& columns, const std::vector<double>& linear,
                               RowExchange& exchange)
    : comm_(comm),
      stack_(stack),
      fits_(columns.fits),
      offset_(columns.offset),
      linear_(linear),
      exchange_(exchange),
      prox_(stack.features, problem.alpha, problem.beta, problem.lambda),
      newton_(comm, problem, stack, columns, exchange),
      sums_(DualSums::count) {}

void ProximalNewton::apply(const std::vector<double>& vector, std::vector<double>& product) const {
    product.resize(vector.size());
    for (std::size_t c = 0; c < fits_.size(); ++c)
        apply_gram(stack_, fits_[c], vector.data() + offset_[c], product.data() + offset_[c]);
}

/// by_row_ becomes W; the penalties are added up.
void ProximalNewton::shrink_rows(double reach, std::vector<double>& prices) {
    const auto features = at(stack_.features);
    std::vector<double> row_sums(features);
    add_by_tiles<1>(exchange_.owned_rows().size(), DualSums::value, sums_, [&](std::int64_t r, double* tile) {
        const std::span<double> row = exchange_.row(by_row_, r);
        prox_.shrink(row, reach, std::span(prices).subspan(at(r) * features, features));
        tile[0] += prox_.penalty(row, row_sums);
    });
}

/// Calls add(at, sums) for every value of every column, sums[k] being of the k-th scalar.
template <class Add>
void ProximalNewton::sum_values(Add&& add) {
    add_by_tiles<DualSums::count>(std::ssize(fits_), 0, sums_, [&](std::int64_t c, double* tile) {
        const auto column = at(c);
        for (std::size_t entry = offset_[column]; entry < offset_[column + 1]; ++entry) add(entry, tile);
    });
    sums_.reduce(comm_);
}

/// Fills in W, the dual's value and the distance, which follow from `dual` and its product.
void ProximalNewton::evaluate(Point& point, const std::vector<double>& centre, double reach,
                              std::vector<double>& prices) {
    forward_.resize(centre.size());
    for (std::size_t entry = 0; entry < centre.size(); ++entry)
        forward_[entry] = centre[entry] - 2.0 * reach * (point.dual_product[entry] - linear_[entry]);
    exchange_.to_rows(forward_, by_row_);
    sums_.clear();
    shrink_rows(reach, prices);
    exchange_.to_columns(by_row_, point.weights);
    sum_values([&](std::size_t entry, double* tile) {
        const double weight = point.weights[entry];
        const double change = weight - centre[entry];
        tile[DualSums::value] += 2.0 * (point.dual_product[entry] - linear_[entry]) * weight -
                                 point.dual[entry] * point.dual_product[entry] +
                                 change * change / (2.0 * reach);
        tile[DualSums::distance2] += change * change;
    });
    point.value = sums_.overflowed() ? -std::numeric_limits<double>::infinity()
                                     : stack_.squared_norm + sums_.scalar(DualSums::value);
    point.distance2 = sums_.scalar(DualSums::distance2);
}

/// Fills in G W and the dual's gradient.
void ProximalNewton::differentiate(Point& point) {
    apply(point.weights, point.product);
    sums_.clear();
    sum_values([&](std::size_t entry, double* tile) {
        tile[DualSums::gradient2] +=
            (point.product[entry] - point.dual_product[entry]) * (point.weights[entry] - point.dual[entry]);
    });
    point.gradient2 = std::max(sums_.scalar(DualSums::gradient2), 0.0);
}

/// Newton's direction of V. Returns the dual's slope along it, which is not negative.
double ProximalNewton::find_direction(double reach) {
    const std::size_t count = current_.weights.size();
    direction_.resize(count);
    for (std::size_t entry = 0; entry < count; ++entry)
        direction_[entry] = 2.0 * (current_.dual_product[entry] - current_.product[entry]);
    const std::vector<double>& change = newton_.solve(current_.weights, direction_, 1.0 / reach);
    for (std::size_t entry = 0; entry < count; ++entry)
        direction_[entry] = current_.weights[entry] + change[entry] - current_.dual[entry];
    apply(direction_, direction_product_);
    sums_.clear();
    sum_values([&](std::size_t entry, double* tile) {
        tile[DualSums::value] +=
            2.0 * (current_.product[entry] - current_.dual_product[entry]) * direction_[entry];
    });
    return sums_.scalar(DualSums::value);
}

/// False if no step of the direction raises the dual.
bool ProximalNewton::step_along_direction(const std::vector<double>& centre, double reach, double slope,
                                          std::vector<double>& prices) {
    const std::size_t count = centre.size();
    trial_.dual.resize(count);
    trial_.dual_product.resize(count);
    // Near the optimum an increase is smaller than the rounding of the value.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * stack_.squared_norm;
    double size = 1.0;
    for (int halving = 0; halving < ascent_halving_limit; ++halving, size *= 0.5) {
        for (std::size_t entry = 0; entry < count; ++entry) {
            trial_.dual[entry] = current_.dual[entry] + size * direction_[entry];
            trial_.dual_product[entry] = current_.dual_product[entry] + size * direction_product_[entry];
        }
        evaluate(trial_, centre, reach, prices);
        if (trial_.value < current_.value + sufficient_increase * size * slope - rounding) continue;
        std::swap(current_, trial_);
        differentiate(current_);
        return true;
    }
    return false;
}

ProximalPoint ProximalNewton::minimise(const std::vector<double>& centre,
                                       const std::vector<double>& centre_product, double reach,
                                       std::vector<double>& prices) {
    current_.dual = centre;
    current_.dual_product = centre_product;
    evaluate(current_, centre, reach, prices);
    differentiate(current_);
    // At the optimum itself only the last bits change.
    const double rounding2 = smallest_gradient * smallest_gradient * stack_.squared_norm;
    const auto reached = [&] {
        return current_.gradient2 <=
               std::max(sufficient_gradient * sufficient_gradient * current_.distance2 / reach, rounding2);
    };
    int steps = 0;
    while (steps < ascent_limit && !reached()) {
        const double slope = find_direction(reach);
        if (!step_along_direction(centre, reach, slope, prices)) break;
        ++steps;
    }
    return {current_.weights, steps, reached()};
}

}  // namespace coseg
