#pragma once
// The affinity of all patches as rows of digits.

#include <string>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

struct AffinityPicture {
    /// B rows of B digits 0..9a..z: the mean link ||w_ij|| + ||w_ji|| between the patches of two bins, 0
    /// none, z the largest, by its square root. Patches are sorted by part, then as they are numbered, and
    /// cut into B even bins.
    std::vector<std::string> rows;
    std::vector<int> part_ends;  ///< per part the number of bins before its end
    static constexpr auto fields() {
        return std::tuple(field("rows", &AffinityPicture::rows),
                          field("part_ends", &AffinityPicture::part_ends));
    }
};

}  // namespace coseg
