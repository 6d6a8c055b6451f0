#pragma once
// Finds the part of every patch from coefficients: gives the pairs of patches, in global numbers, to the cut.

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "solvers/partition/partition_choice.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The pairs of patches of this rank's meshes that touch or overlap, in global numbers.
std::vector<GlobalPatchNeighbors> local_neighbors(const Collection& collection);
std::vector<GlobalPatchOverlap> local_overlaps(const Collection& collection);

/// What a cut looks at.
struct PartitionInput {
    const Collection& collection;
    const SparseCoefficients& coefficients;
    std::vector<double> patch_area;        ///< N
    Eigen::Matrix3Xd positions;            ///< 3 x N; 3 x 0 where what is cut are not patches
    std::vector<ChoiceDescriptor> choice;  ///< of the choice among several starts; none with a single one
    FeatureMatrices histograms;            ///< of --partition diffusion, which clusters them; none otherwise
};

/// Takes from the features what the cut looks at. The rest goes with them: in a large collection it is most
/// of the memory, which the cut needs for its graphs. Collective where the features are the last of their
/// kind.
PartitionInput partition_input(const Collection& collection, PatchFeatures features,
                               const SparseCoefficients& coefficients, const PartitionOptions& options);

/// Cuts the patches into K parts. K must not exceed the number of patches. Collective. Throws
/// AgreedError(not_converged).
CutResult cut_into_parts(const Comm& comm, const PartitionInput& input, const PartitionOptions& options);

}  // namespace coseg
