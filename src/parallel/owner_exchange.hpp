#pragma once
// Sends records to the ranks that own them.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/base/index.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// How many records a rank sends to each rank, and gets from each.
struct OwnerCounts {
    std::vector<std::int64_t> outgoing;
    std::vector<std::int64_t> incoming;
};

/// Collective. Throws AgreedError(internal) where a rank sends or gets more than 2^31 records; the sentence
/// calls them `what`.
OwnerCounts owner_counts(const Comm& comm, std::vector<std::int64_t> outgoing, const std::string& what);

/// Sends records of `bytes` each; `packed` has those for rank 0, 1, ... one after the other, and `mine` room
/// for all that come, in the order of the ranks that sent them. Collective.
void exchange_packed(const Comm& comm, const OwnerCounts& counts, std::size_t bytes, const void* packed,
                     void* mine);

/// The records whose owner this rank is, from all ranks: in the order of ranks, and of each as it has them.
/// owner_of(record) is a rank. Records that are moved in are freed before those of others come. Collective.
/// Throws as owner_counts.
template <class Record, class OwnerOf>
std::vector<Record> sent_to_owners(const Comm& comm, std::vector<Record> records, OwnerOf&& owner_of,
                                   const std::string& what) {
    static_assert(std::is_trivially_copyable_v<Record>);
    std::vector<std::int64_t> outgoing(at(comm.size()), 0);
    for (const Record& record : records) ++outgoing[at(owner_of(record))];
    const OwnerCounts counts = owner_counts(comm, std::move(outgoing), what);
    std::vector<std::int64_t> next(counts.outgoing.size());
    std::exclusive_scan(counts.outgoing.begin(), counts.outgoing.end(), next.begin(), std::int64_t{0});
    std::vector<Record> packed(records.size());
    for (const Record& record : records) packed[at(next[at(owner_of(record))]++)] = record;
    std::vector<Record>().swap(records);
    std::vector<Record> mine(
        at(std::accumulate(counts.incoming.begin(), counts.incoming.end(), std::int64_t{0})));
    exchange_packed(comm, counts, sizeof(Record), packed.data(), mine.data());
    return mine;
}

}  // namespace coseg
