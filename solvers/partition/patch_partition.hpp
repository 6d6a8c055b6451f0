#pragma once
// From coefficients to parts: affinity, cuts from several starts, and the choice among them.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/position_correlation.hpp"
#include "solvers/partition/cluster_merging.hpp"
#include "solvers/partition/partition_choice.hpp"
#include "solvers/spectral/spectral_embedding.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/cut_result.hpp"

namespace coseg {

/// Adjacency = overlap in {1, 2, 4, 8}, clusters in {K, K+1, K+2, 2K, 5K/2, 3K}, more than K merged by both rules.
/// `placed`: with links weighed by place.
std::vector<CutStart> pooled_starts(int parts, bool placed = false);

/// Without adjacency (overlap 1), clusters in {K+1, K+2, 2K, 5K/2, 3K}, merged by the normalised cut: for shapes with
/// many limbs, where adjacency in the cut does harm.
std::vector<CutStart> articulated_starts(int parts);

/// One cut into the parts, adjacency = overlap; 0 with AffinityForm::formula_8 is the paper's text.
std::vector<CutStart> single_start(int parts, double adjacency);

struct CutInput {
    const SparseCoefficients& coefficients;                    ///< columns owned by this rank
    const std::vector<GlobalPatchNeighbors>& neighbors_local;  ///< of the meshes that this rank works on
    const std::vector<GlobalPatchOverlap>&
        overlaps_local;                     ///< likewise; none with one over-segmentation a mesh
    const std::vector<int>& mesh_of;        ///< mesh 0 .. M-1 of all patches, the same on all ranks
    const std::vector<double>& patch_area;  ///< of all patches, the same on all ranks
    /// What the choice among several starts looks at, the same on all ranks; none where there is one start.
    std::span<const ChoiceDescriptor> descriptors = {};
    /// 3 x N, the same on all ranks, see position_frame; needed where a start's graph is placed.
    const Eigen::Matrix3Xd* positions = nullptr;
};

struct CutOptions {
    int parts = 2;  ///< K, 1 .. number of patches
    AffinityForm form = AffinityForm::links;
    bool minima_rule = true;       ///< on the base, as the paper prints it
    double drop_below = 0.0;       ///< entries of S below are dropped; the paper's code: 1e-6
    SpectralOptions spectral;      ///< the paper's code: offset 0.5
    std::vector<CutStart> starts;  ///< at least one
    ChoiceWeights choice;
    /// Up to so many entries of the base affinity a start is one rank's work, which takes about 100 bytes an entry.
    std::int64_t one_rank_entries = 60'000'000;
};

/// A partition that was found in another way, numbered and described as partition_patches does; without starts.
/// labels: 0 .. parts - 1 per patch.
CutResult described_partition(const std::vector<int>& labels, int parts, const std::vector<int>& mesh_of,
                              const std::vector<double>& patch_area);

/// Cuts the patches of all meshes into parts.
///
/// Up to one_rank_entries the affinity is gathered on every rank, the different graphs are dealt over the
/// ranks and each is cut by one rank alone. Above, every rank keeps its rows and all share the products of each
/// eigenvalue problem. The result has the same bytes either way and on any number of ranks.
///
/// Collective. Throws AgreedError: usage (parts out of range), input (nothing to cut), not_converged,
/// internal. Source: the paper, equation (8), minima rule and normalised cut; Deviates: `links`, adjacency,
/// overlaps, balance of meshes, positions, several starts and their choice.
CutResult partition_patches(const Comm& comm, const CutInput& input, const CutOptions& options);

}  // namespace coseg
