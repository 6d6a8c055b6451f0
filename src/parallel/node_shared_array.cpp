#include "src/parallel/node_shared_array.hpp"

#include <sys/statvfs.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <new>

#include "src/parallel/block_range.hpp"

namespace coseg {

namespace {

constexpr std::size_t alignment = 64;
/// Left to others: messages between ranks of a node go through the same memory.
constexpr std::uint64_t spare_bytes = 8 << 20;

std::size_t rounded_up(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

std::byte* aligned(void* memory) {
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    return static_cast<std::byte*>(memory) + (alignment - address % alignment) % alignment;
}

}  // namespace

std::uint64_t shared_memory_room() {
    struct statvfs state = {};
    if (statvfs("/dev/shm", &state) != 0) return 0;
    return std::uint64_t{state.f_bavail} * state.f_frsize;
}

NodeSharedMemory::NodeSharedMemory(NodeRanks ranks, std::size_t bytes, std::uint64_t room)
    : ranks_(std::move(ranks)) {
    if (ranks_.any_shared()) {
        // Asked before, since a page that does not fit any more ends the program with a bus error, and other
        // ranks of Open MPI 4.1 wait for ever where the first cannot make a window.
        const auto wanted = std::uint64_t{bytes} * static_cast<std::uint64_t>(ranks_.nodes_on_machine());
        const bool fits = !ranks_.here().is_root() || room >= wanted + spare_bytes;
        fell_back_ = any_rank(ranks_.all(), !fits) || any_rank(ranks_.all(), !open_window(bytes));
        if (fell_back_) ranks_ = ranks_.apart();
    }
    agree(ranks_.all(), [&] {
        if (window_ == MPI_WIN_NULL || fell_back_) allocate_own(bytes);
    });
    clear(bytes);
}

/// A node of one rank needs none.
bool NodeSharedMemory::open_window(std::size_t bytes) {
    const Comm& here = ranks_.here();
    if (here.size() == 1) return true;
    MPI_Comm_set_errhandler(here.raw(), MPI_ERRORS_RETURN);
    const auto own = static_cast<MPI_Aint>(here.is_root() ? rounded_up(bytes) + alignment : 0);
    void* base = nullptr;
    const int outcome = MPI_Win_allocate_shared(own, 1, MPI_INFO_NULL, here.raw(), &base, &window_);
    MPI_Comm_set_errhandler(here.raw(), MPI_ERRORS_ARE_FATAL);
    if (outcome != MPI_SUCCESS) return false;
    MPI_Aint size = 0;
    int unit = 1;
    MPI_Win_shared_query(window_, 0, &size, &unit, &base);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
    data_ = aligned(base);  // at the same place for all: windows begin at a page
    return true;
}

void NodeSharedMemory::allocate_own(std::size_t bytes) {
    own_.reset(static_cast<std::byte*>(std::aligned_alloc(alignment, rounded_up(bytes + 1))));
    if (!own_) throw std::bad_alloc();
    data_ = own_.get();
}

/// Each rank a part, so that pages lie near those that will read them, and are there from now on.
void NodeSharedMemory::clear(std::size_t bytes) const {
    const BlockRange part = block_range(static_cast<std::int64_t>(bytes), ranks_.here().size(),
                                        ranks_.here().rank(), std::int64_t{1} << 21);
    std::memset(data_ + part.begin, 0, static_cast<std::size_t>(part.size()));
    fence();
}

void NodeSharedMemory::fence() const {
    if (ranks_.here().size() == 1) return;
    MPI_Win_sync(window_);
    MPI_Barrier(ranks_.here().raw());
    MPI_Win_sync(window_);
}

NodeSharedMemory::~NodeSharedMemory() {
    // A window that not all ranks of the node have cannot be freed.
    if (window_ == MPI_WIN_NULL || fell_back_ || !may_free_together(ranks_.here().size())) return;
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized != 0) return;
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
}

}  // namespace coseg
