#include "src/metrics/assignment.hpp"

#include <limits>

namespace coseg {
namespace {

constexpr int nobody = -1;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A minimum-cost matching of a growing set of rows, with dual prices: cost(r, c) - row_price(r) -
/// column_price(c) is never negative, and zero on matched pairs.
struct Matching {
    explicit Matching(const Eigen::MatrixXd& costs)
        : cost(costs),
          row_price(Eigen::VectorXd::Zero(costs.rows())),
          column_price(Eigen::VectorXd::Zero(costs.cols())),
          row_of(costs.cols(), nobody),
          column_of(costs.rows(), nobody) {}

    [[nodiscard]] double reduced_cost(int row, int column) const {
        return cost(row, column) - row_price(row) - column_price(column);
    }

    const Eigen::MatrixXd& cost;  ///< rows <= columns
    Eigen::VectorXd row_price;
    Eigen::VectorXd column_price;
    std::vector<int> row_of;     ///< per column its row, or nobody
    std::vector<int> column_of;  ///< per row its column, or nobody
};

/// Shortest alternating paths from one unmatched row, until they reach a column that is free.
struct PathTree {
    explicit PathTree(int columns)
        : distance(columns, infinity), from_row(columns, nobody), settled(columns, false) {}

    std::vector<double> distance;
    std::vector<int> from_row;  ///< the row before each column on its path
    std::vector<bool> settled;
    int free_column = nobody;  ///< where the shortest path ends
};

int nearest_unsettled(const PathTree& tree) {
    int nearest = nobody;
    for (int column = 0; column < static_cast<int>(tree.distance.size()); ++column) {
        if (tree.settled[column]) continue;
        if (nearest == nobody || tree.distance[column] < tree.distance[nearest]) nearest = column;
    }
    return nearest;
}

PathTree shortest_paths(const Matching& matching, int start_row) {
    const int columns = static_cast<int>(matching.cost.cols());
    PathTree tree(columns);
    int row = start_row;
    double travelled = 0.0;
    while (true) {
        for (int column = 0; column < columns; ++column) {
            const double candidate = travelled + matching.reduced_cost(row, column);
            if (tree.settled[column] || candidate >= tree.distance[column]) continue;
            tree.distance[column] = candidate;
            tree.from_row[column] = row;
        }
        const int column = nearest_unsettled(tree);
        if (matching.row_of[column] == nobody) {
            tree.free_column = column;
            return tree;
        }
        tree.settled[column] = true;
        travelled = tree.distance[column];
        row = matching.row_of[column];
    }
}

/// Prices under which every pair on the tree's paths, hence the new matching, has reduced cost zero.
void update_prices(Matching& matching, const PathTree& tree, int start_row) {
    const double length = tree.distance[tree.free_column];
    matching.row_price(start_row) += length;
    for (int column = 0; column < static_cast<int>(tree.settled.size()); ++column) {
        if (!tree.settled[column]) continue;
        const double slack = length - tree.distance[column];
        matching.column_price(column) -= slack;
        matching.row_price(matching.row_of[column]) += slack;
    }
}

void augment(Matching& matching, const PathTree& tree, int start_row) {
    int column = tree.free_column;
    while (true) {
        const int row = tree.from_row[column];
        matching.row_of[column] = row;
        std::swap(matching.column_of[row], column);
        if (row == start_row) return;
    }
}

std::vector<int> cheapest_columns(const Eigen::MatrixXd& cost) {
    Matching matching(cost);
    for (int row = 0; row < cost.rows(); ++row) {
        const PathTree tree = shortest_paths(matching, row);
        update_prices(matching, tree, row);
        augment(matching, tree, row);
    }
    return matching.column_of;
}

}  // namespace

std::vector<int> best_assignment(const Eigen::MatrixXd& gain) {
    if (gain.rows() <= gain.cols()) return cheapest_columns(-gain);
    const std::vector<int> row_of = cheapest_columns(-gain.transpose());
    std::vector<int> column_of(gain.rows(), nobody);
    for (int column = 0; column < static_cast<int>(row_of.size()); ++column)
        column_of[row_of[column]] = column;
    return column_of;
}

}  // namespace coseg
