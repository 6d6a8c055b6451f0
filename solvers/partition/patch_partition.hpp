#pragma once
// Makes parts of coefficients: the affinity, cuts from several starts, and the choice among them.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/position_correlation.hpp"
#include "solvers/partition/cut_graphs.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/nested_levels.hpp"
#include "solvers/partition/partition_terms.hpp"
#include "solvers/partition/start_screening.hpp"
#include "solvers/spectral/spectral_embedding.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/cut_result.hpp"

namespace coseg {

/// (Adjacency, overlap) in {(0, 1), (.3, 1), (1, 1), (2, 2), (4, 4), (8, 8)}, clusters in {2K, 5K/2, 3K,
/// 7K/2, 4K}; the clusters are merged. With `placed`, links are weighed by position. Adjacency keeps parts in
/// one piece, but where shapes have many limbs it does harm in the cut.
std::vector<CutStart> pooled_starts(int parts, bool placed = false);

/// One cut into the parts, with adjacency = overlap. 0 with AffinityForm::formula_8 is the paper's text.
std::vector<CutStart> single_start(int parts, double adjacency);

struct CutInput {
    const SparseCoefficients& coefficients;                    ///< columns owned by this rank
    const std::vector<GlobalPatchNeighbors>& neighbors_local;  ///< of the meshes that this rank works on
    /// Likewise; none with one over-segmentation a mesh.
    const std::vector<GlobalPatchOverlap>& overlaps_local;
    const std::vector<int>& mesh_of;        ///< mesh 0 .. M-1 of all patches, the same on all ranks
    const std::vector<double>& patch_area;  ///< of all patches, the same on all ranks
    /// The descriptors by which one of several starts is chosen, the same on all ranks; none where there is
    /// one start.
    std::span<const ChoiceDescriptor> descriptors = {};
    /// 3 x N, the same on all ranks, see position_frame; needed where a start's graph is placed.
    const Eigen::Matrix3Xd* positions = nullptr;
    /// Labels that patches are said to have, the same on all ranks; null where there are no examples.
    const ExampleLabels* examples = nullptr;
    /// By which examples are followed, and parts scored; needed with examples, and where there are several
    /// starts.
    const SinglePrecisionFeatures* features = nullptr;
};

/// SpectralOptions::tolerance of eigenvectors whose clusters are only where a search begins.
inline constexpr double search_tolerance = 1e-4;

struct CutOptions {
    int parts = 2;  ///< K, 1 .. number of patches
    AffinityForm form = AffinityForm::links;
    bool minima_rule = true;       ///< applied to the base, as the paper prints it
    double drop_below = 0.0;       ///< entries of S below this are dropped; the paper's code has 1e-6
    SpectralOptions spectral;      ///< the paper's code has offset 0.5
    std::vector<CutStart> starts;  ///< at least one
    StartScreening screening;
    int finest_level = 0;       ///< parts of the finest level of CutResult::tree; 0: no tree is made
    PartitionsByNumber guides;  ///< that the levels of the tree should agree with; may be empty
    ChoiceWeights choice;
    ExampleWeights examples;
    /// Up to this number of entries of the base affinity, a start is the work of one rank (docs/scaling.md
    /// has the bytes). Above it no node holds all links, and the choice does without links_inside.
    std::int64_t one_rank_entries = 60'000'000;
};

/// What the starts and the choice of a cut are made of.
struct CutGraphs {
    std::vector<GlobalPatchNeighbors> neighbors;  ///< of all meshes
    std::vector<GlobalPatchOverlap> overlaps;     ///< likewise
    GraphTerms terms;
    bool one_rank = true;      ///< whether a graph is small enough for one rank, and `terms` are complete
    bool links_count = false;  ///< whether the choice counts links
};

/// Collective. Throws AgreedError.
CutGraphs cut_graphs(const Comm& comm, const CutInput& input, const CutOptions& options);

/// A partition that was found in another way, numbered and described as partition_patches does, without
/// starts. labels: 0 .. parts-1 for each patch.
CutResult described_partition(const std::vector<int>& labels, int parts, const std::vector<int>& mesh_of,
                              const std::vector<double>& patch_area);

/// Fills in part_share and meshes_with_part for result.part_of_patch, 0 .. parts-1.
void describe_parts(const std::vector<int>& mesh_of, const std::vector<double>& patch_area, int parts,
                    CutResult& result);

/// Cuts the patches of all meshes into parts.
///
/// Up to one_rank_entries every node holds all of the affinity, the different graphs are shared out among
/// the ranks, and each graph is cut by one rank alone. Above that number every rank keeps its rows, and all
/// ranks solve each eigenvalue problem together. The result has the same bytes on any number of ranks, and
/// in both cases the same clusters.
///
/// With examples the parts are their labels, 0 .. parts-1, and patches whose label is known have it. Labels
/// without an example are given to parts that no example shows. Without examples parts are numbered by
/// decreasing mean share of the area.
///
/// Collective. Throws AgreedError: usage (parts out of range), input (nothing to cut), not_converged,
/// internal.
///
/// Source: the paper, equation (8), minima rule and normalised cut.
///
/// Deviates: `links`, adjacency, overlaps, the balance of meshes, positions, several starts and the choice
/// among them.
CutResult partition_patches(const Comm& comm, const CutInput& input, const CutOptions& options);

}  // namespace coseg
