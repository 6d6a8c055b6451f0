#pragma once
// Tells which ranks share the memory of a node.

#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// A communicator's ranks by node. Move-only; construction and destruction are collective.
class NodeRanks {
  public:
    /// A node holds the ranks that, according to MPI, can share memory. With COSEG_RANKS_PER_NODE=R in the
    /// environment each run of at most R of them counts as a node (with 1, no memory is shared).
    explicit NodeRanks(const Comm& comm);
    /// Treats the ranks of equal `node` as a node. They must be able to share memory.
    NodeRanks(const Comm& comm, int node);
    /// The same ranks, each of them as a node of its own.
    [[nodiscard]] NodeRanks apart() const { return {all_, all_.rank()}; }

    [[nodiscard]] const Comm& all() const noexcept { return all_; }
    /// The ranks of this node, in the order of all().
    [[nodiscard]] const Comm& here() const noexcept { return here_; }
    /// The first ranks of all nodes, in the order of node_of(). Only rank 0 of here() may use it.
    [[nodiscard]] const Comm& leaders() const noexcept { return leaders_; }
    [[nodiscard]] int node_count() const noexcept { return node_count_; }
    /// The node, 0 .. node_count - 1, of a rank of all().
    [[nodiscard]] int node_of(int rank) const { return node_of_[at(rank)]; }
    /// The number of nodes that use the memory of this machine: 1, unless runs of ranks are treated as nodes.
    [[nodiscard]] int nodes_on_machine() const noexcept { return nodes_on_machine_; }
    /// Whether a node has several ranks; the same on all ranks.
    [[nodiscard]] bool any_shared() const noexcept { return node_count_ < all_.size(); }

  private:
    Comm all_;
    Comm here_;
    Comm leaders_;
    std::vector<int> node_of_;
    int node_count_ = 1;
    int nodes_on_machine_ = 1;
};

}  // namespace coseg
