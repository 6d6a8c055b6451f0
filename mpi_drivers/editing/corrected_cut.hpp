#pragma once
// From a run's partition and the acts of a person to the parts of all patches.

#include <memory>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/editing/correction_state.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "solvers/partition/corrected_parts.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What a run knows of its patches up to the cut.
struct SolvedPatches {
    const PatchFeatures& features;
    const SparseCoefficients& coefficients;
};

/// What corrections of the base are followed with; made once for all of them. The features may be freed
/// afterwards. Collective.
std::unique_ptr<CorrectedParts> corrected_parts_of(const Comm& comm, const CorrectionBase& base,
                                                   const SolvedPatches& patches,
                                                   const PartitionOptions& options);

struct CorrectedCut {
    /// With as many parts as CorrectionState::part_count, and without a tree.
    CutResult cut;
    /// Of each mesh of collection.local, the part that each face of its file must have, or -1; empty where
    /// nothing is said of the mesh.
    std::vector<std::vector<int>> faces;
    Eigen::MatrixXd said_area;  ///< K x N: what is said of patches, by links too
};

/// The partition after the acts: a function of the base and the acts alone, whatever was done and undone
/// before. Where nothing is said that others could follow, patches keep the parts that merges and splits
/// leave them. Collective. Throws AgreedError(input) where acts contradict each other; both are named.
CorrectedCut corrected_cut(const Comm& comm, const CorrectionBase& base, const CorrectionState& state,
                           const std::vector<Correction>& acts, const CorrectedParts& parts);

/// The state after all of `acts`. Collective; throws AgreedError(input) as CorrectionState::apply does.
CorrectionState state_after(const Comm& comm, const CorrectionBase& base,
                            const std::vector<Correction>& acts);

}  // namespace coseg
