#include "solvers/affinity/shared_sparse_rows.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/node_blocks.hpp"

namespace coseg {

namespace {

/// Of what each rank has `count` of, where its block ends. Collective.
std::vector<std::int64_t> block_ends(const Comm& comm, std::int64_t count) {
    std::vector<std::int64_t> ends = all_gather(comm, std::span<const std::int64_t>(&count, 1));
    for (std::size_t r = 1; r < ends.size(); ++r) ends[r] += ends[r - 1];
    return ends;
}

}  // namespace

SharedSparseRows::OfNode::OfNode(const Comm& comm, std::int64_t matrix_size, std::int64_t entries)
    : size(matrix_size),
      offsets(comm, at(matrix_size) + 1),
      columns(comm, at(entries)),
      values(comm, at(entries)) {}

SharedSparseRows::SharedSparseRows(SparseRows own)
    : own_(std::make_shared<const SparseRows>(std::move(own))) {}

SharedSparseRows::SharedSparseRows(const Comm& comm, SparseRows local) {
    if (comm.size() == 1) {
        own_ = std::make_shared<const SparseRows>(std::move(local));
        return;
    }
    const std::vector<std::int64_t> entry_ends = block_ends(comm, std::ssize(local.values));
    std::vector<std::int64_t> row_ends = block_ends(comm, local.local_rows());
    const std::int64_t first = entry_ends[at(comm.rank())] - std::ssize(local.values);
    of_node_ = std::make_shared<OfNode>(comm, local.size, entry_ends.back());
    std::copy(local.columns.begin(), local.columns.end(), of_node_->columns.data() + first);
    std::copy(local.values.begin(), local.values.end(), of_node_->values.data() + first);
    // The offset 0 of the first row is there; a rank writes where its rows end.
    std::int64_t* ends = of_node_->offsets.data() + local.rows.begin + 1;
    for (std::size_t r = 0; r < at(local.local_rows()); ++r) ends[r] = first + local.offsets[r + 1];
    for (std::int64_t& end : row_ends) ++end;
    share_blocks(of_node_->offsets, row_ends);
    share_blocks(of_node_->columns, entry_ends);
    share_blocks(of_node_->values, entry_ends);
}

SparseRowsView SharedSparseRows::view() const {
    if (of_node_) {
        const OfNode& m = *of_node_;
        return {m.size,
                {0, m.size},
                {m.offsets.data(), m.offsets.size()},
                {m.columns.data(), m.columns.size()},
                {m.values.data(), m.values.size()}};
    }
    static const SparseRows none;
    return own_ ? SparseRowsView(*own_) : SparseRowsView(none);
}

}  // namespace coseg
