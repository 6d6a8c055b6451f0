#pragma once
// Gives every node the blocks of an array that the ranks of all nodes have written.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/base/index.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

/// Sends `count` bytes at `data` from leader `from` to the others. Collective over `leaders`.
void broadcast_bytes(const Comm& leaders, int from, std::byte* data, std::size_t count);

/// Each rank has written its block into the array of its node: rank r of array.ranks().all() has the values
/// ends[r - 1] .. ends[r], from 0 for the first. Afterwards every node has all blocks. `ends` is the same on
/// all ranks. Collective.
template <class T>
void share_blocks(NodeSharedArray<T>& array, std::span<const std::int64_t> ends) {
    array.fence();
    const NodeRanks& ranks = array.ranks();
    if (ranks.node_count() == 1) return;
    if (ranks.here().is_root()) {
        std::int64_t begin = 0;
        for (std::size_t r = 0; r < ends.size(); ++r) {
            broadcast_bytes(ranks.leaders(), ranks.node_of(static_cast<int>(r)),
                            reinterpret_cast<std::byte*>(array.data() + begin),
                            at(ends[r] - begin) * sizeof(T));
            begin = ends[r];
        }
    }
    array.fence();
}

}  // namespace coseg
