#pragma once
// Mesh scope's pass over all allowed pairs of some columns. It tells which pairs must enter their working
// sets and how much their objective can still decrease.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "solvers/mesh_scope/mesh_scope_column.hpp"
#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/pair_scorer.hpp"
#include "solvers/subspace/panel_columns.hpp"

namespace coseg {

/// The columns sorted by mesh, so that the patches of a mesh follow one another: group g of rows is
/// group_begin[g] .. group_begin[g + 1].
struct MeshOrder {
    std::vector<int> order;        ///< the patch of the problem at each sorted place, ascending within a mesh
    std::vector<int> place;        ///< its inverse
    std::vector<int> group_begin;  ///< groups + 1
    std::vector<int> group_mesh;   ///< ascending
    std::vector<int> group_of;     ///< of each sorted place
};
MeshOrder sort_by_mesh(const std::vector<int>& mesh_of);

/// The two best pairs of a group that are not in the column's working set, by ||(x_hi . u_hj - beta)_+||.
struct GroupLeaders {
    int row[2] = {-1, -1};
    double norm[2] = {0.0, 0.0};
};

/// The findings of a pass for one column.
struct ColumnVerdict {
    std::vector<GroupLeaders> leaders;  ///< per group; without the working set's rows
    /// No W decreases the column's objective by more than this; rounding is allowed for.
    double largest_decrease = std::numeric_limits<double>::infinity();
};

/// A column as the pass needs it.
struct PassColumn {
    const WorkingColumn* working = nullptr;
    const double* reconstruction = nullptr;  ///< z = X w, D values
    std::vector<double> group_sums;          ///< per group of rows: s_g
};

/// Scores all rows of the groups `allowed` (ascending) against the columns, except the own group of a column.
/// Single precision finds the same answers as double precision, with a wider allowance for rounding.
class MeshScopePass {
  public:
    /// `stack`: in the order of `meshes`. Collective; the rest is not.
    MeshScopePass(const Comm& comm, const FeatureStack& stack, const MeshOrder& meshes,
                  const ColumnPenalties& penalties, const PairScorerFactory& scorer);

    std::vector<ColumnVerdict> single_precision(const std::vector<PassColumn>& columns,
                                                const std::vector<int>& allowed);
    std::vector<ColumnVerdict> double_precision(const std::vector<PassColumn>& columns,
                                                const std::vector<int>& allowed);

  private:
    struct Survey;
    template <class Real>
    struct Scores;
    [[nodiscard]] std::vector<Survey> start_surveys(const std::vector<PassColumn>& columns, double rounding,
                                                    Eigen::MatrixXd& duals) const;
    void score_panels(std::vector<Survey>& surveys, int group);
    void look_at_panel(std::vector<Survey>& surveys, int group, int panel, int place);
    void score_in_double(std::vector<Survey>& surveys, int group, const Eigen::MatrixXd& duals);
    template <class Real>
    void look_at_row(Survey& survey, int row, double square, const Scores<Real>& scores) const;
    template <class Real>
    void require_shift(Survey& survey, int row, double norm, double limit, const Scores<Real>& scores) const;
    [[nodiscard]] Survey start_survey(const PassColumn& column, double rounding, double* dual) const;
    [[nodiscard]] std::vector<ColumnVerdict> finish_surveys(std::vector<Survey>& surveys) const;
    [[nodiscard]] ColumnVerdict finish_survey(Survey& survey) const;

    const FeatureStack& stack_;
    const MeshOrder& meshes_;
    const ColumnPenalties& penalties_;
    PanelColumns panels_;
    std::unique_ptr<PairScorer> scorer_;
    std::vector<float> prices_;         ///< beta, for every feature and place
    std::vector<double> largest_norm_;  ///< per feature, over all columns
    DualColumns single_duals_;
    PanelScores scores_;
    std::vector<double> exact_scores_;
    std::vector<double> exact_squares_;
};

}  // namespace coseg
