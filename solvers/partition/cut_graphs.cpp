#include "solvers/partition/cut_graphs.hpp"

#include <algorithm>
#include <utility>

namespace coseg {

namespace {

void find_places(const Comm& comm, const GraphInput& input, const SparseRows& base, double base_total,
                 GraphTerms& terms) {
    terms.frame = position_frame(comm, base, *input.positions, input.mesh_of);
    SparseRows placed = base;
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
    const auto size = static_cast<std::int64_t>(input.mesh_of.size());
    SparseRows adjacency = adjacency_affinity(base.rows, input.neighbors, input.mesh_of);
    SparseRows overlap = overlap_affinity(base.rows, input.overlaps, size);
    GraphTerms terms;
    const double base_total = total(comm, base);
    const double reference = base_total > 0.0 ? base_total : static_cast<double>(size);
    const double adjacency_total = total(comm, adjacency);
    const double overlap_total = total(comm, overlap);
    terms.adjacency_scale = adjacency_total > 0.0 ? reference / adjacency_total : 0.0;
    terms.overlap_scale = overlap_total > 0.0 ? reference / overlap_total : 0.0;
    const WeightedMatrix within_mesh_affinity[] = {{adjacency, terms.adjacency_scale},
                                                   {overlap, terms.overlap_scale}};
    terms.within_mesh_affinity = {comm, weighted_sum(within_mesh_affinity)};
    if (options.placed) find_places(comm, input, base, base_total, terms);
    const auto held = [&](SparseRows own) {
        return options.complete ? SharedSparseRows(comm, std::move(own)) : SharedSparseRows(std::move(own));
    };
    terms.base = held(std::move(base));
    terms.adjacency = held(std::move(adjacency));
    terms.overlap = held(std::move(overlap));
    return terms;
}

SparseRows graph_of(const GraphTerms& terms, const GraphInput& input, GraphWeights weights,
                    double drop_below) {
    const double share = weights.placed ? terms.placed_share : 1.0;
    const WeightedMatrix parts[] = {
        {terms.base.view(), 1.0},
        {terms.adjacency.view(), share * weights.adjacency * terms.adjacency_scale},
        {terms.overlap.view(), share * weights.overlap * terms.overlap_scale}};
    SparseRows graph = weighted_sum(parts);
    // Between meshes the graph is the base.
    if (weights.placed) weigh_by_position(terms.frame, *input.positions, input.mesh_of, graph);
    if (drop_below > 0.0) drop_small_entries(graph, drop_below);
    return graph;
}

}  // namespace coseg
