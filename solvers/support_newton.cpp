#include "solvers/support_newton.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/coefficients.hpp"

namespace coseg {

namespace {

constexpr int conjugate_limit = 40;
constexpr double sufficient_residual = 1e-2;  ///< relative; further steps see to the rest
/// A block of more weights than this is scaled by its diagonal alone.
constexpr std::size_t largest_block = 400;
/// Added to a block's diagonal, relative: columns that depend on each other have no factor otherwise.
constexpr double regularization = 1e-11;

}  // namespace

SupportNewton::SupportNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                             const std::vector<ColumnFit>& fits, const std::vector<std::size_t>& offset,
                             RowExchange& exchange)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      fits_(fits),
      offset_(offset),
      exchange_(exchange),
      sums_(0, 1.0, 1) {
    blocks_.resize(fits.size() * static_cast<std::size_t>(stack.features));
    inverse_norm_.resize(offset.back() / static_cast<std::size_t>(stack.features));
}

/// row_part_: by columns, 2 lambda times the sum of each pair's row.
void SupportNewton::price_of_rows(const std::vector<double>& row_sums) {
    const auto features = static_cast<std::size_t>(stack_.features);
    const std::int64_t rows = exchange_.owned_rows().size();
    by_row_.resize(exchange_.row_begin(rows) * features);
    for (std::int64_t r = 0; r < rows; ++r) {
        for (std::size_t p = exchange_.row_begin(r); p < exchange_.row_begin(r + 1); ++p) {
            for (std::size_t h = 0; h < features; ++h) {
                by_row_[p * features + h] =
                    2.0 * problem_.lambda * row_sums[static_cast<std::size_t>(r) * features + h];
            }
        }
    }
    exchange_.to_columns(by_row_, row_part_);
}

void SupportNewton::measure_groups(const std::vector<double>& weights) {
    const auto features = static_cast<std::size_t>(stack_.features);
    for (std::size_t p = 0; p < inverse_norm_.size(); ++p) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features; ++h)
            squares += weights[p * features + h] * weights[p * features + h];
        inverse_norm_[p] = squares > 0.0 ? 1.0 / std::sqrt(squares) : 0.0;
    }
}

void SupportNewton::factor_column(std::size_t c, const std::vector<double>& weights) {
    const auto features = static_cast<std::size_t>(stack_.features);
    for (std::size_t h = 0; h < features; ++h) {
        Block& block = blocks_[c * features + h];
        block.places.clear();
        block.factored = false;
        for (std::size_t at = offset_[c] + h; at < offset_[c + 1]; at += features) {
            if (weights[at] > 0.0) block.places.push_back(at);
        }
        const auto count = static_cast<Eigen::Index>(block.places.size());
        Eigen::MatrixXd columns(stack_.rows_of(static_cast<int>(h)), count);
        Eigen::VectorXd curvature(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const std::size_t at = block.places[static_cast<std::size_t>(k)];
            const int row = fits_[c].rows[(at - offset_[c]) / features];
            std::copy_n(
                stack_.feature(static_cast<int>(h)) + static_cast<std::int64_t>(row) * stack_.dimension,
                columns.rows(), columns.col(k).data());
            const double along = weights[at] * inverse_norm_[at / features];
            curvature[k] = 2.0 * problem_.lambda +
                           problem_.alpha * inverse_norm_[at / features] * std::max(1.0 - along * along, 0.0);
        }
        const Eigen::VectorXd diagonal =
            (2.0 + regularization) * columns.colwise().squaredNorm().transpose() + curvature;
        block.inverse_diagonal = diagonal.cwiseInverse();
        if (block.places.empty() || block.places.size() > largest_block) continue;
        Eigen::MatrixXd matrix = 2.0 * columns.transpose() * columns;
        matrix.diagonal() = diagonal;
        block.factor.compute(matrix);
        block.factored = block.factor.info() == Eigen::Success;
    }
}

