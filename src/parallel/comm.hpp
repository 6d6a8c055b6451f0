#pragma once
// A duplicated MPI communicator and the few collective idioms that the stages share.

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "src/base/error.hpp"

namespace coseg {

/// Owns a duplicate of a communicator, so that our messages never mix with a caller's. Move-only.
class Comm {
  public:
    /// Collective over `parent`.
    explicit Comm(MPI_Comm parent);
    ~Comm();
    Comm(Comm&& other) noexcept;
    Comm& operator=(Comm&& other) noexcept;
    Comm(const Comm&) = delete;
    Comm& operator=(const Comm&) = delete;

    [[nodiscard]] int rank() const noexcept { return rank_; }
    [[nodiscard]] int size() const noexcept { return size_; }
    [[nodiscard]] bool is_root() const noexcept { return rank_ == 0; }
    [[nodiscard]] MPI_Comm raw() const noexcept { return comm_; }

    /// Ranks of equal colour, in the order of this communicator. Collective.
    [[nodiscard]] Comm split(int colour) const;

  private:
    struct Adopt {};
    Comm(MPI_Comm owned, Adopt);
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 1;
};

/// Whether a destructor may free what the `ranks` of a communicator own together. Freeing is collective, and
/// a rank that unwinds alone must not begin it: the others would wait for it.
bool may_free_together(int ranks) noexcept;

/// Runs `step` on this rank. If it throws on any rank, all ranks throw the same AgreedError, that of the
/// lowest failing rank. `step` must not make a collective call; it may draw numbers from a SharedCounter.
/// Collective.
void agree(const Comm& comm, const std::function<void()>& step);

/// MPI 3 counts the values of a message in int; what is longer goes in several messages.
inline constexpr std::int64_t longest_message = std::numeric_limits<int>::max();

/// Calls send(first, count) for consecutive runs of at most `longest` of `total` values.
template <class Send>
void in_messages(std::int64_t total, Send&& send, std::int64_t longest = longest_message) {
    for (std::int64_t first = 0; first < total; first += longest)
        send(first, static_cast<int>(std::min(longest, total - first)));
}

/// The values of all ranks, joined in the order of ranks, on all ranks. Collective.
std::vector<double> all_gather(const Comm& comm, std::span<const double> local);
std::vector<int> all_gather(const Comm& comm, std::span<const int> local);
std::vector<std::int64_t> all_gather(const Comm& comm, std::span<const std::int64_t> local,
                                     std::int64_t longest = longest_message);

/// The same on the root alone; elsewhere nothing. Collective.
template <class T>
std::vector<T> gather(const Comm& comm, std::span<const T> local);

/// The values of all ranks as bytes, on all ranks. Collective.
std::vector<std::byte> all_gather_bytes(const Comm& comm, std::span<const std::byte> local,
                                        std::int64_t longest = longest_message);
/// The same on the root alone; elsewhere nothing. Collective.
std::vector<std::byte> gather_bytes(const Comm& comm, std::span<const std::byte> local,
                                    std::int64_t longest = longest_message);
/// The root's bytes on all ranks. Collective.
void broadcast_bytes(const Comm& comm, std::vector<std::byte>& bytes, std::int64_t longest = longest_message);

/// Whether it is true on any rank, and whether on every rank. Collective.
bool any_rank(const Comm& comm, bool local);
bool every_rank(const Comm& comm, bool local);

double all_max(const Comm& comm, double local);
std::int64_t all_max(const Comm& comm, std::int64_t local);
int all_max(const Comm& comm, int local);
double all_min(const Comm& comm, double local);
std::int64_t all_sum(const Comm& comm, std::int64_t local);

template <class T>
std::vector<T> gather(const Comm& comm, std::span<const T> local) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<std::byte> bytes = gather_bytes(comm, std::as_bytes(local));
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

}  // namespace coseg
