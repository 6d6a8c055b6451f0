#pragma once
// Which ranks share the memory of a node.

#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// A communicator's ranks by node. Move-only; construction and destruction are collective.
class NodeRanks {
  public:
    /// Ranks that MPI says can share memory; with COSEG_RANKS_PER_NODE=R in the environment runs of at most R of them, as if
    /// each run were a node (1: no memory is shared).
    explicit NodeRanks(const Comm& comm);
    /// Ranks of equal `node` as if each of these were a node; they must be able to share memory.
    NodeRanks(const Comm& comm, int node);
    /// Every rank as if it were a node of its own.
    [[nodiscard]] NodeRanks apart() const { return {all_, all_.rank()}; }

    [[nodiscard]] const Comm& all() const noexcept { return all_; }
    /// The ranks of this node, in the order of all().
    [[nodiscard]] const Comm& here() const noexcept { return here_; }
    /// For rank 0 of here(): the same of every node, in the order of node_of(). No other rank may use it.
    [[nodiscard]] const Comm& leaders() const noexcept { return leaders_; }
    [[nodiscard]] int node_count() const noexcept { return node_count_; }
    /// The node, 0 .. node_count - 1, of a rank of all().
    [[nodiscard]] int node_of(int rank) const { return node_of_[at(rank)]; }
    /// Nodes that draw on the memory of this machine: 1, unless some are only taken as if they were nodes.
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
