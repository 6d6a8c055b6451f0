#include "solvers/partition/best_matches.hpp"

#include <algorithm>
#include <cstddef>

namespace coseg {

namespace {

using Eigen::Index;

/// First patch of each mesh, and the number of patches at the end.
std::vector<Index> mesh_starts(const std::vector<int>& mesh_of) {
    std::vector<Index> starts;
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        if (i == 0 || mesh_of[i] != mesh_of[i - 1]) starts.push_back(static_cast<Index>(i));
    }
    starts.push_back(static_cast<Index>(mesh_of.size()));
    return starts;
}

void append_best_of_each_mesh(const Eigen::MatrixXd& similarity, Index column, Index own,
                              const std::vector<Index>& starts, SparseCoefficients& matches) {
    for (std::size_t m = 0; m + 1 < starts.size(); ++m) {
        if (starts[m] <= own && own < starts[m + 1]) continue;
        Index best = 0;
        const double value =
            similarity.col(column).segment(starts[m], starts[m + 1] - starts[m]).maxCoeff(&best);
        if (value <= 0.0) continue;
        matches.rows.push_back(static_cast<int>(starts[m] + best));
        matches.values.push_back(value);
    }
}

}  // namespace

SparseCoefficients best_matches(const Comm& comm, const std::vector<Eigen::MatrixXd>& features,
                                const std::vector<int>& mesh_of) {
    SparseCoefficients matches;
    matches.size = static_cast<std::int64_t>(mesh_of.size());
    matches.columns = block_range(matches.size, comm.size(), comm.rank(), coefficient_tile);
    matches.features = 1;
    matches.offsets.assign(1, 0);
    const std::vector<Index> starts = mesh_starts(mesh_of);
    for (auto tile = matches.columns.begin; tile < matches.columns.end; tile += coefficient_tile) {
        const Index width = std::min(coefficient_tile, matches.columns.end - tile);
        Eigen::MatrixXd similarity = Eigen::MatrixXd::Zero(matches.size, width);
        for (const Eigen::MatrixXd& x : features)
            similarity.noalias() += x.transpose() * x.middleCols(tile, width);
        for (Index c = 0; c < width; ++c) {
            append_best_of_each_mesh(similarity, c, tile + c, starts, matches);
            matches.offsets.push_back(static_cast<std::int64_t>(matches.rows.size()));
        }
    }
    return matches;
}

}  // namespace coseg
