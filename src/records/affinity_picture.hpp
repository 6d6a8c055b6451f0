#pragma once
// The affinity of all patches as a small picture of digits: blocks on the diagonal are parts.

#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

struct AffinityPicture {
    /// B rows of B digits 0..9a..z: the mean link ||w_ij|| + ||w_ji|| between the patches of two bins, by its
    /// square root; 0 is none, z the largest. Patches are sorted by part, then as they are numbered, and
    /// divided into B even bins.
    std::vector<std::string> rows;
    std::vector<int> part_ends;  ///< per part the number of bins before its end
    static constexpr auto fields() {
        return std::tuple(field("rows", &AffinityPicture::rows),
                          field("part_ends", &AffinityPicture::part_ends));
    }
};

}  // namespace coseg
