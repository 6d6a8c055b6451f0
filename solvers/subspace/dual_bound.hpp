#pragma once
// Lower bounds of the optimum from any W: the certificate behind every relative gap of row scope.
//
// With z = X_h w_hj (any z will do) let u = 2 (x_hj - z), the residual's dual. For any v >= 0,
//     sum_h ( <U_h, X_h> - ||U_h||^2 / 4 - ||v_h||^2 / (4 lambda) )  <=  optimum
// as long as every pair has || (x_hi . u_hj - v_hi - beta)_+ over h ||_2 <= alpha. Where v = 2 lambda W 1
// does not satisfy this, two repairs are tried and the better bound is kept:
//   raise  v_hi is raised to what its worst pair needs (cheap where lambda is large);
//   shift  u_hj becomes u_hj - tau 1, which lowers every x_hi . u_hj since X >= 0 (works for lambda = 0 too).
// Everything is rounded so that the bound stays below the optimum.
//
// Source: Fenchel duality, as in safe screening for the lasso (El Ghaoui, Viallon, Rabbani 2012).

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/subspace/feature_stack.hpp"
#include "src/base/index.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

/// Usage: give the owned columns tile by tile, with every pair that may violate its limit, and then call
/// finish. `stack` and `row_sums` must outlive this.
class PaperDualBound {
  public:
    /// `row_sums`: W_h 1, the H values of a row together. All penalties >= 0.
    PaperDualBound(const FeatureStack& stack, double alpha, double beta, double lambda,
                   const std::vector<double>& row_sums);

    /// Begins the columns first .. first + width, a run of whole coefficient tiles, with their z: D x width
    /// values, which must live until end_tile.
    void begin_tile(int first, int width, const double* reconstruction);

    /// Looks at the pair of row i and the tile's column c (counted from its first), i != first + c. `scores`
    /// are the H values x_hi . u_hj. `rounding` bounds |computed - exact| relative to ||x_hi|| ||u_hj||.
    /// Returns ||(scores - v - beta)_+||_2, without the allowance for rounding. A pair that is left out must
    /// be known to satisfy its limit, rounding included.
    double check_pair(int c, int i, const double* scores, double rounding);

    /// Ends the tiles begun. Each coefficient tile is one addend of the sum, so that bits do not depend on
    /// the ranks.
    void end_tile();

    /// The better one of the two bounds. Collective.
    double finish(const Comm& comm);

    /// An upper bound of ||u_hj|| for the tile's column c.
    [[nodiscard]] double residual_norm(int c, int h) const {
        return residual_norm_[at(c * stack_.features + h)];
    }

  private:
    double raised_cost(const Comm& comm);
    void repair(int c, int i, double norm);

    const FeatureStack& stack_;
    double alpha_;
    double beta_;
    double lambda_;
    const std::vector<double>& row_sums_;
    std::vector<double> raise_;  ///< like row_sums
    int width_ = 0;
    const double* reconstruction_ = nullptr;
    std::vector<double> residual_norm_;  ///< per column of the tile and feature
    std::vector<double> shift_;          ///< likewise
    std::vector<double> excess_;         ///< of the pair at hand
    ExactSum sums_;
};

}  // namespace coseg
