#pragma once
// The result of cutting the patches of a collection into parts.

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/records/part_count.hpp"
#include "src/records/part_tree.hpp"
#include "src/records/position_frame.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

struct CutResult {
    std::vector<int> part_of_patch;  ///< 0 .. parts - 1, by decreasing mean area share; the same on all ranks
    std::vector<double> part_share;  ///< mean over meshes of the part's share of area
    /// The number of meshes in which the part occurs; a small one is a warning sign.
    std::vector<int> meshes_with_part;
    /// The probability that the part of a patch is right (solvers/partition/part_confidence.hpp); empty where
    /// the partition was not chosen from several starts.
    std::vector<double> confidence;
    /// K x N: how well each part suits each patch (solvers/partition/part_scores.hpp); empty where the
    /// partition was not chosen from several starts.
    Eigen::MatrixXf scores;
    PartTree tree;  ///< empty unless levels were asked for
    std::vector<PartCountFigures>
        part_counts;                   ///< by falling merit; empty where the number of parts was given
    std::vector<StartOutcome> starts;  ///< in the order in which they were asked for
    int starts_left_out = 0;  ///< which a sample of the meshes showed not to win, and which have no outcome
    /// of the chosen start's graph, descending, one for each of its clusters.
    std::vector<double> eigenvalues;
    /// norms of the residuals of their eigenvectors, as the solver estimates them; 0 where they are known.
    std::vector<double> residuals;
    PositionFrame frame;  ///< of the base; without correlation where no start is placed
    int chosen = 0;       ///< the start taken: best_partition of those with the most parts
    static constexpr auto fields() {
        return std::tuple(
            field("part_of_patch", &CutResult::part_of_patch, Storage::compressed),
            field("confidence", &CutResult::confidence, Storage::compressed),
            field("scores", &CutResult::scores, Storage::compressed),
            field("part_share", &CutResult::part_share), field("tree", &CutResult::tree),
            field("part_counts", &CutResult::part_counts),
            field("meshes_with_part", &CutResult::meshes_with_part), field("starts", &CutResult::starts),
            field("starts_left_out", &CutResult::starts_left_out),
            field("eigenvalues", &CutResult::eigenvalues), field("residuals", &CutResult::residuals),
            field("positions", &CutResult::frame), field("chosen", &CutResult::chosen));
    }
};

}  // namespace coseg
