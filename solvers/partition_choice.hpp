#pragma once
// Which of several partitions to take, without labels to compare with.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solvers/patch_links.hpp"

namespace coseg {

/// What speaks for a partition; larger is better in each.
struct PartitionTerms {
    double association = 0.0;  ///< normalised association in the graph that scores
    double concavity =
        0.0;  ///< mean concavity mc along the boundaries between parts, weighted by length; in [0, 1]
    double entropy = 0.0;   ///< -sum p ln p of the parts' mean shares of a mesh's area; in [0, ln parts]
    double evenness = 0.0;  ///< see evenness(); in [-ln parts, 0]
};

struct ChoiceWeights {
    double association = 1.0;
    double concavity = 0.75;
    double entropy = 0.375;
    double evenness = 0.25;
};

/// Length-weighted mean concavity over neighbours of different labels; 0 if no two neighbours differ.
double boundary_concavity(const std::vector<PatchRelation>& neighbors, const std::vector<int>& labels);

/// Per part the mean over meshes of its share of a mesh's area; sums to 1. `patch_area` and `mesh_of` per
/// patch, meshes 0 .. M-1; where a mesh has several over-segmentations each of its faces counts once in each.
std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

double entropy(std::span<const double> shares);

/// Minus the Jensen-Shannon divergence of the meshes' shares: mean entropy of a mesh less the entropy of the mean. 0
/// where every mesh has the parts in the same proportion, -ln parts where the parts are whole meshes.
/// `shares`: parts x meshes, as area_shares gives them.
double evenness(const Eigen::MatrixXd& shares);

/// Share of the (part, mesh) pairs in which the mesh has at least a quarter of the part's mean share; a part without
/// any area is present nowhere. Well below 1 where parts split by shape. `shares` as above.
double presence(const Eigen::MatrixXd& shares);

/// How much partitions of the same patches have in common: mean adjusted Rand index, by area, of each with the
/// others; 1 for a single one.
std::vector<double> agreement(const std::vector<std::vector<int>>& partitions,
                              const std::vector<double>& patch_area);

/// Per partition the weighted sum of its terms, each standardised over all partitions (mean 0, deviation 1; a
/// term that does not vary counts 0). Deviates: the paper makes one cut.
std::vector<double> partition_scores(std::span<const PartitionTerms> partitions,
                                     const ChoiceWeights& weights);

/// The same partition with parts numbered by decreasing mean area share, ties by the lowest patch; labels
/// without a patch come last.
std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

}  // namespace coseg
