#pragma once
// Chooses one of several partitions without labels to compare with.

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
    BetweenPartVariance weight;  ///< weights of its explained shares in the score
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

/// The length-weighted mean concavity over neighbours of different labels; 0 if no two neighbours differ.
double boundary_concavity(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels);

/// For each part the mean over meshes of its share of a mesh's area; the sum is 1. `patch_area` and `mesh_of`
/// are per patch, with meshes 0 .. M-1. Where a mesh has several over-segmentations, each of its faces counts
/// once in each.
std::vector<double> mean_area_shares(const std::vector<int>& labels, int parts,
                                     const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

/// The share of the (part, mesh) pairs in which the mesh has at least a quarter of the part's mean share. A
/// part without any area is present nowhere. The share is well below 1 where parts split by shape. `shares`
/// as above.
double presence(const Eigen::MatrixXd& shares);

/// Minus the total of length (1 - mc)^2 over the boundaries between parts, divided by the number of meshes:
/// long boundaries outside creases are costly. `meshes` is at least 1.
double boundary_crease(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels,
                       int meshes);

/// How far the over-segmentations agree on the parts. For each patch it is the share of its overlaps (by
/// intersection over union) with patches of its own part; the value is the mean over patches that overlap
/// any, weighted by area. 1 without overlaps.
double overlap_agreement(const std::vector<GlobalPatchOverlap>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area);

/// How often the links between meshes lead to the same part. For each part it is the share of its area in
/// patches whose links weigh more on their own part than on any other; the value is the mean over the parts.
/// `links` are this rank's rows of a symmetric affinity between meshes, `labels` 0 .. parts-1 of all patches.
/// Collective.
double link_consistency(const Comm& comm, const SparseRows& links, const std::vector<int>& labels, int parts,
                        const std::vector<double>& patch_area);

/// The spread is the sum over patches of a |x - mean of the mesh|^2, where x is the histogram and a the area
/// of the patch.
/// - `per_mesh` is the share of it in the sum over meshes and parts of a |mean of the part in the mesh - mean
///   of the mesh|^2: parts that differ inside each shape.
/// - `pooled` is the share in the sum over parts of a |mean over the part of x - mean of the mesh|^2: parts
///   that differ in the same way in all shapes.
/// What tells shapes apart counts in neither. Otherwise a partition by style (round legs, square legs) would
/// seem to explain much. Both are 0 where the patches of each mesh are all alike. Sums are in double, in the
/// order of patches.
BetweenPartVariance between_part_variance(const Eigen::MatrixXf& histograms, const std::vector<int>& labels,
                                          int parts, const std::vector<double>& patch_area,
                                          const std::vector<int>& mesh_of);

/// For each partition the weighted sum of its terms of the score, each standardised over all partitions to
/// mean 0 and deviation 1. The deviation becomes less than 1 where it is below its least.
/// `descriptor_weights`: one for each of PartitionTerms::explained.
std::vector<double> partition_scores(std::span<const PartitionTerms> partitions, const ChoiceWeights& weights,
                                     std::span<const BetweenPartVariance> descriptor_weights);

/// The best partition of those that `eligible` marks (at least one). Those whose scores come within the
/// margin of the best make a short list. In the list the score counts as it is, and concavity, presence and
/// link_consistency are standardised over the list (by at least .15 of their deviation over all partitions,
/// so that near ties stay near). Of equal ones the first is taken. Deviates: the paper makes one cut.
std::size_t best_partition(std::span<const PartitionTerms> partitions, std::span<const double> scores,
                           const std::vector<bool>& eligible, const ChoiceWeights& weights);

/// The same partition with parts numbered by decreasing mean area share, of equal ones by the lowest patch.
/// Labels without a patch come last.
std::vector<int> canonical_labels(const std::vector<int>& labels, int parts,
                                  const std::vector<double>& patch_area, const std::vector<int>& mesh_of);

}  // namespace coseg
