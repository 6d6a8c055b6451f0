#pragma once
// The features of all patches, which every rank reads and a node holds once.

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

/// H matrices d_h x N, stacked: a column of D = sum of d_h values holds the H columns of one patch below each other, so
/// that they are one D x N array, column major. Copies are handles of the same values, and the last of them
/// is gone on all ranks of a node together, since that frees shared memory.
class FeatureMatrices {
  public:
    using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    using ConstBlock = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

    /// None.
    FeatureMatrices() = default;
    /// A copy in this rank's own memory. Throws Error(input), naming the feature (counted from 1), where the matrices differ
    /// in their number of columns. Implicit, as for a solver the two are the same.
    FeatureMatrices(const std::vector<Eigen::MatrixXd>& matrices);  // NOLINT(google-explicit-constructor)
    /// Zeros, to be filled; once a node, see NodeSharedMemory. rows[h] = d_h, the same on all ranks. Collective.
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

    /// Whether ranks of a node were to hold them once, but shared memory did not suffice; the same on all ranks.
    [[nodiscard]] bool fell_back() const noexcept;

    /// Where this rank fills in its columns of feature h, before share().
    [[nodiscard]] Block fill(std::size_t h);
    /// Brings every filled column to every node; each is filled by one rank. The same on all ranks, and collective.
    void share(std::span<const FilledColumns> filled);
    /// change(i, column) for each column i, by one rank of every node, in no order: it must be a function of i and the column, and
    /// not throw. Collective.
    void for_each_column(const std::function<void(Eigen::Index, double*)>& change);

    /// The same values as one feature of D rows.
    [[nodiscard]] FeatureMatrices joined() const;
    /// A copy of feature h alone. Collective over `comm`, whose ranks all have these features.
    [[nodiscard]] FeatureMatrices only(const Comm& comm, std::size_t h) const;
    /// A copy whose column i is column order[i] of these. Collective likewise.
    [[nodiscard]] FeatureMatrices chosen(const Comm& comm, std::span<const int> order) const;

  private:
    std::vector<Eigen::Index> offsets_{0};
    Eigen::Index columns_ = 0;
    std::shared_ptr<NodeSharedArray<double>> values_;
};

/// The root's matrices for all ranks; those of others are ignored. Collective. Throws AgreedError(input) where their numbers of
/// columns differ.
FeatureMatrices share_matrices(const Comm& comm, const std::vector<Eigen::MatrixXd>& of_root);

}  // namespace coseg
