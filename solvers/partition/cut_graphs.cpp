#include "solvers/partition/cut_graphs.hpp"

#include <algorithm>
#include <utility>

namespace coseg {

namespace {

void find_places(const Comm& comm, const GraphInput& input, double base_total, GraphTerms& terms) {
    terms.frame = position_frame(comm, terms.base, *input.positions, input.mesh_of);
    SparseRows placed = terms.base;
    weigh_by_position(terms.frame, *input.positions, input.mesh_of, placed);
    if (base_total > 0.0) terms.placed_share = total(comm, placed) / base_total;
}

}  // namespace

bool asks_for_positions(const std::vector<CutStart>& starts) {
    return std::any_of(starts.begin(), starts.end(),
                       [](const CutStart& start) { return start.graph.placed; });
}

SparseRows base_affinity(const Comm& comm, const SparseCoefficients& coefficients,
                         const std::vector<GlobalPatchNeighbors>& neighbors, const GraphOptions& options) {
    SparseRows base = options.form == AffinityForm::formula_8 ? symmetric_affinity(comm, coefficients)
                                                              : normalized_links(comm, coefficients);
    if (options.minima_rule) apply_minima_rule(base, neighbors);
    return base;
}

GraphTerms graph_terms(const Comm& comm, SparseRows base, const GraphInput& input,
                       const GraphOptions& options) {
    const Comm self(MPI_COMM_SELF);
    const auto size = static_cast<std::int64_t>(input.mesh_of.size());
    const BlockRange all{0, size};
    GraphTerms terms;
    const SparseRows adjacency = adjacency_affinity(all, input.neighbors, input.mesh_of);
    const SparseRows overlap = overlap_affinity(all, input.overlaps, size);
    terms.base = std::move(base);
    const double base_total = total(comm, terms.base);
    const double reference = base_total > 0.0 ? base_total : static_cast<double>(size);
    const double adjacency_total = total(self, adjacency);
    const double overlap_total = total(self, overlap);
    terms.adjacency_scale = adjacency_total > 0.0 ? reference / adjacency_total : 0.0;
    terms.overlap_scale = overlap_total > 0.0 ? reference / overlap_total : 0.0;
    const WeightedMatrix within_mesh_affinity[] = {{&adjacency, terms.adjacency_scale},
                                                   {&overlap, terms.overlap_scale}};
    terms.within_mesh_affinity = weighted_sum(within_mesh_affinity);
    if (options.placed) find_places(comm, input, base_total, terms);
    if (options.complete) {
        terms.base = gather_rows(comm, terms.base);
        terms.adjacency = adjacency;
        terms.overlap = overlap;
    } else {
        terms.adjacency = adjacency_affinity(terms.base.rows, input.neighbors, input.mesh_of);
        terms.overlap = overlap_affinity(terms.base.rows, input.overlaps, size);
    }
    return terms;
}

SparseRows graph_of(const GraphTerms& terms, const GraphInput& input, GraphWeights weights,
                    double drop_below) {
    const double share = weights.placed ? terms.placed_share : 1.0;
    const WeightedMatrix parts[] = {{&terms.base, 1.0},
                                    {&terms.adjacency, share * weights.adjacency * terms.adjacency_scale},
                                    {&terms.overlap, share * weights.overlap * terms.overlap_scale}};
    SparseRows graph = weighted_sum(parts);
    // Between meshes the graph is the base.
    if (weights.placed) weigh_by_position(terms.frame, *input.positions, input.mesh_of, graph);
    if (drop_below > 0.0) drop_small_entries(graph, drop_below);
    return graph;
}

}  // namespace coseg
