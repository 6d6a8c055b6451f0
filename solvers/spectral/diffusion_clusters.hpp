#pragma once
// Clusters patches by their descriptors alone, in a diffusion map: the baseline of descriptor-space spectral
// clustering.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "src/histograms/feature_matrices.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct DiffusionOptions {
    int parts = 2;              ///< K >= 1
    int time = 3;               ///< t: steps of the diffusion
    int starts = 20;            ///< of k-means; the one with the least sum of squares is taken
    std::uint64_t seed = 1;     ///< of the starts
    std::int64_t most = 12000;  ///< patches at most, because the affinity is dense
};

/// The cluster of each patch, 0 .. parts-1; some clusters may stay empty. The distance of two patches is
/// d_ij^2 = sum_h ||x_hi - x_hj||^2, and their affinity is exp(-d^2 / (2 s^2)), where s is the mean distance
/// over all pairs. Patches are mapped to the diffusion coordinates lambda^t psi of the K leading nontrivial
/// eigenvectors of the row-normalised affinity (Coifman, Lafon 2006), and k-means clusters them there.
/// Neither adjacency nor the mesh of a patch matters. features: H matrices d_h x N, the same on all ranks.
/// The root does the work, and all ranks have its labels. Collective. Throws AgreedError: usage (more than
/// `most` patches, fewer patches than parts), not_converged.
///
/// Source: Sidi, van Kaick, Kleiman, Zhang, Cohen-Or 2011.
///
/// Deviates: Euclidean distances of the histograms replace the earth mover's distances, k-means replaces
/// agglomeration, and no statistical model follows.
std::vector<int> diffusion_clusters(const Comm& comm, const FeatureMatrices& features,
                                    const DiffusionOptions& options);

}  // namespace coseg
