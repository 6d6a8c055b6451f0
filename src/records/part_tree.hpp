#pragma once
// One nested tree of parts for a whole collection, with levels coarser and finer than the parts of a run.

#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// Two groups of pieces that become one. A group is named by the piece that leads it.
struct PieceUnion {
    int kept = 0;       ///< the leading piece of both together
    int taken = 0;      ///< the leading piece of the other one
    double loss = 0.0;  ///< what the score loses by it; negative where it gains
    friend bool operator==(const PieceUnion&, const PieceUnion&) = default;
    static constexpr auto fields() {
        return std::tuple(field("kept", &PieceUnion::kept), field("taken", &PieceUnion::taken),
                          field("loss", &PieceUnion::loss));
    }
};

/// Pieces are numbered such that at the level of K parts the group that piece p leads is part p, for p < K,
/// and that every finer level adds the next number.
struct PartTree {
    std::vector<int> piece_of_patch;  ///< of each patch; empty where there is no tree
    std::vector<PieceUnion> unions;   ///< from the finest level to the level of 2 parts, in their order
    [[nodiscard]] bool empty() const noexcept { return piece_of_patch.empty(); }
    [[nodiscard]] int finest() const noexcept { return static_cast<int>(unions.size()) + 2; }
    static constexpr auto fields() {
        return std::tuple(field("piece_of_patch", &PartTree::piece_of_patch, Storage::compressed),
                          field("unions", &PartTree::unions));
    }
};

}  // namespace coseg
