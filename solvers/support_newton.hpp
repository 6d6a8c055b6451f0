#pragma once
// Newton's direction on the support of W: what closes scope paper's gap where lambda is small and the columns' Gram
// matrices are ill-conditioned, so that gradient steps alone would need thousands of iterations.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "solvers/column_fit.hpp"
#include "solvers/exact_sum.hpp"
#include "solvers/row_exchange.hpp"
#include "solvers/subspace_problem.hpp"

namespace coseg {

/// Where all weights that are positive stay so the objective is smooth: 2 X^T X of each column, 2 lambda along each row
/// and the curvature of the groups' norms. The system is solved by conjugate gradients, preconditioned with the
/// Cholesky factors of every column's own part; a row couples its columns the less, the smaller lambda.
/// Source: two-metric projection (Bertsekas 1982) with inexact Newton (Dembo, Eisenstat, Steihaug 1982).
class SupportNewton {
  public:
    /// `fits` are the columns of this rank, `offset` the place of each column's values; all must outlive this.
    SupportNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                  const std::vector<ColumnFit>& fits, const std::vector<std::size_t>& offset,
                  RowExchange& exchange);

    /// `weights` >= 0; `fit_gradient`: that of the fit; `row_sums`: of the owned rows, H values of a row together. Pairs by
    /// columns, H values together; 0 where a weight is 0. The same bits on any number of ranks. Collective.
    const std::vector<double>& direction(const std::vector<double>& weights,
                                         const std::vector<double>& fit_gradient,
                                         const std::vector<double>& row_sums);

  private:
    /// The positive weights of one feature of one column.
    struct Block {
        std::vector<std::size_t> places;  ///< into the values
        Eigen::LLT<Eigen::MatrixXd> factor;
        bool factored = false;
        Eigen::VectorXd inverse_diagonal;
    };

    void price_of_rows(const std::vector<double>& row_sums);
    void measure_groups(const std::vector<double>& weights);
    void factor_column(std::size_t c, const std::vector<double>& weights);
    void apply(const std::vector<double>& vector, const std::vector<double>& weights,
               std::vector<double>& result);
    void precondition(const std::vector<double>& vector, std::vector<double>& result) const;
    double inner(const std::vector<double>& a, const std::vector<double>& b);

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const FeatureStack& stack_;
    const std::vector<ColumnFit>& fits_;
    const std::vector<std::size_t>& offset_;
    RowExchange& exchange_;
    std::vector<Block> blocks_;         ///< H a column
    std::vector<double> inverse_norm_;  ///< of each pair's group; 0 where the group is
    std::vector<double> by_row_;
    std::vector<double> row_part_;
    std::vector<double> direction_, residual_, preconditioned_, search_, image_;
    ExactSum sums_;
};

}  // namespace coseg
