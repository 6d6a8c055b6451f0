#include "src/histograms/feature_matrices.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

namespace {

using Eigen::Index;

/// A message between nodes is at most about this long.
constexpr Index message_bytes = Index{1} << 25;

std::vector<Index> rows_of(const std::vector<Eigen::MatrixXd>& matrices) {
    std::vector<Index> rows;
    for (const Eigen::MatrixXd& matrix : matrices) rows.push_back(matrix.rows());
    return rows;
}

Index columns_of(const std::vector<Eigen::MatrixXd>& matrices) {
    if (matrices.empty()) return 0;
    const Index columns = matrices.front().cols();
    for (std::size_t h = 0; h < matrices.size(); ++h) {
        if (matrices[h].cols() == columns) continue;
        throw Error(ExitCode::input, "feature " + std::to_string(h + 1) + " has " +
                                         std::to_string(matrices[h].cols()) + " columns but feature 1 has " +
                                         std::to_string(columns) + "; all must have one per patch");
    }
    return columns;
}

/// Runs of columns, sent from one node's leader to the others straight from where they are to where they
/// belong.
class ColumnBroadcast {
  public:
    ColumnBroadcast(const Comm& leaders, int from, double* values, Index dimension)
        : leaders_(leaders), from_(from), values_(values) {
        MPI_Type_contiguous(static_cast<int>(dimension), MPI_DOUBLE, &column_);
        most_ = std::max<Index>(
            1, message_bytes / static_cast<Index>(sizeof(double)) / std::max<Index>(dimension, 1));
    }
    ~ColumnBroadcast() { MPI_Type_free(&column_); }
    ColumnBroadcast(const ColumnBroadcast&) = delete;
    ColumnBroadcast& operator=(const ColumnBroadcast&) = delete;

    void add(Index begin, Index end) {
        while (begin < end) {
            const Index count = std::min(end - begin, most_ - held_);
            begins_.push_back(static_cast<int>(begin));
            lengths_.push_back(static_cast<int>(count));
            held_ += count;
            begin += count;
            if (held_ == most_) send();
        }
    }
    void send() {
        if (held_ == 0) return;
        MPI_Datatype batch = MPI_DATATYPE_NULL;
        MPI_Type_indexed(static_cast<int>(begins_.size()), lengths_.data(), begins_.data(), column_, &batch);
        MPI_Type_commit(&batch);
        MPI_Bcast(values_, 1, batch, from_, leaders_.raw());
        MPI_Type_free(&batch);
        begins_.clear();
        lengths_.clear();
        held_ = 0;
    }

  private:
    const Comm& leaders_;
    int from_;
    double* values_;
    MPI_Datatype column_ = MPI_DATATYPE_NULL;
    Index most_ = 1;
    Index held_ = 0;
    std::vector<int> begins_;
    std::vector<int> lengths_;
};

}  // namespace

FeatureMatrices::FeatureMatrices(const std::vector<Eigen::MatrixXd>& matrices)
    : FeatureMatrices(Comm(MPI_COMM_SELF), rows_of(matrices), columns_of(matrices)) {
    for (std::size_t h = 0; h < matrices.size(); ++h) fill(h) = matrices[h];
}

FeatureMatrices::FeatureMatrices(NodeRanks ranks, const std::vector<Index>& rows, Index columns)
    : columns_(columns) {
    for (const Index count : rows) offsets_.push_back(offsets_.back() + count);
    values_ = std::make_shared<NodeSharedArray<double>>(std::move(ranks), at(dimension() * columns));
}

const double* FeatureMatrices::data() const noexcept { return values_ ? values_->data() : nullptr; }

FeatureMatrices::ConstBlock FeatureMatrices::operator[](std::size_t h) const {
    return {data() + offsets_[h], offsets_[h + 1] - offsets_[h], columns_, Eigen::OuterStride<>(dimension())};
}

FeatureMatrices::Block FeatureMatrices::fill(std::size_t h) {
    return {values_->data() + offsets_[h], offsets_[h + 1] - offsets_[h], columns_,
            Eigen::OuterStride<>(dimension())};
}

std::vector<Eigen::MatrixXd> FeatureMatrices::matrices() const {
    std::vector<Eigen::MatrixXd> copies;
    for (std::size_t h = 0; h < size(); ++h) copies.emplace_back((*this)[h]);
    return copies;
}

bool FeatureMatrices::fell_back() const noexcept { return values_ && values_->fell_back(); }

void FeatureMatrices::share(std::span<const FilledColumns> filled) {
    const NodeRanks& ranks = values_->ranks();
    values_->fence();
    if (ranks.node_count() == 1) return;
    if (ranks.here().is_root()) {
        for (int node = 0; node < ranks.node_count(); ++node) {
            ColumnBroadcast broadcast(ranks.leaders(), node, values_->data(), dimension());
            for (const FilledColumns& run : filled) {
                if (ranks.node_of(run.rank) == node) broadcast.add(run.begin, run.end);
            }
            broadcast.send();
        }
    }
    values_->fence();
}

void FeatureMatrices::for_each_column(const std::function<void(Index, double*)>& change) {
    const Comm& here = values_->ranks().here();
    const BlockRange part = block_range(columns_, here.size(), here.rank());
    values_->fence();  // who still reads is not disturbed
    for (Index i = part.begin; i < part.end; ++i) change(i, values_->data() + i * dimension());
    values_->fence();
}

FeatureMatrices FeatureMatrices::joined() const {
    FeatureMatrices one = *this;
    one.offsets_ = {0, dimension()};
    return one;
}

FeatureMatrices FeatureMatrices::only(const Comm& comm, std::size_t h) const {
    const ConstBlock feature = (*this)[h];
    FeatureMatrices one(comm, {feature.rows()}, columns_);
    one.for_each_column([&](Index i, double* column) {
        std::copy_n(feature.data() + i * feature.outerStride(), feature.rows(), column);
    });
    return one;
}

FeatureMatrices FeatureMatrices::chosen(const Comm& comm, std::span<const int> order) const {
    std::vector<Index> rows;
    for (std::size_t h = 0; h < size(); ++h) rows.push_back(offsets_[h + 1] - offsets_[h]);
    FeatureMatrices part(comm, rows, static_cast<Index>(order.size()));
    part.for_each_column([&](Index i, double* column) {
        std::copy_n(data() + order[at(i)] * dimension(), dimension(), column);
    });
    return part;
}

FeatureMatrices share_matrices(const Comm& comm, const std::vector<Eigen::MatrixXd>& of_root) {
    Index columns = 0;
    agree(comm, [&] {
        if (comm.is_root()) columns = columns_of(of_root);
    });
    std::vector<std::int64_t> sizes;
    if (comm.is_root()) {
        for (const Index rows : rows_of(of_root)) sizes.push_back(rows);
        sizes.push_back(columns);
    }
    sizes = all_gather(comm, std::span<const std::int64_t>(sizes));
    columns = sizes.back();
    sizes.pop_back();
    if (sizes.empty()) return {};
    FeatureMatrices shared(comm, {sizes.begin(), sizes.end()}, columns);
    if (comm.is_root()) {
        for (std::size_t h = 0; h < of_root.size(); ++h) shared.fill(h) = of_root[h];
    }
    const FilledColumns all{0, columns, 0};
    shared.share(std::span(&all, 1));
    return shared;
}

}  // namespace coseg
