#pragma once
// From coefficients to the part of every patch: hands the relations of patches, in global numbers, to the cut.

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "solvers/partition/partition_choice.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What ties the patches of this rank's meshes together, in global numbers.
std::vector<GlobalPatchNeighbors> local_neighbors(const Collection& collection);
std::vector<GlobalPatchOverlap> local_overlaps(const Collection& collection);

/// What the choice among several starts looks at, from the histograms; none with a single start, which leaves no choice.
std::vector<ChoiceDescriptor> choice_descriptors(const PatchFeatures& features, const RunOptions& options);

/// What a cut looks at. The histograms of `features` only count for --partition diffusion.
struct PartitionInput {
    const Collection& collection;
    const PatchFeatures& features;
    const SparseCoefficients& coefficients;
    std::vector<ChoiceDescriptor> choice;  ///< see choice_descriptors
};

/// Collective. K must not exceed the number of patches. Throws AgreedError(not_converged).
CutResult cut_into_parts(const Comm& comm, const PartitionInput& input, const RunOptions& options);

}  // namespace coseg
