#pragma once
// Makes clusters of a spectral embedding: the discretisation of the normalised cut.

#include <vector>

#include "solvers/spectral/spectral_embedding.hpp"

namespace coseg {

/// The cluster of each row of the embedding, 0 .. clusters-1, from its first `clusters` coordinates; some
/// clusters may stay empty. Rows are scaled to unit length. The start takes `clusters` rows as far apart as
/// possible. Labels and rotation are then computed in turn until the labels no longer change.
/// 1 <= clusters <= number of coordinates.
///
/// Source: Yu and Shi 2003, "Multiclass Spectral Clustering".
///
/// Deviates: the first row of the start is not random. It is the row of the largest degree, and of equal
/// degrees the lowest.
std::vector<int> discretize(const SpectralEmbedding& embedding, int clusters);

/// The labels of `discretize` for all `size` patches; -1 for those that the embedding has set aside.
std::vector<int> cut_embedding(const SpectralEmbedding& embedding, int clusters, std::int64_t size);

}  // namespace coseg
