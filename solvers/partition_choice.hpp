#pragma once
// Which of several partitions to take, without labels to compare with.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solvers/patch_links.hpp"
#include "solvers/sparse_rows.hpp"
#include "src/comm.hpp"

namespace coseg {

/// What speaks for a partition; larger is better in each.
struct PartitionTerms {
    double association = 0.0;       ///< normalised association in the graph that scores
    double crease = 0.0;            ///< see boundary_crease(); at most 0
    double overlap = 0.0;           ///< see overlap_agreement(); in [0, 1]
    std::vector<double> explained;  ///< per descriptor, see explained_share(); in [0, 1]
    double concavity =
        0.0;  ///< mean concavity mc along the boundaries between parts, weighted by length; in [0, 1]
    double presence = 0.0;  ///< see presence(); in [0, 1]
    double recall = 0.0;    ///< see match_recall(); in [0, 1]
};

/// How the terms are weighed: the first five make a score; among the partitions whose score comes within `margin` of the
/// best, the last three decide together with it.
struct ChoiceWeights {
    double association = 0.4;
    double crease = 1.1;
    double overlap = 1.0;
    double margin = 0.45;  ///< share of the way from the best score down to the median of all
    double score = 1.3;    ///< of the score itself among those within the margin
    double concavity = 1.5;
    double presence = 1.2;
    double recall = 0.6;
};

/// A descriptor whose histograms a good partition should explain.
struct ChoiceDescriptor {
    Eigen::MatrixXf histograms;  ///< bins x N, column major, of any scale
    double weight = 1.0;         ///< of its explained share in the score
};

/// Length-weighted mean concavity over neighbours of different labels; 0 if no two neighbours differ.
double boundary_concavity(const std::vector<PatchRelation>& neighbors, const std::vector<int>& labels);

/// Per part the mean over meshes of its share of a mesh's area; sums to 1. `patch_area` and `mesh_of` per
/// patch, meshes 0 .. M-1; where a mesh has several over-segmentations each of its faces counts once in each.
std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Share of the (part, mesh) pairs in which the mesh has at least a quarter of the part's mean share; a part without
/// any area is present nowhere. Well below 1 where parts split by shape. `shares` as above.
double presence(const Eigen::MatrixXd& shares);

/// Minus the total over boundaries between parts of length (1 - mc)^2, divided by the number of meshes: long boundaries
/// outside creases are dear. `meshes` at least 1.
double boundary_crease(const std::vector<PatchRelation>& neighbors, const std::vector<int>& labels,
                       int meshes);

/// How far the over-segmentations agree on the parts: of each patch the share of its overlaps (by intersection over
/// union) with patches of its own part; mean over patches that overlap any, weighted by area. 1 without overlaps.
double overlap_agreement(const std::vector<OverlapRelation>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area);

/// How often the links between meshes lead to the own part: per part the share of its area in patches whose links weigh
/// more on their own part than on any other; mean over the parts. `links`: this rank's rows of a symmetric affinity
/// between meshes, `labels` 0 .. parts - 1 of all patches. Collective.
double match_recall(const Comm& comm, const SparseRows& links, const std::vector<int>& labels, int parts,
                    const std::vector<double>& patch_area);

/// Which share of the spread of the patches' histograms lies between the parts: sum over parts of a |mean of the part -
/// mean|^2 over sum over patches of a |x - mean|^2, a the patch's area. 0 where all patches are alike. Sums in double.
double explained_share(const Eigen::MatrixXf& histograms, const std::vector<int>& labels, int parts,
                       const std::vector<double>& patch_area);

/// Per partition the weighted sum of its terms of the score, each standardised over all partitions (mean 0, deviation 1; a
/// term that does not vary counts 0). `descriptor_weights`: one for each of PartitionTerms::explained.
std::vector<double> partition_scores(std::span<const PartitionTerms> partitions, const ChoiceWeights& weights,
                                     std::span<const double> descriptor_weights);

/// Which partition to take of those that `eligible` marks (at least one): those whose scores come within the margin of
/// the best make a short list; in it the score counts as it is, and concavity, presence and recall standardised over the list (by at least
/// .15 of their deviation over all partitions, so that near ties stay near). Ties: the first.
/// Deviates: the paper makes one cut.
std::size_t best_partition(std::span<const PartitionTerms> partitions, std::span<const double> scores,
                           const std::vector<bool>& eligible, const ChoiceWeights& weights);

/// The same partition with parts numbered by decreasing mean area share, ties by the lowest patch; labels
/// without a patch come last.
std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

}  // namespace coseg
