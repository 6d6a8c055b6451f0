#pragma once
// The Rand index of two segmentations of one shape: how often they agree on whether two points belong together.

#include <vector>

namespace coseg {

/// The share of pairs that two segmentations treat alike, together in both or apart in both. A pair is two points
/// drawn independently with probability proportional to `weight`; items of negative truth are left out.
/// In [0, 1]; 0 if no item with weight is left. All three of one length, weight >= 0.
/// Source: Rand 1971; for segmentations of meshes Chen, Golovinskiy, Funkhouser 2009.
/// Deviates: they count pairs of faces and quote 1 - index; here areas, and 1 is the same segmentation.
double rand_index(const std::vector<int>& truth, const std::vector<int>& labels,
                  const std::vector<double>& weight);

/// The same over the pairs of two different items, all of equal weight. 1 for a single item, 0 for none.
double rand_index(const std::vector<int>& truth, const std::vector<int>& labels);

}  // namespace coseg
