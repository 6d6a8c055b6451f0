#pragma once
// Solves Newton's equations on the support of W. This is the linear algebra of row scope where lambda is
// small and the columns' Gram matrices are ill-conditioned, so that gradient steps alone would need thousands
// of iterations.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "solvers/row_scope/row_exchange.hpp"
#include "solvers/subspace/row_scope_column.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

/// The columns of this rank on a working set, and where each column's values begin among those of all.
struct ColumnValues {
    const std::vector<RowScopeColumn>& fits;
    const std::vector<std::size_t>& offset;
};

/// As long as all positive weights stay positive, the objective is smooth. Its Hessian is 2 X^T X of each
/// column, 2 lambda along each row, and the curvature of the groups' norms. The system is solved by conjugate
/// gradients, preconditioned with the Cholesky factors of every column's own part. The smaller lambda is, the
/// less a row couples its columns. Source: inexact Newton (Dembo, Eisenstat, Steihaug 1982).
class SupportNewton {
  public:
    /// All must outlive this.
    SupportNewton(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                  const ColumnValues& columns, RowExchange& exchange);

    /// Solves (objective's Hessian + `added` times the identity) y = `right_side` on the support of
    /// `weights` >= 0. Pairs are ordered by columns, H values together. Where a weight is 0, `right_side` is
    /// not read and y is 0. The result has the same bits on any number of ranks. Collective.
    const std::vector<double>& solve(const std::vector<double>& weights,
                                     const std::vector<double>& right_side, double added);

  private:
    /// The positive weights of one feature of one column.
    struct Block {
        std::vector<std::size_t> places;  ///< into the values
        Eigen::MatrixXd hessian;          ///< 2 X^T X; empty where there is no factor
        Eigen::LLT<Eigen::MatrixXd> factor;
        Eigen::VectorXd inverse_diagonal;
    };

    void measure_groups(const std::vector<double>& weights);
    void factor_column(std::size_t c, const std::vector<double>& weights, double added);
    [[nodiscard]] Eigen::MatrixXd gram_of(std::size_t c, std::size_t h,
                                          const std::vector<std::size_t>& places) const;
    void sum_along_rows(const std::vector<double>& vector);
    void apply_fit(const std::vector<double>& vector, std::vector<double>& result) const;
    void apply(const std::vector<double>& vector, const std::vector<double>& weights, double added,
               std::vector<double>& result);
    void precondition(const std::vector<double>& vector, std::vector<double>& result) const;
    double inner(const std::vector<double>& a, const std::vector<double>& b);

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const FeatureStack& stack_;
    const std::vector<RowScopeColumn>& fits_;
    const std::vector<std::size_t>& offset_;
    RowExchange& exchange_;
    std::vector<Block> blocks_;         ///< H a column
    std::vector<double> inverse_norm_;  ///< of each pair's group; 0 where the group's norm is 0
    std::vector<double> by_row_;
    std::vector<double> row_part_;
    std::vector<double> solution_, residual_, preconditioned_, search_, image_;
    ExactSum sums_;
};

}  // namespace coseg
