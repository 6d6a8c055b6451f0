#pragma once
// An array of which the ranks of a node hold one copy together, in a window of MPI-3 shared memory.

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <utility>

#include "src/parallel/node_ranks.hpp"

namespace coseg {

/// The number of bytes that /dev/shm can still take; 0 where there is none. MPI libraries on Linux put their
/// windows there.
std::uint64_t shared_memory_room();

/// The memory of one node, aligned to 64 bytes on every rank and zero at first. Every rank has a copy of its
/// own instead where a node has one rank, or where any node has not enough shared memory left (/dev/shm has
/// 64 MB in many containers). ranks() says so: each rank is then a node. Construction is collective over all
/// ranks, fence() and destruction over those of a node.
class NodeSharedMemory {
  public:
    /// `room` is the number of bytes that the memory of this machine can take, as the first ranks of its
    /// nodes see it.
    NodeSharedMemory(NodeRanks ranks, std::size_t bytes, std::uint64_t room);
    ~NodeSharedMemory();
    NodeSharedMemory(const NodeSharedMemory&) = delete;
    NodeSharedMemory& operator=(const NodeSharedMemory&) = delete;

    [[nodiscard]] std::byte* data() const noexcept { return data_; }
    [[nodiscard]] const NodeRanks& ranks() const noexcept { return ranks_; }
    /// Whether the ranks of a node should have shared this memory and could not; the same on all ranks.
    [[nodiscard]] bool fell_back() const noexcept { return fell_back_; }
    void fence() const;

  private:
    struct Free {
        void operator()(std::byte* memory) const noexcept { std::free(memory); }
    };
    bool open_window(std::size_t bytes);
    void allocate_own(std::size_t bytes);
    void clear(std::size_t bytes) const;

    NodeRanks ranks_;
    MPI_Win window_ = MPI_WIN_NULL;
    std::unique_ptr<std::byte, Free> own_;
    std::byte* data_ = nullptr;
    bool fell_back_ = false;
};

/// `size` values of T, 0 at first; see NodeSharedMemory. Every rank of the node may read all values and write
/// any. Between two fences, no two ranks may write the same value, and none may write a value that another
/// reads.
template <class T>
class NodeSharedArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    /// Collective over `comm`.
    NodeSharedArray(const Comm& comm, std::size_t size) : NodeSharedArray(NodeRanks(comm), size) {}
    /// Collective over ranks.all().
    NodeSharedArray(NodeRanks ranks, std::size_t size, std::uint64_t room = shared_memory_room())
        : memory_(std::move(ranks), size * sizeof(T), room), size_(size) {}

    [[nodiscard]] T* data() noexcept { return reinterpret_cast<T*>(memory_.data()); }
    [[nodiscard]] const T* data() const noexcept { return reinterpret_cast<const T*>(memory_.data()); }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// The ranks that share this memory: all of a node, or each one alone.
    [[nodiscard]] const NodeRanks& ranks() const noexcept { return memory_.ranks(); }
    [[nodiscard]] bool fell_back() const noexcept { return memory_.fell_back(); }

    /// Makes everything that a rank of the node has written before visible to all ranks of the node after.
    /// Collective over the node.
    void fence() const { memory_.fence(); }

  private:
    NodeSharedMemory memory_;
    std::size_t size_;
};

}  // namespace coseg