/// result = H vector, 0 off the support; `vector` is 0 there.
void SupportNewton::apply(const std::vector<double>& vector, const std::vector<double>& weights,
                          std::vector<double>& result) {
    const auto features = static_cast<std::size_t>(stack_.features);
    exchange_.to_rows(vector, by_row_);
    std::vector<double> row_sums(static_cast<std::size_t>(exchange_.owned_rows().size()) * features, 0.0);
    for (std::int64_t r = 0; r < exchange_.owned_rows().size(); ++r) {
        for (std::size_t p = exchange_.row_begin(r); p < exchange_.row_begin(r + 1); ++p) {
            for (std::size_t h = 0; h < features; ++h)
                row_sums[static_cast<std::size_t>(r) * features + h] += by_row_[p * features + h];
        }
    }
    price_of_rows(row_sums);
    for (std::size_t c = 0; c < fits_.size(); ++c)
        apply_gram(stack_, fits_[c], vector.data() + offset_[c], result.data() + offset_[c]);
    for (std::size_t p = 0; p < inverse_norm_.size(); ++p) {
        const double inverse = inverse_norm_[p];
        double along = 0.0;
        for (std::size_t at = p * features; at < (p + 1) * features; ++at)
            along += weights[at] * inverse * vector[at];
        for (std::size_t at = p * features; at < (p + 1) * features; ++at) {
            const double group = problem_.alpha * inverse * (vector[at] - along * weights[at] * inverse);
            result[at] = weights[at] > 0.0 ? 2.0 * result[at] + row_part_[at] + group : 0.0;
        }
    }
}

void SupportNewton::precondition(const std::vector<double>& vector, std::vector<double>& result) const {
    std::fill(result.begin(), result.end(), 0.0);
    for (const Block& block : blocks_) {
        Eigen::VectorXd part(static_cast<Eigen::Index>(block.places.size()));
        for (Eigen::Index k = 0; k < part.size(); ++k)
            part[k] = vector[block.places[static_cast<std::size_t>(k)]];
        if (block.factored) {
            block.factor.solveInPlace(part);
        } else {
            part.array() *= block.inverse_diagonal.array();
        }
        for (Eigen::Index k = 0; k < part.size(); ++k)
            result[block.places[static_cast<std::size_t>(k)]] = part[k];
    }
}

/// A coefficient tile is one addend, so that bits do not depend on the ranks. Collective.
double SupportNewton::inner(const std::vector<double>& a, const std::vector<double>& b) {
    sums_.clear();
    double tile = 0.0;
    for (std::size_t c = 0; c < fits_.size(); ++c) {
        for (std::size_t at = offset_[c]; at < offset_[c + 1]; ++at) tile += a[at] * b[at];
        if ((c + 1) % coefficient_tile != 0 && c + 1 != fits_.size()) continue;
        sums_.add_scalar(0, tile);
        tile = 0.0;
    }
    sums_.reduce(comm_);
    return sums_.scalar(0);
}

const std::vector<double>& SupportNewton::direction(const std::vector<double>& weights,
                                                    const std::vector<double>& fit_gradient,
                                                    const std::vector<double>& row_sums) {
    const auto features = static_cast<std::size_t>(stack_.features);
    measure_groups(weights);
    for (std::size_t c = 0; c < fits_.size(); ++c) factor_column(c, weights);
    price_of_rows(row_sums);
    residual_.assign(weights.size(), 0.0);
    for (std::size_t at = 0; at < weights.size(); ++at) {
        if (weights[at] <= 0.0) continue;
        const double group = problem_.alpha * weights[at] * inverse_norm_[at / features];
        residual_[at] = -(fit_gradient[at] + row_part_[at] + problem_.beta + group);
    }
    direction_.assign(weights.size(), 0.0);
    preconditioned_.assign(weights.size(), 0.0);
    image_.assign(weights.size(), 0.0);
    precondition(residual_, preconditioned_);
    search_ = preconditioned_;
    double size = inner(residual_, preconditioned_);
    const double enough = sufficient_residual * sufficient_residual * size;
    for (int k = 0; k < conjugate_limit && size > enough; ++k) {
        apply(search_, weights, image_);
        const double curvature = inner(search_, image_);
        if (!(curvature > 0.0)) break;
        const double length = size / curvature;
        for (std::size_t at = 0; at < weights.size(); ++at) {
            direction_[at] += length * search_[at];
            residual_[at] -= length * image_[at];
        }
        precondition(residual_, preconditioned_);
        const double next = inner(residual_, preconditioned_);
        for (std::size_t at = 0; at < weights.size(); ++at)
            search_[at] = preconditioned_[at] + next / size * search_[at];
        size = next;
    }
    return direction_;
}

}  // namespace coseg
