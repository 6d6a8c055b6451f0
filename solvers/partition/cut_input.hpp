#pragma once
// What a cut is made of, and how it is made.

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/choice/partition_terms.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/nested_levels.hpp"
#include "solvers/partition/start_screening.hpp"
#include "solvers/spectral/spectral_embedding.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/histograms/feature_matrices.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

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

}  // namespace coseg
