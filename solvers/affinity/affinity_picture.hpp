#pragma once
// The affinity of all patches as a small picture: blocks on the diagonal are parts.

#include <string>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/affinity_picture.hpp"

namespace coseg {

/// B is most_bins, or N if there are fewer patches. Collective; the result is the same on any number of
/// ranks.
AffinityPicture affinity_picture(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts, int most_bins);

}  // namespace coseg
