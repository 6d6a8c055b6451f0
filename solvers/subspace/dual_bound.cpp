#include "solvers/subspace/dual_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/subspace/tile_sums.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
enum Scalar : std::size_t { reconstruction_sum, shifted_sum, scalar_count };

}  // namespace

PaperDualBound::PaperDualBound(const FeatureStack& stack, double alpha, double beta, double lambda,
                               const std::vector<double>& row_sums)
    : stack_(stack),
      alpha_(alpha),
      beta_(beta),
      lambda_(lambda),
      row_sums_(row_sums),
      raise_(row_sums.size(), 0.0),
      excess_(at(stack.features)),
      sums_(scalar_count) {}

void PaperDualBound::begin_tile(int first, int width, const double* reconstruction) {
    width_ = width;
    reconstruction_ = reconstruction;
    residual_norm_.clear();
    for (int c = 0; c < width; ++c) {
        const double* x = stack_.columns.data() + static_cast<std::int64_t>(first + c) * stack_.dimension;
        const double* z = reconstruction + static_cast<std::int64_t>(c) * stack_.dimension;
        for (int h = 0; h < stack_.features; ++h) {
            const int begin = stack_.offset[at(h)];
            double squares = 0.0;
            for (int k = begin; k < begin + stack_.rows_of(h); ++k) squares += (x[k] - z[k]) * (x[k] - z[k]);
            residual_norm_.push_back(2.0 * std::sqrt(squares) * (1.0 + stack_.inner_product_error()));
        }
    }
    shift_.assign(residual_norm_.size(), 0.0);
}

double PaperDualBound::check_pair(int c, int i, const double* scores, double rounding) {
    const std::size_t features = excess_.size();
    const std::size_t row = at(i) * features;
    const double* residual_norm = residual_norm_.data() + at(c) * features;
    double squares = 0.0;
    double plain_squares = 0.0;
    for (std::size_t h = 0; h < features; ++h) {
        const double price = 2.0 * lambda_ * row_sums_[row + h];
        const double plain = std::max(scores[h] - price - beta_, 0.0);
        const double error = rounding * stack_.norm(static_cast<Eigen::Index>(h), i) * residual_norm[h] +
                             4.0 * epsilon * (std::abs(scores[h]) + price + beta_);
        excess_[h] = std::max(scores[h] - price - beta_ + error, 0.0);
        squares += excess_[h] * excess_[h];
        plain_squares += plain * plain;
    }
    const double norm = std::sqrt(squares) * (1.0 + (stack_.features + 4) * epsilon);
    if (norm > alpha_) repair(c, i, norm);
    return std::sqrt(plain_squares);
}

/// Both repairs shorten the current excess, of the given norm, to alpha.
void PaperDualBound::repair(int c, int i, double norm) {
    const std::size_t features = excess_.size();
    const std::size_t row = at(i) * features;
    double* shift = shift_.data() + at(c) * features;
    const double cut = (1.0 - alpha_ / norm) + 4.0 * epsilon;
    for (std::size_t h = 0; h < features; ++h) {
        const double needed = excess_[h] * cut * (1.0 + 4.0 * epsilon);
        raise_[row + h] = std::max(raise_[row + h], needed);
        shift[h] = std::max(shift[h], needed / stack_.entry_sum(static_cast<Eigen::Index>(h), i));
    }
}

void PaperDualBound::end_tile() {
    const double* z = reconstruction_;
    add_by_tiles<2>(width_, reconstruction_sum, sums_, [&](std::int64_t c, double* tile) {
        for (int h = 0; h < stack_.features; ++h) {
            const double half = 0.5 * shift_[at(c * stack_.features + h)] * (1.0 + 4.0 * epsilon);
            for (int k = 0; k < stack_.rows_of(h); ++k, ++z) {
                tile[reconstruction_sum] += *z * *z;
                tile[shifted_sum] += (*z + half) * (*z + half);
            }
        }
    });
}

double PaperDualBound::raised_cost(const Comm& comm) {
    in_messages(std::ssize(raise_), [&](std::int64_t first, int count) {
        MPI_Allreduce(MPI_IN_PLACE, raise_.data() + first, count, MPI_DOUBLE, MPI_MAX, comm.raw());
    });
    double squares = 0.0;
    for (std::size_t entry = 0; entry < raise_.size(); ++entry) {
        const double price = 2.0 * lambda_ * row_sums_[entry] + raise_[entry];
        squares += price * price;
    }
    if (squares == 0.0) return 0.0;
    return lambda_ > 0.0 ? squares / (4.0 * lambda_) : std::numeric_limits<double>::infinity();
}

double PaperDualBound::finish(const Comm& comm) {
    sums_.reduce(comm);
    const double raised = sums_.scalar(reconstruction_sum) + raised_cost(comm);
    double row_squares = 0.0;
    for (const double sum : row_sums_) row_squares += sum * sum;
    const double shifted = sums_.scalar(shifted_sum) + lambda_ * row_squares;
    // Each sum has fewer roundings than `terms`, and positive addends only.
    const double terms =
        stack_.dimension * static_cast<double>(coefficient_tile) + static_cast<double>(raise_.size()) + 64.0;
    const double decrease = std::min(raised, shifted) * (1.0 + terms * epsilon);
    const double at_zero = stack_.squared_norm * (1.0 - stack_.inner_product_error());
    return std::max(at_zero - decrease, 0.0);
}

}  // namespace coseg
