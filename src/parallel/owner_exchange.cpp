#include "src/parallel/owner_exchange.hpp"

#include <mpi.h>

#include <limits>
#include <utility>

#include "src/base/error.hpp"

namespace coseg {

namespace {

/// Counts and starts as MPI takes them.
struct Envelope {
    std::vector<int> counts;
    std::vector<int> starts;

    explicit Envelope(const std::vector<std::int64_t>& wanted) : counts(wanted.begin(), wanted.end()) {
        starts.resize(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    }
};

}  // namespace

OwnerCounts owner_counts(const Comm& comm, std::vector<std::int64_t> outgoing, const std::string& what) {
    OwnerCounts counts{std::move(outgoing), std::vector<std::int64_t>(at(comm.size()))};
    MPI_Alltoall(counts.outgoing.data(), 1, MPI_INT64_T, counts.incoming.data(), 1, MPI_INT64_T, comm.raw());
    agree(comm, [&] {
        for (const auto* some : {&counts.outgoing, &counts.incoming}) {
            if (std::accumulate(some->begin(), some->end(), std::int64_t{0}) >
                std::numeric_limits<int>::max())
                throw Error(ExitCode::internal, "a rank holds more than 2^31 " + what + "; use more ranks");
        }
    });
    return counts;
}

void exchange_packed(const Comm& comm, const OwnerCounts& counts, std::size_t bytes, const void* packed,
                     void* mine) {
    const Envelope out(counts.outgoing);
    const Envelope in(counts.incoming);
    MPI_Datatype type = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    MPI_Alltoallv(packed, out.counts.data(), out.starts.data(), type, mine, in.counts.data(),
                  in.starts.data(), type, comm.raw());
    MPI_Type_free(&type);
}

}  // namespace coseg
