#include "mpi_drivers/describe/patch_gather.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Meshes in the order in which all_gather concatenates them: by rank, ascending within a rank.
std::vector<int> gathered_order(const Collection& collection, int ranks) {
    std::vector<std::vector<int>> of_rank(static_cast<std::size_t>(ranks));
    for (std::size_t m = 0; m < collection.meshes.size(); ++m) {
        of_rank[at(collection.meshes[m].owner)].push_back(static_cast<int>(m));
    }
    std::vector<int> order;
    for (const auto& meshes : of_rank) order.insert(order.end(), meshes.begin(), meshes.end());
    return order;
}

}  // namespace

Eigen::MatrixXd gather_patch_columns(const Comm& comm, const Collection& collection,
                                     const std::vector<Eigen::MatrixXd>& local, Eigen::Index rows) {
    std::vector<double> mine;
    for (const Eigen::MatrixXd& columns : local)
        mine.insert(mine.end(), columns.data(), columns.data() + columns.size());
    const std::vector<double> all = all_gather(comm, std::span<const double>(mine));

    const PatchNumbering& numbering = collection.numbering;
    Eigen::MatrixXd global(rows, numbering.patch_count());
    const double* next = all.data();
    for (const int m : gathered_order(collection, comm.size())) {
        const std::ptrdiff_t values = rows * numbering.count(m);
        std::copy(next, next + values, global.col(numbering.first(m, 0)).data());
        next += values;
    }
    return global;
}

}  // namespace coseg
