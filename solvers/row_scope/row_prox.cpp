#include "solvers/row_scope/row_prox.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/subspace/group_shrinkage.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int newton_limit = 60;
constexpr int halving_limit = 40;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest_magnitude(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

}  // namespace

RowProx::RowProx(int features, double alpha, double beta, double lambda)
    : features_(at(features)),
      alpha_(alpha),
      beta_(beta),
      lambda_(lambda),
      slope_(features_),
      curvature_(features_ * features_),
      excess_(features_),
      direction_(features_),
      trial_price_(features_) {}

/// The generalised derivative of shrink_group at the pair at hand, times step.
void RowProx::add_curvature(double norm, double step) {
    const double shrink = step * alpha_ / norm;
    for (std::size_t g = 0; g < features_; ++g) {
        if (excess_[g] <= 0.0) continue;
        const double along = step * shrink * excess_[g] / (norm * norm);
        for (std::size_t h = 0; h <= g; ++h) curvature_[g * features_ + h] += along * excess_[h];
        curvature_[g * features_ + g] += step * (1.0 - shrink);
    }
}

void RowProx::add_pair(const double* v, double step, std::span<const double> price) {
    double squares = 0.0;
    for (std::size_t h = 0; h < features_; ++h) {
        excess_[h] = std::max(v[h] - step * (price[h] + beta_), 0.0);
        squares += excess_[h] * excess_[h];
    }
    const double norm = std::sqrt(squares);
    if (norm <= step * alpha_) return;
    const double length = norm - step * alpha_;
    dual_ += length * length / (2.0 * step);
    for (std::size_t h = 0; h < features_; ++h) slope_[h] -= length / norm * excess_[h];
    add_curvature(norm, step);
}

void RowProx::evaluate(std::span<const double> v, double step, std::span<const double> price) {
    dual_ = 0.0;
    std::fill(curvature_.begin(), curvature_.end(), 0.0);
    for (std::size_t h = 0; h < features_; ++h) {
        slope_[h] = price[h] / (2.0 * lambda_);
        curvature_[h * features_ + h] = 1.0 / (2.0 * lambda_);
        dual_ += price[h] * price[h] / (4.0 * lambda_);
    }
    for (std::size_t entry = 0; entry < v.size(); entry += features_) add_pair(v.data() + entry, step, price);
}

/// direction = -curvature^-1 slope, by Cholesky in place of the lower triangle. False if rounding leaves
/// none.
bool RowProx::solve_direction() {
    double* a = curvature_.data();
    const std::size_t n = features_;
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t k = 0; k < c; ++k) a[c * n + c] -= a[c * n + k] * a[c * n + k];
        if (!(a[c * n + c] > 0.0)) return false;
        a[c * n + c] = std::sqrt(a[c * n + c]);
        for (std::size_t r = c + 1; r < n; ++r) {
            for (std::size_t k = 0; k < c; ++k) a[r * n + c] -= a[r * n + k] * a[c * n + k];
            a[r * n + c] /= a[c * n + c];
        }
    }
    for (std::size_t r = 0; r < n; ++r) {
        double value = -slope_[r];
        for (std::size_t k = 0; k < r; ++k) value -= a[r * n + k] * direction_[k];
        direction_[r] = value / a[r * n + r];
    }
    for (std::size_t r = n; r-- > 0;) {
        for (std::size_t k = r + 1; k < n; ++k) direction_[r] -= a[k * n + r] * direction_[k];
        direction_[r] /= a[r * n + r];
    }
    return true;
}

void RowProx::apply(std::span<double> v, double step, std::span<const double> price) const {
    for (std::size_t entry = 0; entry < v.size(); entry += features_) {
        for (std::size_t h = 0; h < features_; ++h) v[entry + h] -= step * price[h];
        shrink_group(v.subspan(entry, features_), step, alpha_, beta_);
    }
}

void RowProx::shrink(std::span<double> v, double step, std::span<double> price) {
    if (lambda_ == 0.0 || v.empty()) {
        std::fill(price.begin(), price.end(), 0.0);
        apply(v, step, price);
        return;
    }
    evaluate(v, step, price);
    for (int iteration = 0; iteration < newton_limit; ++iteration) {
        const double before = dual_;
        if (!solve_direction()) break;
        double slope = 0.0;
        double price_size = 0.0;
        for (std::size_t h = 0; h < features_; ++h) {
            slope += slope_[h] * direction_[h];
            price_size = std::max(price_size, std::abs(price[h]));
        }
        double size = 1.0;
        for (int halving = 0; halving < halving_limit; ++halving, size *= 0.5) {
            for (std::size_t h = 0; h < features_; ++h) trial_price_[h] = price[h] + size * direction_[h];
            evaluate(v, step, trial_price_);
            if (dual_ <= before + 1e-4 * size * slope + 4.0 * epsilon * std::abs(before)) break;
        }
        std::copy(trial_price_.begin(), trial_price_.end(), price.begin());
        if (size * largest_magnitude(direction_) <= 2.0 * epsilon * price_size) break;
    }
    apply(v, step, price);
}

double RowProx::penalty(std::span<const double> w, std::span<double> sums) const {
    std::fill(sums.begin(), sums.end(), 0.0);
    double result = 0.0;
    for (std::size_t entry = 0; entry < w.size(); entry += features_) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features_; ++h) {
            sums[h] += w[entry + h];
            squares += w[entry + h] * w[entry + h];
        }
        result += alpha_ * std::sqrt(squares);
    }
    for (const double sum : sums) result += lambda_ * sum * sum + beta_ * sum;
    return result;
}

}  // namespace coseg
