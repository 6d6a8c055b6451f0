#include "src/parallel/comm.hpp"

#include <numeric>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

Comm::Comm(MPI_Comm parent) {
    MPI_Comm_dup(parent, &comm_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

Comm::Comm(MPI_Comm owned, Adopt) : comm_(owned) {
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

Comm::~Comm() {
    if (comm_ != MPI_COMM_NULL) {
        int finalized = 0;
        MPI_Finalized(&finalized);
        if (finalized == 0 && may_free_together(size_)) MPI_Comm_free(&comm_);
    }
}

Comm::Comm(Comm&& other) noexcept
    : comm_(std::exchange(other.comm_, MPI_COMM_NULL)), rank_(other.rank_), size_(other.size_) {}

Comm& Comm::operator=(Comm&& other) noexcept {
    std::swap(comm_, other.comm_);
    std::swap(rank_, other.rank_);
    std::swap(size_, other.size_);
    return *this;
}

Comm Comm::split(int colour) const {
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(comm_, colour, rank_, &part);
    return {part, Adopt{}};
}

namespace {

struct Failure {
    int code = 0;
    std::string sentence;
};

std::optional<Failure> run_and_catch(const std::function<void()>& step) {
    try {
        step();
    } catch (const Error& error) {
        return Failure{static_cast<int>(error.code()), error.what()};
    } catch (const std::bad_alloc&) {
        return Failure{static_cast<int>(ExitCode::internal), "out of memory; use more nodes or fewer shapes"};
    } catch (const std::exception& error) {
        return Failure{static_cast<int>(ExitCode::internal), error.what()};
    }
    return std::nullopt;
}

/// Where the values of each rank begin among those of all, and how many there are in all.
std::vector<std::int64_t> gathered_offsets(const Comm& comm, std::size_t local) {
    const auto count = static_cast<std::int64_t>(local);
    std::vector<std::int64_t> offsets(at(comm.size()) + 1, 0);
    MPI_Allgather(&count, 1, MPI_INT64_T, offsets.data() + 1, 1, MPI_INT64_T, comm.raw());
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    return offsets;
}

template <class T>
std::vector<T> all_gather_of(const Comm& comm, std::span<const T> local, MPI_Datatype type,
                             std::int64_t longest = longest_message) {
    const std::vector<std::int64_t> offsets = gathered_offsets(comm, local.size());
    std::vector<T> all(at(offsets.back()));
    if (offsets.back() <= longest) {
        const std::vector<int> begins(offsets.begin(), offsets.end() - 1);
        std::vector<int> counts;
        for (std::size_t r = 0; r < begins.size(); ++r)
            counts.push_back(static_cast<int>(offsets[r + 1] - offsets[r]));
        MPI_Allgatherv(local.data(), static_cast<int>(local.size()), type, all.data(), counts.data(),
                       begins.data(), type, comm.raw());
        return all;
    }
    std::copy(local.begin(), local.end(), all.begin() + offsets[at(comm.rank())]);
    for (int rank = 0; rank < comm.size(); ++rank) {
        T* values = all.data() + offsets[at(rank)];
        in_messages(
            offsets[at(rank) + 1] - offsets[at(rank)],
            [&](std::int64_t first, int count) { MPI_Bcast(values + first, count, type, rank, comm.raw()); },
            longest);
    }
    return all;
}

}  // namespace

bool may_free_together(int ranks) noexcept { return ranks == 1 || std::uncaught_exceptions() == 0; }

void agree(const Comm& comm, const std::function<void()>& step) {
    const std::optional<Failure> failure = run_and_catch(step);
    const int mine = failure ? comm.rank() : comm.size();
    int first = comm.size();
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm.raw());
    if (first == comm.size()) return;
    int header[2] = {0, 0};
    std::string sentence;
    if (comm.rank() == first) {
        sentence = failure->sentence;
        header[0] = failure->code;
        header[1] = static_cast<int>(sentence.size());
    }
    MPI_Bcast(header, 2, MPI_INT, first, comm.raw());
    sentence.resize(at(header[1]));
    MPI_Bcast(sentence.data(), header[1], MPI_CHAR, first, comm.raw());
    throw AgreedError(static_cast<ExitCode>(header[0]), sentence);
}

std::vector<double> all_gather(const Comm& comm, std::span<const double> local) {
    return all_gather_of<double>(comm, local, MPI_DOUBLE);
}

std::vector<int> all_gather(const Comm& comm, std::span<const int> local) {
    return all_gather_of<int>(comm, local, MPI_INT);
}

std::vector<std::int64_t> all_gather(const Comm& comm, std::span<const std::int64_t> local,
                                     std::int64_t longest) {
    return all_gather_of<std::int64_t>(comm, local, MPI_INT64_T, longest);
}

std::vector<std::byte> all_gather_bytes(const Comm& comm, std::span<const std::byte> local,
                                        std::int64_t longest) {
    return all_gather_of<std::byte>(comm, local, MPI_BYTE, longest);
}

std::vector<std::byte> gather_bytes(const Comm& comm, std::span<const std::byte> local,
                                    std::int64_t longest) {
    const std::vector<std::int64_t> offsets = gathered_offsets(comm, local.size());
    std::vector<std::byte> all(comm.is_root() ? at(offsets.back()) : 0);
    if (comm.is_root()) std::copy(local.begin(), local.end(), all.begin());
    for (int rank = 1; rank < comm.size(); ++rank) {
        const auto pass_on = [&](std::int64_t first, int count) {
            if (comm.is_root()) {
                MPI_Recv(all.data() + offsets[at(rank)] + first, count, MPI_BYTE, rank, 0, comm.raw(),
                         MPI_STATUS_IGNORE);
            } else if (comm.rank() == rank) {
                MPI_Send(local.data() + first, count, MPI_BYTE, 0, 0, comm.raw());
            }
        };
        in_messages(offsets[at(rank) + 1] - offsets[at(rank)], pass_on, longest);
    }
    return all;
}

void broadcast_bytes(const Comm& comm, std::vector<std::byte>& bytes, std::int64_t longest) {
    std::int64_t size = std::ssize(bytes);
    MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm.raw());
    bytes.resize(at(size));
    in_messages(
        size,
        [&](std::int64_t first, int count) {
            MPI_Bcast(bytes.data() + first, count, MPI_BYTE, 0, comm.raw());
        },
        longest);
}

bool any_rank(const Comm& comm, bool local) {
    int result = local ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, comm.raw());
    return result != 0;
}

bool every_rank(const Comm& comm, bool local) { return !any_rank(comm, !local); }

double all_max(const Comm& comm, double local) {
    double result = 0.0;
    MPI_Allreduce(&local, &result, 1, MPI_DOUBLE, MPI_MAX, comm.raw());
    return result;
}

std::int64_t all_max(const Comm& comm, std::int64_t local) {
    std::int64_t result = 0;
    MPI_Allreduce(&local, &result, 1, MPI_INT64_T, MPI_MAX, comm.raw());
    return result;
}

int all_max(const Comm& comm, int local) { return static_cast<int>(all_max(comm, std::int64_t{local})); }

double all_min(const Comm& comm, double local) {
    double result = 0.0;
    MPI_Allreduce(&local, &result, 1, MPI_DOUBLE, MPI_MIN, comm.raw());
    return result;
}

std::int64_t all_sum(const Comm& comm, std::int64_t local) {
    std::int64_t result = 0;
    MPI_Allreduce(&local, &result, 1, MPI_INT64_T, MPI_SUM, comm.raw());
    return result;
}

}  // namespace coseg
