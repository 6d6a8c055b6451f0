#pragma once
// Union-find: sets of numbers that are joined two at a time.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "src/base/index.hpp"

namespace coseg {

/// The numbers 0 .. size - 1, at first each a set of its own. A set is known by its lowest number, whatever
/// the order in which it was joined.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t size) : below_(size) { std::iota(below_.begin(), below_.end(), 0); }

    /// The lowest number of the set that `i` is in.
    int lowest(int i) {
        while (below_[at(i)] != i) i = below_[at(i)] = below_[at(below_[at(i)])];
        return i;
    }

    /// False where both were in one set already.
    bool join(int i, int j) {
        const int a = lowest(i);
        const int b = lowest(j);
        below_[at(std::max(a, b))] = std::min(a, b);
        return a != b;
    }

  private:
    std::vector<int> below_;  ///< a lower number of the same set, or the number itself where it is the lowest
};

}  // namespace coseg
