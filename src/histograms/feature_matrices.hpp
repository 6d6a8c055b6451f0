#pragma once
// The features of all patches. Every rank reads all of them, and each node holds them once.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "src/parallel/comm.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

/// Columns [begin, end) that `rank` has filled.
struct FilledColumns {
    Eigen::Index begin = 0;
    Eigen::Index end = 0;
    int rank = 0;
};

/// H matrices d_h x N, stacked. A column of D = sum of d_h values holds the H columns of one patch below each
/// other, so that all are one D x N array, column major. Copies are handles of the same values. The last
/// handle must be destroyed at the same place on all ranks of a node, because that frees shared memory.
class FeatureMatrices {
  public:
    using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    using ConstBlock = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

    /// No features.
    FeatureMatrices() = default;
    /// A copy in this rank's own memory. Throws Error(input), naming the feature (counted from 1), where the
    /// matrices differ in their number of columns. Implicit, as for a solver the two are the same.
    FeatureMatrices(const std::vector<Eigen::MatrixXd>& matrices);  // NOLINT(google-explicit-constructor)
    /// Zeros, to be filled; once a node, see NodeSharedMemory. rows[h] = d_h, the same on all ranks.
    /// Collective.
    FeatureMatrices(const Comm& comm, const std::vector<Eigen::Index>& rows, Eigen::Index columns)
        : FeatureMatrices(NodeRanks(comm), rows, columns) {}
    FeatureMatrices(NodeRanks ranks, const std::vector<Eigen::Index>& rows, Eigen::Index columns);

    /// H.
    [[nodiscard]] std::size_t size() const noexcept { return offsets_.size() - 1; }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    /// N.
    [[nodiscard]] Eigen::Index columns() const noexcept { return columns_; }
    /// D.
    [[nodiscard]] Eigen::Index dimension() const noexcept { return offsets_.back(); }
    /// H + 1: feature h is the rows offsets[h] .. offsets[h + 1].
    [[nodiscard]] const std::vector<Eigen::Index>& offsets() const noexcept { return offsets_; }
    /// D x N values.
    [[nodiscard]] const double* data() const noexcept;
    [[nodiscard]] ConstBlock operator[](std::size_t h) const;
    [[nodiscard]] std::vector<Eigen::MatrixXd> matrices() const;

    /// Whether the ranks of a node should have held the features once, but shared memory did not suffice; the
    /// same on all ranks.
    [[nodiscard]] bool fell_back() const noexcept;

    /// The memory where this rank fills in its columns of feature h, before share().
    [[nodiscard]] Block fill(std::size_t h);
    /// Sends every filled column to every node. Each column is filled by one rank. `filled` is the same on
    /// all ranks. Collective.
    void share(std::span<const FilledColumns> filled);
    /// Calls change(i, column) for each column i, on one rank of every node and in no order. change must be a
    /// function of i and the column, and it must not throw. Collective.
    void for_each_column(const std::function<void(Eigen::Index, double*)>& change);

    /// The same values as one feature of D rows.
    [[nodiscard]] FeatureMatrices joined() const;
    /// A copy of feature h alone. Collective over `comm`, whose ranks all have these features.
    [[nodiscard]] FeatureMatrices only(const Comm& comm, std::size_t h) const;
    /// A copy whose column i is column order[i] of these. Collective in the same way.
    [[nodiscard]] FeatureMatrices chosen(const Comm& comm, std::span<const int> order) const;

  private:
    std::vector<Eigen::Index> offsets_{0};
    Eigen::Index columns_ = 0;
    std::shared_ptr<NodeSharedArray<double>> values_;
};

/// Gives the root's matrices to all ranks; those of others are ignored. Collective. Throws AgreedError(input)
/// where their numbers of columns differ.
FeatureMatrices share_matrices(const Comm& comm, const std::vector<Eigen::MatrixXd>& of_root);

}  // namespace coseg
