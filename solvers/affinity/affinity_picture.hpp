#pragma once
// The affinity of all patches as a small picture: blocks on the diagonal are parts.

#include <string>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

struct AffinityPicture {
    /// B rows of B digits 0..9a..z: the mean link ||w_ij|| + ||w_ji|| between the patches of two bins, by its
    /// square root; 0 is none, z the largest. Patches are sorted by part, then as they are numbered, and
    /// divided into B even bins.
    std::vector<std::string> rows;
    std::vector<int> part_ends;  ///< per part the number of bins before its end
};

/// B is most_bins, or N if there are fewer patches. Collective; the result is the same on any number of
/// ranks.
AffinityPicture affinity_picture(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts, int most_bins);

}  // namespace coseg
