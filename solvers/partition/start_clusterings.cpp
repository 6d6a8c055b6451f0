#include "solvers/partition/start_clusterings.hpp"

#include <algorithm>
#include <utility>

#include "solvers/affinity/graph_components.hpp"
#include "solvers/choice/part_shares.hpp"
#include "solvers/spectral/normalized_cut.hpp"
#include "src/base/index.hpp"
#include "src/parallel/shared_counter.hpp"

namespace coseg {

namespace {

std::vector<int> cluster_sizes(const std::vector<int>& labels, int clusters) {
    std::vector<int> sizes(at(clusters), 0);
    for (const int label : labels) {
        if (label >= 0) ++sizes[at(label)];
    }
    return sizes;
}

/// Everything that the clusterings of one graph share.
struct GraphCut {
    SparseRowsView within_mesh_affinity;
    const SpectralEmbedding& embedding;
    std::int64_t patches = 0;
};

/// The clusters of a start, numbered 0, 1, ... without gaps.
PartitionCandidate clustering(const GraphCut& cut, int index, const CutStart& start) {
    const int count = std::min(start.clusters, static_cast<int>(cut.embedding.eigenvalues.size()));
    PartitionCandidate result;
    result.index = index;
    result.outcome.start = start;
    result.labels = cut_embedding(cut.embedding, count, cut.patches);
    const std::vector<int> sizes = cluster_sizes(result.labels, count);
    const auto largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    result.outcome.set_aside = static_cast<int>(std::count(result.labels.begin(), result.labels.end(), -1));
    result.outcome.unreached = attach_set_aside(result.labels, cut.within_mesh_affinity, largest);
    result.eigenvalues.assign(cut.embedding.eigenvalues.begin(), cut.embedding.eigenvalues.begin() + count);
    result.residuals.assign(cut.embedding.residuals.begin(), cut.embedding.residuals.begin() + count);
    result.labels = renumbered(result.labels);
    return result;
}

/// The starts that share a graph, in the order of their first.
std::vector<std::vector<int>> starts_by_graph(const std::vector<CutStart>& starts) {
    std::vector<std::vector<int>> groups;
    for (std::size_t k = 0; k < starts.size(); ++k) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const std::vector<int>& group) {
            return starts[at(group.front())].graph == starts[k].graph;
        });
        if (same == groups.end()) {
            groups.push_back({static_cast<int>(k)});
        } else {
            same->push_back(static_cast<int>(k));
        }
    }
    return groups;
}

/// The clusterings of the starts of one graph. Collective over the group.
std::vector<PartitionCandidate> clusterings_of_graph(const Comm& group, const ClusteringTask& task,
                                                     const std::vector<int>& starts, VectorSums sums) {
    const std::vector<CutStart>& all = task.starts;
    SparseRows graph = graph_of(task.terms, task.graphs, all[at(starts.front())].graph, task.drop_below);
    int count = task.parts;
    for (const int k : starts) count = std::max(count, all[at(k)].clusters);
    SpectralOptions spectral = task.spectral;
    spectral.sums = sums;
    const SpectralEmbedding embedding =
        spectral_embedding(group, std::move(graph), task.parts, count, spectral, task.graphs.mesh_of);
    const GraphCut cut{task.terms.within_mesh_affinity.view(), embedding, task.terms.base.view().size};
    std::vector<PartitionCandidate> clusterings;
    for (const int k : starts) clusterings.push_back(clustering(cut, k, all[at(k)]));
    return clusterings;
}

/// The clusterings that this rank goes on with. Each graph is cut by one rank, the next one by whichever rank
/// is free: their eigenproblems take unlike times. Collective.
std::vector<PartitionCandidate> dealt_clusterings(const Comm& comm, const ClusteringTask& task) {
    const Comm self(MPI_COMM_SELF);
    const std::vector<std::vector<int>> graphs = starts_by_graph(task.starts);
    std::vector<PartitionCandidate> mine;
    SharedCounter counter(comm);
    agree(comm, [&] {
        // Across nodes the first rank may not answer while it cuts. The first graphs are dealt unasked.
        for (auto q = at(comm.rank()); q < graphs.size(); q = at(comm.size() + counter.next())) {
            for (PartitionCandidate& r : clusterings_of_graph(self, task, graphs[q], VectorSums::plain)) {
                mine.push_back(std::move(r));
            }
        }
    });
    return mine;
}

/// The same where one graph after the other is cut by all ranks.
std::vector<PartitionCandidate> shared_clusterings(const Comm& comm, const ClusteringTask& task) {
    std::vector<PartitionCandidate> mine;
    for (const std::vector<int>& starts : starts_by_graph(task.starts)) {
        for (PartitionCandidate& r : clusterings_of_graph(comm, task, starts, VectorSums::exact)) {
            if (r.index % comm.size() == comm.rank()) mine.push_back(std::move(r));
        }
    }
    return mine;
}

}  // namespace

std::vector<PartitionCandidate> start_clusterings(const Comm& comm, const ClusteringTask& task,
                                                  bool one_rank) {
    return one_rank ? dealt_clusterings(comm, task) : shared_clusterings(comm, task);
}

}  // namespace coseg
