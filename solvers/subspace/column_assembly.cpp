#include "solvers/subspace/column_assembly.hpp"

#include <cstring>
#include <numeric>
#include <utility>

#include "src/base/index.hpp"
#include "src/parallel/owner_exchange.hpp"

namespace coseg {

namespace {

/// Where an entry stands among those of all items. Its H values follow it.
struct EntryPlace {
    int row = 0;
    int column = 0;
};

std::size_t record_bytes(int features) { return sizeof(EntryPlace) + at(features) * sizeof(double); }

/// The owner of each column of a solve.
std::vector<int> owners_of(const Comm& comm, std::int64_t size, const SparseCoefficients& solved,
                           const std::vector<int>& item_of) {
    std::vector<int> owners;
    for (std::int64_t c = solved.columns.begin; c < solved.columns.end; ++c)
        owners.push_back(block_owner(size, comm.size(), item_of[at(c)], coefficient_tile));
    return owners;
}

/// The entries as records, those for rank 0, 1, ... one after the other.
std::vector<std::byte> packed_entries(const SparseCoefficients& solved, const std::vector<int>& item_of,
                                      const std::vector<int>& owners, std::vector<std::int64_t> next) {
    const std::size_t bytes = record_bytes(solved.features);
    const std::size_t values = at(solved.features) * sizeof(double);
    std::vector<std::byte> packed(solved.rows.size() * bytes);
    for (std::size_t c = 0; c < owners.size(); ++c) {
        const int column = item_of[at(solved.columns.begin) + c];
        for (std::size_t e = at(solved.offsets[c]); e < at(solved.offsets[c + 1]); ++e) {
            std::byte* record = packed.data() + at(next[at(owners[c])]++) * bytes;
            const EntryPlace place{item_of[at(solved.rows[e])], column};
            std::memcpy(record, &place, sizeof place);
            std::memcpy(record + sizeof place, &solved.values[e * at(solved.features)], values);
        }
    }
    return packed;
}

}  // namespace

ColumnAssembly::ColumnAssembly(const Comm& comm, std::int64_t size)
    : comm_(comm),
      size_(size),
      owned_(block_range(size, comm.size(), comm.rank(), coefficient_tile)),
      columns_(at(owned_.size())) {}

void ColumnAssembly::add(const SparseCoefficients& solved, const std::vector<int>& item_of) {
    features_ = solved.features;
    const std::vector<int> owners = owners_of(comm_, size_, solved, item_of);
    std::vector<std::int64_t> outgoing(at(comm_.size()), 0);
    for (std::size_t c = 0; c < owners.size(); ++c)
        outgoing[at(owners[c])] += solved.offsets[c + 1] - solved.offsets[c];
    const OwnerCounts counts = owner_counts(comm_, std::move(outgoing), "coefficients");
    std::vector<std::int64_t> begins(counts.outgoing.size());
    std::exclusive_scan(counts.outgoing.begin(), counts.outgoing.end(), begins.begin(), std::int64_t{0});
    const std::vector<std::byte> packed = packed_entries(solved, item_of, owners, std::move(begins));
    const std::size_t bytes = record_bytes(features_);
    const std::int64_t coming =
        std::accumulate(counts.incoming.begin(), counts.incoming.end(), std::int64_t{0});
    std::vector<std::byte> mine(at(coming) * bytes);
    exchange_packed(comm_, counts, bytes, packed.data(), mine.data());
    insert(mine, features_);
}

void ColumnAssembly::insert(const std::vector<std::byte>& records, int features) {
    std::vector<bool> is_taken;
    for (const Column& column : columns_) is_taken.push_back(!column.rows.empty());
    const std::size_t bytes = record_bytes(features);
    std::vector<double> values(at(features));
    for (std::size_t first = 0; first < records.size(); first += bytes) {
        EntryPlace place;
        std::memcpy(&place, records.data() + first, sizeof place);
        const std::size_t c = at(place.column - owned_.begin);
        if (is_taken[c]) continue;
        std::memcpy(values.data(), records.data() + first + sizeof place, values.size() * sizeof(double));
        columns_[c].rows.push_back(place.row);
        columns_[c].values.insert(columns_[c].values.end(), values.begin(), values.end());
    }
}

SparseCoefficients ColumnAssembly::take() {
    SparseCoefficients own{
        .size = size_, .columns = owned_, .features = features_, .offsets = {0}, .rows = {}, .values = {}};
    for (Column& column : columns_) {
        own.rows.insert(own.rows.end(), column.rows.begin(), column.rows.end());
        own.values.insert(own.values.end(), column.values.begin(), column.values.end());
        own.offsets.push_back(std::ssize(own.rows));
        column = {};
    }
    return own;
}

}  // namespace coseg
