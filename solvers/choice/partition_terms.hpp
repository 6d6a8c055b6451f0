#pragma once
// The terms that speak for a partition, found without labels to compare with, and the score that they make.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "src/histograms/single_precision_features.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// Numbers of all patches, one column each, column major, where they lie: in features or another matrix.
using PatchColumns = SinglePrecisionFeatures::ConstBlock;

/// All columns of a matrix in single precision, which must outlive the result.
template <class Matrix>
PatchColumns patch_columns(const Matrix& matrix) {
    return {matrix.data(), matrix.rows(), matrix.cols(), Eigen::OuterStride<>(matrix.rows())};
}

/// A descriptor that a good partition should explain.
struct ChoiceDescriptor {
    PatchColumns histograms;     ///< bins x N, of any scale; or other numbers of a patch
    BetweenPartVariance weight;  ///< weights of its explained shares in the score
};

/// What the terms of a partition are found from.
struct PartitionEvidence {
    const std::vector<GlobalPatchNeighbors>& neighbors;
    const std::vector<GlobalPatchOverlap>& overlaps;
    std::span<const ChoiceDescriptor> descriptors;
    const std::vector<int>& mesh_of;  ///< of each patch, 0 .. M-1
    const std::vector<double>& patch_area;
    /// All rows of the affinity between meshes; none where no node holds them all, and links then do not
    /// count.
    std::optional<SparseRowsView> links = std::nullopt;
};

/// All terms of the partition `labels`, 0 .. parts - 1 per patch.
PartitionTerms partition_terms(const PartitionEvidence& evidence, const std::vector<int>& labels, int parts);

/// The sum of the terms times their weights. The weights of the explained shares are those of `descriptors`,
/// one for each of PartitionTerms::explained. The score does not depend on which other partitions there are.
double partition_score(const PartitionTerms& terms, const ChoiceWeights& weights,
                       std::span<const ChoiceDescriptor> descriptors);

/// The length-weighted mean concavity over neighbours of different labels; 0 if no two neighbours differ.
double boundary_concavity(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels);

/// length (1 - mc)^2 of the boundary between two patches.
double crease_cost(const GlobalPatchNeighbors& pair);

/// For each of `patches` patches the sum of the intersections over union with all that it overlaps.
std::vector<double> overlap_sums(const std::vector<GlobalPatchOverlap>& overlaps, std::size_t patches);

/// Minus the total of length (1 - mc)^2 over the boundaries between parts, divided by the number of meshes:
/// long boundaries outside creases are costly. `meshes` is at least 1.
double boundary_crease(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels,
                       int meshes);

/// How far the over-segmentations agree on the parts. For each patch it is the share of its overlaps (by
/// intersection over union) with patches of its own part; the value is the mean over patches that overlap
/// any, weighted by area. 1 without overlaps.
double overlap_agreement(const std::vector<GlobalPatchOverlap>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area);

/// Minus the sum over parts of the variance over the meshes of the part's share of area, divided by its mean:
/// the parts of shapes of one kind have similar sizes. `shares` as area_shares gives them. A part that one
/// mesh in n has, and nothing of the others, counts as n - 1 times its mean share.
double size_steadiness(const Eigen::MatrixXd& shares);

/// The share of all links between meshes, by weight, that join patches of the same part; 0 without links.
/// `links`: all rows of a symmetric affinity.
double links_inside(const SparseRowsView& links, const std::vector<int>& labels);

/// The spread is the sum over patches of a |x - mean of the mesh|^2, where x is the histogram and a the area
/// of the patch.
/// - `per_mesh` is the share of it in the sum over meshes and parts of a |mean of the part in the mesh - mean
///   of the mesh|^2: parts that differ inside each shape.
/// - `pooled` is the share in the sum over parts of a |mean over the part of x - mean of the mesh|^2: parts
///   that differ in the same way in all shapes.
/// What tells shapes apart counts in neither. Otherwise a partition by style (round legs, square legs) would
/// seem to explain much. Both are 0 where the patches of each mesh are all alike. Sums are in double, in the
/// order of patches.
BetweenPartVariance between_part_variance(const PatchColumns& histograms, const std::vector<int>& labels,
                                          int parts, const std::vector<double>& patch_area,
                                          const std::vector<int>& mesh_of);

}  // namespace coseg
