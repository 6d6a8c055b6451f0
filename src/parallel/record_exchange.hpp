#pragma once
// Exchanges records, texts and everything else that a field may be between ranks.

#include <vector>

#include "src/parallel/comm.hpp"
#include "src/records/packing.hpp"

namespace coseg {

/// Gives the root's value to all ranks; the values of others are lost. Collective.
template <class T>
void broadcast(const Comm& comm, T& value) {
    std::vector<std::byte> bytes;
    if (comm.is_root()) bytes = packed(value);
    broadcast_bytes(comm, bytes);
    if (!comm.is_root()) value = unpacked<T>(bytes);
}

namespace record_exchange {

template <class T>
std::vector<std::byte> packed_rows(const std::vector<T>& rows) {
    Packer packer;
    for (const T& row : rows) packer.add(row);
    return std::move(packer).take();
}

template <class T>
std::vector<T> unpacked_rows(const std::vector<std::byte>& bytes) {
    std::vector<T> rows;
    for (Unpacker unpacker(bytes); !unpacker.is_at_end();) rows.push_back(unpacker.taken<T>());
    return rows;
}

}  // namespace record_exchange

/// The records of all ranks, in the order of ranks, on all ranks. Collective.
template <class T>
std::vector<T> all_gather_records(const Comm& comm, const std::vector<T>& local) {
    return record_exchange::unpacked_rows<T>(all_gather_bytes(comm, record_exchange::packed_rows(local)));
}

/// The same on the root alone; on other ranks the result is empty. Collective.
template <class T>
std::vector<T> gather_records(const Comm& comm, const std::vector<T>& local) {
    return record_exchange::unpacked_rows<T>(gather_bytes(comm, record_exchange::packed_rows(local)));
}

}  // namespace coseg
