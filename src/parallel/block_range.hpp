#pragma once
// The one definition of which rank owns what: contiguous blocks of whole tiles.
//
// Items 0 .. n-1 are divided into tiles of `tile` items (the last one may be short). Ranks own contiguous
// runs of tiles; the first ranks own one tile more where the number does not divide evenly. Because a rank
// never owns part of a tile, work done tile by tile gives the same bits on any number of ranks.
//
// Example: n = 10, tile = 2, 3 ranks: tiles 01 23 45 67 89; rank 0 owns [0,4), rank 1 [4,8), rank 2 [8,10).

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "src/records/fields.hpp"

namespace coseg {

struct BlockRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    [[nodiscard]] constexpr std::int64_t size() const noexcept { return end - begin; }
    [[nodiscard]] constexpr bool contains(std::int64_t i) const noexcept { return begin <= i && i < end; }
    friend constexpr bool operator==(const BlockRange&, const BlockRange&) = default;
    static constexpr auto fields() {
        return std::tuple(field("begin", &BlockRange::begin), field("end", &BlockRange::end));
    }
};

/// The items that `rank` of `ranks` owns. n >= 0, ranks >= 1, tile >= 1.
constexpr BlockRange block_range(std::int64_t n, int ranks, int rank, std::int64_t tile = 1) noexcept {
    const std::int64_t tiles = (n + tile - 1) / tile;
    const std::int64_t share = tiles / ranks;
    const std::int64_t extra = tiles % ranks;
    const std::int64_t first = rank * share + std::min<std::int64_t>(rank, extra);
    const std::int64_t count = share + (rank < extra ? 1 : 0);
    return {std::min(n, first * tile), std::min(n, (first + count) * tile)};
}

/// The inverse: the rank whose block_range contains `item`. 0 <= item < n.
constexpr int block_owner(std::int64_t n, int ranks, std::int64_t item, std::int64_t tile = 1) noexcept {
    const std::int64_t tiles = (n + tile - 1) / tile;
    const std::int64_t share = tiles / ranks;
    const std::int64_t extra = tiles % ranks;
    const std::int64_t index = item / tile;
    const std::int64_t in_larger_blocks = extra * (share + 1);
    return static_cast<int>(index < in_larger_blocks ? index / (share + 1)
                                                     : extra + (index - in_larger_blocks) / share);
}

}  // namespace coseg
