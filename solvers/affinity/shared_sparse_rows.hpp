#pragma once
// A sparse matrix that is read by many and changed by nobody: all rows once a node, or a rank's own rows.

#include <cstdint>
#include <memory>

#include "solvers/affinity/sparse_rows.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

/// Copies are handles of the same values. The last handle must be destroyed at the same place on all ranks
/// of a node, because that frees shared memory.
class SharedSparseRows {
  public:
    /// A matrix of size 0.
    SharedSparseRows() = default;
    /// These rows.
    explicit SharedSparseRows(SparseRows own);
    /// All rows, of which every rank of `comm` gives its own; once a node, see NodeSharedMemory. Rows are
    /// owned as block_range gives them. Collective.
    SharedSparseRows(const Comm& comm, SparseRows local);

    [[nodiscard]] SparseRowsView view() const;

  private:
    struct OfNode {
        OfNode(const Comm& comm, std::int64_t size, std::int64_t entries);
        std::int64_t size;
        NodeSharedArray<std::int64_t> offsets;
        NodeSharedArray<int> columns;
        NodeSharedArray<double> values;
    };
    std::shared_ptr<const SparseRows> own_;
    std::shared_ptr<OfNode> of_node_;
};

}  // namespace coseg
