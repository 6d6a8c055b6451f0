#pragma once
// Finds the part of every patch from coefficients: gives the pairs of patches, in global numbers, to the cut.

#include <span>
#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "solvers/partition/patch_partition.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The pairs of patches of a mesh that touch or overlap, where `first` is the number of its first patch.
std::vector<GlobalPatchNeighbors> neighbors_of(const MeshDescription& mesh, int first);
std::vector<GlobalPatchOverlap> overlaps_of(const MeshDescription& mesh, int first);

/// The pairs of patches of this rank's meshes that touch or overlap, in global numbers.
std::vector<GlobalPatchNeighbors> local_neighbors(const Collection& collection);
std::vector<GlobalPatchOverlap> local_overlaps(const Collection& collection);

/// The data that a cut uses, apart from the coefficients.
struct PartitionInput {
    const Collection& collection;
    const SparseCoefficients& coefficients;
    std::vector<double> patch_area;  ///< N
    Eigen::Matrix3Xd positions;      ///< 3 x N; 3 x 0 where what is cut are not patches
    /// Per feature, and then of positions, the weights of its explained shares in the choice among several
    /// starts; none with a single one.
    std::vector<BetweenPartVariance> choice_weights;
    /// Of a choice among starts, whose parts are scored by them, and of examples, which are followed by them;
    /// none otherwise.
    SinglePrecisionFeatures features;
    Eigen::Matrix3Xf rounded_positions;       ///< the positions as one more descriptor of the choice
    FeatureMatrices clustered;                ///< by --partition diffusion; none otherwise
    const ExampleLabels* examples = nullptr;  ///< null where there are none

    /// What has a weight in the choice. Refers to features and positions of this input.
    [[nodiscard]] std::vector<ChoiceDescriptor> choice() const;
    /// Null where there are none.
    [[nodiscard]] const Eigen::Matrix3Xd* known_positions() const noexcept {
        return positions.cols() > 0 ? &positions : nullptr;
    }
};

/// What the weights in the choice of the shares that parts explain of the histograms are multiplied with:
/// (p / 50)^0.6 for p patches in the mean over-segmentation. Histograms of smaller patches scatter more, so
/// that the same parts explain less of them (docs/method.md, section 7). `numbering` has at least one mesh.
double share_weight(const PatchNumbering& numbering);
/// The same of a collection with `patches` in the mean over-segmentation.
double share_weight(double patches);

/// Per descriptor, and then of positions if they count, the weights of its explained shares in the choice,
/// where `share` is share_weight.
std::vector<BetweenPartVariance> explained_weights(const std::vector<Descriptor>& descriptors, double share,
                                                   bool positions_count);

/// The features, and then the positions, of which `weights` has a weight. Refers to both.
std::vector<ChoiceDescriptor> choice_descriptors(const SinglePrecisionFeatures& features,
                                                 const Eigen::Matrix3Xf& positions,
                                                 std::span<const BetweenPartVariance> weights);

/// Creases are summed over the over-segmentations; the weight is that of three.
ChoiceWeights weights_of_choice(int oversegmentations);

/// Takes from the features what the cut uses; `examples` are not copied. The rest is freed: in a large
/// collection it is most of the memory, which the cut needs for its graphs. Collective.
PartitionInput partition_input(const Comm& comm, const Collection& collection, PatchFeatures features,
                               const SparseCoefficients& coefficients, const PartitionOptions& options,
                               const ExampleLabels& examples = {});

/// What a cut of these patches is made with.
CutOptions cut_options(const PartitionInput& input, const PartitionOptions& options);

/// Cuts the patches into K parts, or with found_parts into as many as count_parts() puts first. K must not
/// exceed the number of patches. Collective. Throws AgreedError: not_converged; input where there are too few
/// patches to find K.
CutResult cut_into_parts(const Comm& comm, const PartitionInput& input, const PartitionOptions& options);

}  // namespace coseg
