#pragma once
// Which of several partitions to take, without labels to compare with.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// A descriptor that a good partition should explain.
struct ChoiceDescriptor {
    Eigen::MatrixXf histograms;  ///< bins x N, column major, of any scale; or other numbers of a patch
    BetweenPartVariance weight;  ///< of what is explained of it in the score
};

/// What the terms of a partition are found from; the same on all ranks but for `links`.
struct PartitionEvidence {
    const std::vector<GlobalPatchNeighbors>& neighbors;
    const std::vector<GlobalPatchOverlap>& overlaps;
    std::span<const ChoiceDescriptor> descriptors;
    const SparseRows& links;  ///< this rank's rows of the affinity between meshes
    const std::vector<int>& mesh_of;
    const std::vector<double>& patch_area;
};

/// All terms of the partition `labels`, 0 .. parts - 1 per patch. Collective.
PartitionTerms partition_terms(const Comm& comm, const PartitionEvidence& evidence,
                               const std::vector<int>& labels, int parts);

/// Length-weighted mean concavity over neighbours of different labels; 0 if no two neighbours differ.
double boundary_concavity(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels);

/// Per part the mean over meshes of its share of a mesh's area; sums to 1. `patch_area` and `mesh_of` per
/// patch, meshes 0 .. M-1; where a mesh has several over-segmentations each of its faces counts once in each.
std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// Share of the (part, mesh) pairs in which the mesh has at least a quarter of the part's mean share; a part
/// without any area is present nowhere. Well below 1 where parts split by shape. `shares` as above.
double presence(const Eigen::MatrixXd& shares);

/// Minus the total over boundaries between parts of length (1 - mc)^2, divided by the number of meshes: long
/// boundaries outside creases are dear. `meshes` at least 1.
double boundary_crease(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels,
                       int meshes);

/// How far the over-segmentations agree on the parts: of each patch the share of its overlaps (by
/// intersection over union) with patches of its own part; mean over patches that overlap any, weighted by
/// area. 1 without overlaps.
double overlap_agreement(const std::vector<GlobalPatchOverlap>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area);

/// How often the links between meshes lead to the own part: per part the share of its area in patches whose
/// links weigh more on their own part than on any other; mean over the parts. `links`: this rank's rows of a
/// symmetric affinity between meshes, `labels` 0 .. parts - 1 of all patches. Collective.
double link_consistency(const Comm& comm, const SparseRows& links, const std::vector<int>& labels, int parts,
                        const std::vector<double>& patch_area);

/// The spread is the sum over patches of a |x - mean of the mesh|^2, x the histogram and a the area of the
/// patch. `per_mesh` is the share of it in the sum over meshes and parts of a |mean of the part in the mesh -
/// mean of the mesh|^2: parts that differ inside each shape. `pooled` is the share in the sum over parts of a
/// |mean over the part of x - mean of the mesh|^2: parts that differ in the same way in all shapes. What
/// tells shapes apart counts in neither, or a partition by style (round legs, square legs) would seem to
/// explain much. Both 0 where patches of a mesh are all alike. Sums in double, in the order of patches.
BetweenPartVariance between_part_variance(const Eigen::MatrixXf& histograms, const std::vector<int>& labels,
                                          int parts, const std::vector<double>& patch_area,
                                          const std::vector<int>& mesh_of);

/// Per partition the weighted sum of its terms of the score, each standardised over all partitions: mean 0,
/// deviation 1, or less where the deviation is below its least. `descriptor_weights`: one for each of
/// PartitionTerms::explained.
std::vector<double> partition_scores(std::span<const PartitionTerms> partitions, const ChoiceWeights& weights,
                                     std::span<const BetweenPartVariance> descriptor_weights);

/// Which partition to take of those that `eligible` marks (at least one): those whose scores come within the
/// margin of the best make a short list; in it the score counts as it is, and concavity, presence and
/// link_consistency standardised over the list (by at least .15 of their deviation over all partitions, so
/// that near ties stay near). Ties: the first. Deviates: the paper makes one cut.
std::size_t best_partition(std::span<const PartitionTerms> partitions, std::span<const double> scores,
                           const std::vector<bool>& eligible, const ChoiceWeights& weights);

/// The same partition with parts numbered by decreasing mean area share, ties by the lowest patch; labels
/// without a patch come last.
std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

}  // namespace coseg
