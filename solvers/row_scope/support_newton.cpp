#include "solvers/row_scope/support_newton.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "solvers/subspace/tile_sums.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int conjugate_limit = 40;
constexpr double sufficient_residual = 1e-2;  ///< relative; further steps see to the rest
/// A block of more weights than this is scaled by its diagonal alone.
constexpr std::size_t largest_block = 400;
/// Added to a block's diagonal, relative to it: columns that depend on each other would have no factor
/// otherwise.
constexpr double regularization = 1e-11;

}  // namespace

SupportNewton::SupportNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                             const ColumnValues& columns, RowExchange& exchange)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      fits_(columns.fits),
      offset_(columns.offset),
      exchange_(exchange),
      sums_(1) {
    blocks_.resize(fits_.size() * at(stack.features));
    inverse_norm_.resize(offset_.back() / at(stack.features));
}

/// row_part_: by columns, 2 lambda times the sum of the vector over each pair's row.
void SupportNewton::sum_along_rows(const std::vector<double>& vector) {
    const auto features = at(stack_.features);
    exchange_.to_rows(vector, by_row_);
    std::vector<double> sums(features);
    for (std::int64_t r = 0; r < exchange_.owned_rows().size(); ++r) {
        const std::span<double> row = exchange_.row(by_row_, r);
        std::fill(sums.begin(), sums.end(), 0.0);
        for (std::size_t entry = 0; entry < row.size(); ++entry) sums[entry % features] += row[entry];
        for (std::size_t entry = 0; entry < row.size(); ++entry)
            row[entry] = 2.0 * problem_.lambda * sums[entry % features];
    }
    exchange_.to_columns(by_row_, row_part_);
}

void SupportNewton::measure_groups(const std::vector<double>& weights) {
    const auto features = at(stack_.features);
    for (std::size_t p = 0; p < inverse_norm_.size(); ++p) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features; ++h)
            squares += weights[p * features + h] * weights[p * features + h];
        inverse_norm_[p] = squares > 0.0 ? 1.0 / std::sqrt(squares) : 0.0;
    }
}

void SupportNewton::factor_column(std::size_t c, const std::vector<double>& weights, double added) {
    const auto features = at(stack_.features);
    for (std::size_t h = 0; h < features; ++h) {
        Block& block = blocks_[c * features + h];
        block.places.clear();
        block.hessian.resize(0, 0);
        for (std::size_t entry = offset_[c] + h; entry < offset_[c + 1]; entry += features) {
            if (weights[entry] > 0.0) block.places.push_back(entry);
        }
        const auto count = static_cast<Eigen::Index>(block.places.size());
        Eigen::VectorXd curvature(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const std::size_t entry = block.places[at(k)];
            const double along = weights[entry] * inverse_norm_[entry / features];
            curvature[k] =
                2.0 * problem_.lambda + added +
                problem_.alpha * inverse_norm_[entry / features] * std::max(1.0 - along * along, 0.0);
        }
        Eigen::MatrixXd hessian = 2.0 * gram_of(c, h, block.places);
        const Eigen::VectorXd diagonal = (1.0 + regularization) * hessian.diagonal() + curvature;
        block.inverse_diagonal = diagonal.cwiseInverse();
        if (block.places.empty() || block.places.size() > largest_block) continue;
        Eigen::MatrixXd matrix = hessian;
        matrix.diagonal() = diagonal;
        block.factor.compute(matrix);
        if (block.factor.info() == Eigen::Success) block.hessian = std::move(hessian);
    }
}

/// The products x_hi . x_hk of the pairs at `places`. They are taken from the column's own Gram matrix, or
/// computed where it has none.
Eigen::MatrixXd SupportNewton::gram_of(std::size_t c, std::size_t h,
                                       const std::vector<std::size_t>& places) const {
    const auto features = at(stack_.features);
    const RowScopeColumn& fit = fits_[c];
    const auto count = static_cast<Eigen::Index>(places.size());
    const auto pair = [&](Eigen::Index k) { return (places[at(k)] - offset_[c]) / features; };
    Eigen::MatrixXd gram(count, count);
    if (!fit.gram.empty()) {
        for (Eigen::Index k = 0; k < count; ++k) {
            const std::size_t row = pair(k) * (pair(k) + 1) / 2;
            for (Eigen::Index l = 0; l <= k; ++l)
                gram(k, l) = gram(l, k) = fit.gram[(row + pair(l)) * features + h];
        }
        return gram;
    }
    Eigen::MatrixXd columns(stack_.rows_of(static_cast<int>(h)), count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const std::int64_t row = fit.rows[pair(k)];
        std::copy_n(stack_.feature(static_cast<int>(h)) + row * stack_.dimension, columns.rows(),
                    columns.col(k).data());
    }
    gram.noalias() = columns.transpose() * columns;
    return gram;
}

