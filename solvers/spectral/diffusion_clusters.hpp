#pragma once
// Patches clustered by their descriptors alone, in a diffusion map: the baseline of descriptor-space spectral
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
    int starts = 20;            ///< of k-means; the least sum of squares is taken
    std::uint64_t seed = 1;     ///< of the starts
    std::int64_t most = 12000;  ///< patches; the affinity is dense
};

/// 0 .. parts - 1 per patch, some may stay empty. Distance d_ij^2 = sum_h ||x_hi - x_hj||^2, affinity
/// exp(-d^2 / (2 s^2)) with s the mean distance over all pairs, diffusion map lambda^t psi of the K leading
/// nontrivial eigenvectors of the row-normalised affinity (Coifman, Lafon 2006), then k-means there. Neither
/// adjacency nor the mesh of a patch plays a part. features: H matrices d_h x N, the same on all ranks. Every
/// rank does the same work, so all have the same labels. Source: Sidi, van Kaick, Kleiman, Zhang, Cohen-Or
/// 2011. Deviates: Euclidean distances of the histograms as they come in place of the earth mover's; k-means
/// in place of agglomeration; no statistical model afterwards. Collective. Throws AgreedError: usage (more
/// than `most` patches, fewer patches than parts), not_converged.
std::vector<int> diffusion_clusters(const Comm& comm, const FeatureMatrices& features,
                                    const DiffusionOptions& options);

}  // namespace coseg
