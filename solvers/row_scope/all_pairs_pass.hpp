#pragma once
// Row scope's pass over all N^2 pairs. It gives a lower bound of the optimum and the pairs that must enter
// the working set.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/row_scope/working_set_model.hpp"
#include "solvers/subspace/dual_bound.hpp"
#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/pair_scorer.hpp"
#include "solvers/subspace/panel_columns.hpp"
#include "solvers/subspace/solve_result.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The findings of a pass.
struct PassFindings {
    double lower_bound = 0.0;
    std::vector<std::vector<int>> entering;  ///< per owned column: rows that violate optimality, ascending
    std::int64_t entering_pairs = 0;         ///< all ranks
};

/// Scores are matrix products in single precision (pair_scorer.hpp). Pairs too close to their limit for
/// that are computed again in double precision, so that the bound holds under rounding. Nothing of size N^2
/// is stored.
///
/// Of the violating pairs, the `kept` worst of each row and of each column enter.
class AllPairsPass {
  public:
    static constexpr int kept = 8;

    /// Collective.
    AllPairsPass(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                 const PairScorerFactory& scorer);

    ~AllPairsPass();
    AllPairsPass(const AllPairsPass&) = delete;
    AllPairsPass& operator=(const AllPairsPass&) = delete;

    /// The pass at W = 0. It looks for the pairs with the largest gradient. The bound is that of W = 0 if
    /// there are none, else 0.
    PassFindings first(const WorkingSet& working);
    /// The pass at the weights of the working set, whose row sums are given (H values of a row together).
    /// Collective, like first.
    PassFindings run(const WorkingSet& working, const std::vector<double>& row_sums);

    [[nodiscard]] const PassCost& cost() const noexcept { return cost_; }

  private:
    struct Candidate {
        double score = 0.0;
        std::int64_t place = -1;  ///< the column of a row's candidate, or the row of a column's
    };
    struct Tile;
    struct ScoredPanel;

    static bool better(const Candidate& a, const Candidate& b);
    static void insert(Candidate* best, const Candidate& candidate);
    static void merge_blocks(void* in, void* inout, int* count, MPI_Datatype* type);

    void start(const WorkingSet& working, const std::vector<double>& row_sums);
    void start_tile(const WorkingSet& working, std::int64_t begin, Tile& tile) const;
    void set_column(Tile& tile, int column) const;
    template <class Look>
    void for_each_scored_panel(Tile& tile, const Look& look);
    void check_working_pairs(const Tile& tile, PaperDualBound& bound);
    void look_first(Tile& tile, const ScoredPanel& panel);
    void scan(Tile& tile, const ScoredPanel& panel, PaperDualBound& bound);
    void inspect_pair(const Tile& tile, const ScoredPanel& panel, int column, int row, PaperDualBound& bound);
    void exact_scores(const Tile& tile, int column, int row);
    void keep(const Tile& tile, int column, int row, double norm);
    void merge_row_candidates();
    std::int64_t sum_over_ranks(std::int64_t local);
    double finish(PaperDualBound& bound);
    PassFindings collect(const WorkingSet& working, double lower_bound);

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const FeatureStack& stack_;
    float limit2_;     ///< alpha^2, rounded down: a square above it may be a violation
    double rounding_;  ///< of a score, relative to its factors' norms
    PanelColumns panels_;
    std::unique_ptr<PairScorer> scorer_;
    std::vector<double> largest_norm_;  ///< per feature
    std::vector<double> row_sums_;
    std::size_t padded_rows_;        ///< in whole panels
    std::vector<float> low_prices_;  ///< H times padded_rows_ together: v + beta, rounded down
    std::vector<Candidate> row_best_;
    std::vector<Candidate> column_best_;  ///< of the owned columns
    std::vector<float> row_least_;        ///< square of the least score kept of each row, padded
    std::unique_ptr<Tile> tile_;          ///< kept because its arrays are used again
    std::vector<double> pair_scores_;     ///< of the pair that is being looked at
    bool any_violation_ = false;
    PassCost cost_;
};

}  // namespace coseg
