#include "solvers/partition/cluster_merging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

double association(double inside, double volume) { return volume > 0.0 ? inside / volume : 0.0; }

/// What the normalised association loses when a and b become one: the normalised cut rises by 1 less than
/// this.
double loss_of_union(const ClusterLinks& c, Eigen::Index a, Eigen::Index b) {
    const double together =
        association(c.links(a, a) + c.links(b, b) + 2.0 * c.links(a, b), c.volume(a) + c.volume(b));
    return association(c.links(a, a), c.volume(a)) + association(c.links(b, b), c.volume(b)) - together;
}

/// Minus the links between a and b in units of the geometric mean of their volumes.
double missing_linkage(const ClusterLinks& c, Eigen::Index a, Eigen::Index b) {
    const double scale = std::sqrt(c.volume(a) * c.volume(b));
    return scale > 0.0 ? -c.links(a, b) / scale : 0.0;
}

void unite(ClusterLinks& c, Eigen::Index a, Eigen::Index b) {
    c.links.row(a) += c.links.row(b).eval();
    c.links.col(a) += c.links.col(b).eval();
    c.volume(a) += c.volume(b);
}

std::pair<int, int> best_union(const ClusterLinks& links, const std::vector<int>& alive, MergeRule rule) {
    const auto loss_of = rule == MergeRule::linkage ? missing_linkage : loss_of_union;
    std::pair<int, int> best{alive[0], alive[1]};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < alive.size(); ++i) {
        for (std::size_t j = i + 1; j < alive.size(); ++j) {
            const double loss = loss_of(links, alive[i], alive[j]);
            if (loss < least) {
                least = loss;
                best = {alive[i], alive[j]};
            }
        }
    }
    return best;
}

}  // namespace

ClusterLinks cluster_links(const Comm& comm, const SparseRows& affinity, const std::vector<int>& labels,
                           int clusters) {
    const auto width = at(clusters);
    std::vector<double> row_links(at(affinity.local_rows()) * width, 0.0);
    for (std::size_t r = 0; r < at(affinity.local_rows()); ++r) {
        for (auto k = at(affinity.offsets[r]); k < at(affinity.offsets[r + 1]); ++k) {
            const int label = labels[at(affinity.columns[k])];
            row_links[r * width + at(label)] += affinity.values[k];
        }
    }
    if (comm.size() > 1) row_links = all_gather(comm, std::span<const double>(row_links));
    ClusterLinks result{Eigen::MatrixXd::Zero(clusters, clusters), Eigen::VectorXd::Zero(clusters)};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        for (std::size_t b = 0; b < width; ++b) {
            result.links(labels[i], static_cast<Eigen::Index>(b)) += row_links[i * width + b];
            result.volume(labels[i]) += row_links[i * width + b];
        }
    }
    return result;
}

Eigen::MatrixXd area_shares(const std::vector<int>& labels, int clusters,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const int meshes = mesh_of.empty() ? 0 : *std::max_element(mesh_of.begin(), mesh_of.end()) + 1;
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(clusters, meshes);
    std::vector<double> mesh_area(at(meshes), 0.0);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        shares(labels[i], mesh_of[i]) += patch_area[i];
        mesh_area[at(mesh_of[i])] += patch_area[i];
    }
    for (int m = 0; m < meshes; ++m) {
        if (mesh_area[at(m)] > 0.0) shares.col(m) /= mesh_area[at(m)];
    }
    return shares;
}

std::vector<int> merge_clusters(ClusterLinks links, const std::vector<int>& cluster_sizes, int parts,
                                MergeRule rule) {
    std::vector<int> root(cluster_sizes.size(), -1);
    std::vector<int> alive;
    for (std::size_t c = 0; c < cluster_sizes.size(); ++c) {
        if (cluster_sizes[c] == 0) continue;
        root[c] = static_cast<int>(c);
        alive.push_back(static_cast<int>(c));
    }
    while (static_cast<int>(alive.size()) > parts) {
        const auto [a, b] = best_union(links, alive, rule);
        unite(links, a, b);
        std::replace(root.begin(), root.end(), b, a);
        std::erase(alive, b);
    }
    for (int& r : root) {
        if (r >= 0) r = static_cast<int>(std::lower_bound(alive.begin(), alive.end(), r) - alive.begin());
    }
    return root;
}

}  // namespace coseg
