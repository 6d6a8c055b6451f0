#include "src/parallel/node_blocks.hpp"

#include <mpi.h>

namespace coseg {

void broadcast_bytes(const Comm& leaders, int from, std::byte* data, std::size_t count) {
    constexpr std::size_t most = std::size_t{1} << 28;  // MPI counts in int
    for (std::size_t begin = 0; begin < count; begin += most)
        MPI_Bcast(data + begin, static_cast<int>(std::min(most, count - begin)), MPI_BYTE, from,
                  leaders.raw());
}

}  // namespace coseg
