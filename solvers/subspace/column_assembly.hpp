#pragma once
// Puts the coefficients of a whole collection together from solves of parts of it.

#include <cstdint>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// W of `size` items. Each rank holds the columns that it owns, and nothing of the others.
class ColumnAssembly {
  public:
    ColumnAssembly(const Comm& comm, std::int64_t size);

    /// Takes over what a solve of some items found: its item i is item `item_of[i]` of all. A column that has
    /// entries already keeps them. Collective. Throws AgreedError(internal) where a rank sends or gets more
    /// than 2^31 entries.
    void add(const SparseCoefficients& solved, const std::vector<int>& item_of);

    /// What was taken over. Leaves the assembly empty.
    [[nodiscard]] SparseCoefficients take();

  private:
    struct Column {
        std::vector<int> rows;
        std::vector<double> values;
    };
    void insert(const std::vector<std::byte>& records, int features);

    const Comm& comm_;
    std::int64_t size_;
    BlockRange owned_;
    int features_ = 0;
    std::vector<Column> columns_;  ///< those owned
};

}  // namespace coseg
