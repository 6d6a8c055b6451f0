#pragma once
// The Rand index of two segmentations of one shape: how often they agree on whether two points belong
// together.

#include <vector>

namespace coseg {

/// The share of pairs that two segmentations treat alike: together in both or apart in both. A pair is two
/// points drawn independently with probability proportional to `weight`. Items of negative truth are left
/// out. The index is in [0, 1], and 0 if no item with weight is left. All three vectors have one length;
/// weight >= 0.
/// Source: Rand 1971; for segmentations of meshes Chen, Golovinskiy, Funkhouser 2009.
/// Deviates: the latter count pairs of faces and quote 1 - index. Here pairs are weighted by area, and 1
/// means the same segmentation.
double rand_index(const std::vector<int>& truth, const std::vector<int>& labels,
                  const std::vector<double>& weight);

/// The same over the pairs of two different items, all with equal weight. 1 for a single item, 0 for none.
double rand_index(const std::vector<int>& truth, const std::vector<int>& labels);

}  // namespace coseg
