#include "src/parallel/node_ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// COSEG_RANKS_PER_NODE, or `ranks` where it is unset or no number above 0.
int most_ranks_a_node(int ranks) {
    const char* variable = std::getenv("COSEG_RANKS_PER_NODE");
    const int most = variable != nullptr ? std::atoi(variable) : ranks;
    return most > 0 ? most : ranks;
}

MPI_Comm ranks_of_machine(const Comm& comm) {
    MPI_Comm sharing = MPI_COMM_NULL;
    MPI_Comm_split_type(comm.raw(), MPI_COMM_TYPE_SHARED, comm.rank(), MPI_INFO_NULL, &sharing);
    return sharing;
}

/// A number that the ranks of a node have in common, and no others.
int node_number(const Comm& comm) {
    MPI_Comm sharing = ranks_of_machine(comm);
    int size = 1;
    int place = 0;
    MPI_Comm_size(sharing, &size);
    MPI_Comm_rank(sharing, &place);
    std::vector<int> ranks(at(size));
    const int own = comm.rank();
    MPI_Allgather(&own, 1, MPI_INT, ranks.data(), 1, MPI_INT, sharing);
    MPI_Comm_free(&sharing);
    const int most = most_ranks_a_node(size);
    return ranks[at(place - place % most)];
}

}  // namespace

NodeRanks::NodeRanks(const Comm& comm) : NodeRanks(comm, node_number(comm)) {}

NodeRanks::NodeRanks(const Comm& comm, int node)
    : all_(comm.raw()), here_(all_.split(node)), leaders_(all_.split(here_.is_root() ? 0 : 1)) {
    int number = leaders_.rank();
    MPI_Bcast(&number, 1, MPI_INT, 0, here_.raw());
    node_of_ = all_gather(all_, std::span<const int>(&number, 1));
    node_count_ = 1 + *std::max_element(node_of_.begin(), node_of_.end());
    MPI_Comm machine = ranks_of_machine(all_);
    const int leads = here_.is_root() ? 1 : 0;
    MPI_Allreduce(&leads, &nodes_on_machine_, 1, MPI_INT, MPI_SUM, machine);
    MPI_Comm_free(&machine);
}

}  // namespace coseg
