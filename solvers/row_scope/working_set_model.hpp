#pragma once
// Row scope on a working set of pairs: the model on which the spectral projected gradient works.
//
// Deviates: in SPG on (6)-(7) the lambda term would be in the smooth part, whose Lipschitz constant 2
// lambda N makes steps tiny. Here the smooth part is the fit alone. The lambda term belongs to the prox,
// which separates over rows and is solved exactly by their owners (row_prox.hpp). Convergence then does not
// depend on lambda.

#include <optional>
#include <vector>

#include "solvers/row_scope/proximal_newton.hpp"
#include "solvers/row_scope/row_exchange.hpp"
#include "solvers/row_scope/row_prox.hpp"
#include "solvers/subspace/row_scope_column.hpp"
#include "solvers/subspace/spectral_projected_gradient.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

/// The columns of this rank, each with its working set.
struct WorkingSet {
    BlockRange columns;
    std::vector<RowScopeColumn> fits;  ///< one a column

    [[nodiscard]] std::int64_t pair_count() const;
};

class WorkingSetModel {
  public:
    /// Starts from the weights in `working`. `prices` holds H values for each row that this rank owns, from
    /// which the prox of the rows starts. Both must outlive this. Collective.
    WorkingSetModel(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                    const WorkingSet& working, std::vector<double>& prices);

    [[nodiscard]] double objective() const noexcept { return current_.objective; }
    TrialPoint propose(double step);
    void accept() { std::swap(current_, trial_); }
    /// Replaces the current point by its proximal point of the given reach, if that is better. Returns the
    /// number of Newton steps taken, or nothing where they did not lead there. Collective.
    std::optional<int> proximal_step(double reach);

    /// A lower bound of the optimum of this working set's own problem. Collective.
    [[nodiscard]] double lower_bound() const;
    /// W_h 1 of all rows, the H values of a row together. Collective.
    [[nodiscard]] std::vector<double> row_sums() const;
    /// Writes the current weights back.
    void store(WorkingSet& working) const;

  private:
    struct Point {
        std::vector<double> weights;   ///< pairs by columns, H values together
        std::vector<double> product;   ///< apply_gram of the weights
        std::vector<double> row_sums;  ///< of the owned rows
        double objective = 0.0;
    };
    void shrink_rows(double step);
    void measure_columns();
    TrialPoint evaluate_forward();
    TrialPoint finish_trial();

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const FeatureStack& stack_;
    const WorkingSet& working_;
    std::vector<double>& prices_;
    std::vector<std::size_t> offset_;  ///< of each column's values
    std::vector<double> linear_;
    RowExchange exchange_;
    RowProx prox_;
    ProximalNewton proximal_;
    Point current_;
    Point trial_;
    std::vector<double> forward_;  ///< W - step G
    std::vector<double> by_row_;
    ExactSum sums_;
};

}  // namespace coseg