/// result = 2 X^T X vector on the support.
void SupportNewton::apply_fit(const std::vector<double>& vector, std::vector<double>& result) const {
    const auto features = at(stack_.features);
    for (std::size_t c = 0; c < fits_.size(); ++c) {
        const auto* const first = blocks_.data() + c * features;
        if (std::any_of(first, first + features, [](const Block& block) {
                return !block.places.empty() && block.hessian.size() == 0;
            })) {
            apply_gram(stack_, fits_[c], vector.data() + offset_[c], result.data() + offset_[c]);
            for (std::size_t entry = offset_[c]; entry < offset_[c + 1]; ++entry) result[entry] *= 2.0;
            continue;
        }
        for (const Block* block = first; block != first + features; ++block) {
            Eigen::VectorXd part(static_cast<Eigen::Index>(block->places.size()));
            for (Eigen::Index k = 0; k < part.size(); ++k) part[k] = vector[block->places[at(k)]];
            const Eigen::VectorXd product = block->hessian * part;
            for (Eigen::Index k = 0; k < part.size(); ++k) result[block->places[at(k)]] = product[k];
        }
    }
}

/// result = (H + added) vector, 0 off the support; `vector` is 0 there.
void SupportNewton::apply(const std::vector<double>& vector, const std::vector<double>& weights, double added,
                          std::vector<double>& result) {
    const auto features = at(stack_.features);
    sum_along_rows(vector);
    apply_fit(vector, result);
    for (std::size_t p = 0; p < inverse_norm_.size(); ++p) {
        const double inverse = inverse_norm_[p];
        double along = 0.0;
        for (std::size_t entry = p * features; entry < (p + 1) * features; ++entry)
            along += weights[entry] * inverse * vector[entry];
        for (std::size_t entry = p * features; entry < (p + 1) * features; ++entry) {
            const double group =
                problem_.alpha * inverse * (vector[entry] - along * weights[entry] * inverse);
            result[entry] =
                weights[entry] > 0.0 ? result[entry] + row_part_[entry] + group + added * vector[entry] : 0.0;
        }
    }
}

void SupportNewton::precondition(const std::vector<double>& vector, std::vector<double>& result) const {
    std::fill(result.begin(), result.end(), 0.0);
    for (const Block& block : blocks_) {
        Eigen::VectorXd part(static_cast<Eigen::Index>(block.places.size()));
        for (Eigen::Index k = 0; k < part.size(); ++k) part[k] = vector[block.places[at(k)]];
        if (block.hessian.size() > 0) {
            block.factor.solveInPlace(part);
        } else {
            part.array() *= block.inverse_diagonal.array();
        }
        for (Eigen::Index k = 0; k < part.size(); ++k) result[block.places[at(k)]] = part[k];
    }
}

/// Collective.
double SupportNewton::inner(const std::vector<double>& a, const std::vector<double>& b) {
    sums_.clear();
    add_by_tiles<1>(std::ssize(fits_), 0, sums_, [&](std::int64_t c, double* tile) {
        const auto column = at(c);
        for (std::size_t entry = offset_[column]; entry < offset_[column + 1]; ++entry)
            tile[0] += a[entry] * b[entry];
    });
    sums_.reduce(comm_);
    return sums_.scalar(0);
}

const std::vector<double>& SupportNewton::solve(const std::vector<double>& weights,
                                                const std::vector<double>& right_side, double added) {
    measure_groups(weights);
    for (std::size_t c = 0; c < fits_.size(); ++c) factor_column(c, weights, added);
    residual_.resize(weights.size());
    for (std::size_t entry = 0; entry < weights.size(); ++entry)
        residual_[entry] = weights[entry] > 0.0 ? right_side[entry] : 0.0;
    solution_.assign(weights.size(), 0.0);
    preconditioned_.resize(weights.size());
    image_.assign(weights.size(), 0.0);
    precondition(residual_, preconditioned_);
    search_ = preconditioned_;
    double size = inner(residual_, preconditioned_);
    const double enough = sufficient_residual * sufficient_residual * size;
    for (int k = 0; k < conjugate_limit && size > enough; ++k) {
        apply(search_, weights, added, image_);
        const double curvature = inner(search_, image_);
        if (!(curvature > 0.0)) break;
        const double length = size / curvature;
        for (std::size_t entry = 0; entry < weights.size(); ++entry) {
            solution_[entry] += length * search_[entry];
            residual_[entry] -= length * image_[entry];
        }
        precondition(residual_, preconditioned_);
        const double next = inner(residual_, preconditioned_);
        for (std::size_t entry = 0; entry < weights.size(); ++entry)
            search_[entry] = preconditioned_[entry] + next / size * search_[entry];
        size = next;
    }
    return solution_;
}

}  // namespace coseg
