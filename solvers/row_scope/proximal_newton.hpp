#pragma once
// The proximal point method with semismooth Newton steps inside. It closes row scope's gap where lambda is
// small and W reconstructs most of X. There, gradient steps need thousands of iterations, and Newton steps on
// a guessed support get stuck.

#include <vector>

#include "solvers/row_scope/row_exchange.hpp"
#include "solvers/row_scope/row_prox.hpp"
#include "solvers/row_scope/support_newton.hpp"
#include "solvers/subspace/row_scope_column.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

struct ProximalPoint {
    const std::vector<double>& weights;  ///< W >= 0, until the next call
    int newton_steps = 0;
    bool reached = false;  ///< whether the accuracy asked for was reached
};

/// Finds the minimum over W >= 0 of the objective + ||W - centre||^2 / (2 reach) on the pairs of a working
/// set.
///
/// The dual of this problem is smooth and concave in one vector per column. The vector is written here as the
/// residual 2 (X V - X) of some V of any sign:
///     ||X||^2 - <V, G V> + 2 <G V - X^T X, W> + penalties(W) + ||W - centre||^2 / (2 reach),    G = X^T X,
///     W = prox of the penalties at centre - 2 reach (G V - X^T X),
/// with the gradient X W - X V. Newton's equations reduce to those on the support of W (support_newton.hpp).
/// A full step takes V to W plus their solution, so that the prox decides what the support becomes, and
/// nothing has to be cut off at 0.
///
/// Source: Li, Sun, Toh, "A highly efficient semismooth Newton augmented Lagrangian method for solving
/// lasso problems", SIAM J. Optim. 2018, with the prox of this problem's rows.
class ProximalNewton {
  public:
    /// `linear`: X^T X of the columns' pairs. All must outlive this.
    ProximalNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                   const ColumnValues& columns, const std::vector<double>& linear, RowExchange& exchange);

    /// Pairs are ordered by columns, H values together. `centre_product` = G centre. `prices` belong to the
    /// owned rows, and their prox starts from them. The result has the same bits on any number of ranks.
    /// Collective.
    ProximalPoint minimise(const std::vector<double>& centre, const std::vector<double>& centre_product,
                           double reach, std::vector<double>& prices);

  private:
    /// V and the W that belongs to it.
    struct Point {
        std::vector<double> dual;          ///< V
        std::vector<double> dual_product;  ///< G V
        std::vector<double> weights;       ///< W
        std::vector<double> product;       ///< G W
        double value = 0.0;                ///< of the dual
        double gradient2 = 0.0;            ///< ||X W - X V||^2
        double distance2 = 0.0;            ///< ||W - centre||^2
    };

    void apply(const std::vector<double>& vector, std::vector<double>& product) const;
    void evaluate(Point& point, const std::vector<double>& centre, double reach, std::vector<double>& prices);
    void shrink_rows(double reach, std::vector<double>& prices);
    void differentiate(Point& point);
    template <class Add>
    void sum_values(Add&& add);
    double find_direction(double reach);
    bool step_along_direction(const std::vector<double>& centre, double reach, double slope,
                              std::vector<double>& prices);

    const Comm& comm_;
    const FeatureStack& stack_;
    const std::vector<RowScopeColumn>& fits_;
    const std::vector<std::size_t>& offset_;
    const std::vector<double>& linear_;
    RowExchange& exchange_;
    RowProx prox_;
    SupportNewton newton_;
    Point current_, trial_;
    std::vector<double> direction_;          ///< of V
    std::vector<double> direction_product_;  ///< G direction
    std::vector<double> forward_;            ///< by columns
    std::vector<double> by_row_;
    ExactSum sums_;
};

}  // namespace coseg
