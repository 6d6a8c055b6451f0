#pragma once
// Clusters from a spectral embedding: the discretisation of the normalised cut.

#include <vector>

#include "solvers/spectral/spectral_embedding.hpp"

namespace coseg {

/// 0 .. clusters - 1 per row of the embedding, from its first `clusters` coordinates; some clusters may stay
/// empty. Rows are brought to unit length; the start takes `clusters` rows as far apart as possible; then
/// labels and rotation alternate until the labels stand still. 1 <= clusters <= number of coordinates.
/// Source: Yu and Shi 2003, "Multiclass Spectral Clustering". Deviates: the first row of the start is that of
/// the largest degree (ties: the lowest), not a random one.
std::vector<int> discretize(const SpectralEmbedding& embedding, int clusters);

/// The labels of `discretize` for all `size` patches; -1 for those that the embedding has set aside.
std::vector<int> cut_embedding(const SpectralEmbedding& embedding, int clusters, std::int64_t size);

}  // namespace coseg
