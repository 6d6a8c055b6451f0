#pragma once
// The proximal map (prox) of row scope's penalties on one row of W, the squared row sums included.

#include <span>
#include <vector>

namespace coseg {

/// argmin over w >= 0 of
///   sum_j ||w_j - v_j||^2 / 2 + step ( lambda sum_h (sum_j w_hj)^2 + alpha sum_j ||w_j||_2 + beta sum w )
/// for the pairs j of one row. At the optimum w_j = shrink_group(v_j - step p) with the price p = 2 lambda
/// sum_j w_j, H numbers, found by a damped Newton method on the dual, which is convex and H-dimensional.
/// Source: the dual of the infimal convolution; Newton with Armijo steps (Bertsekas 1999).
class RowProx {
  public:
    RowProx(int features, double alpha, double beta, double lambda);

    /// `v` holds the row's pairs, H values together, and becomes w. `price` holds H values, the first guess
    /// of p, and becomes p. Serial; the bits depend on the arguments alone.
    void shrink(std::span<double> v, double step, std::span<double> price);

    /// The penalties of one row w, pairs as in shrink(); `sums` become sum_j w_j, H values.
    double penalty(std::span<const double> w, std::span<double> sums) const;

  private:
    void evaluate(std::span<const double> v, double step, std::span<const double> price);
    void add_pair(const double* v, double step, std::span<const double> price);
    void add_curvature(double norm, double step);
    bool solve_direction();
    void apply(std::span<double> v, double step, std::span<const double> price) const;

    std::size_t features_;
    double alpha_;
    double beta_;
    double lambda_;
    double dual_ = 0.0;              ///< the dual function at the price last evaluated
    std::vector<double> slope_;      ///< its gradient, p / (2 lambda) - sum_j w_j
    std::vector<double> curvature_;  ///< its generalised Hessian, H x H
    std::vector<double> excess_;     ///< (v_j - step (p + beta))_+ of the current pair
    std::vector<double> direction_;
    std::vector<double> trial_price_;
};

}  // namespace coseg
