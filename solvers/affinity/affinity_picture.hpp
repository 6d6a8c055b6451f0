#pragma once
// The affinity of all patches, small enough to look at: blocks on the diagonal are parts.

#include <string>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct AffinityPicture {
    /// B rows of B digits 0..9a..z: the mean link ||w_ij|| + ||w_ji|| between the patches of two bins, 0 none, z the
    /// largest, by its square root. Patches are sorted by part, then as they are numbered, and cut into B even bins.
    std::vector<std::string> rows;
    std::vector<int> part_ends;  ///< per part the number of bins before its end
};

/// most_bins: B is that, or N if there are fewer patches. Collective; the same on any number of ranks.
AffinityPicture affinity_picture(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts, int most_bins);

}  // namespace coseg
