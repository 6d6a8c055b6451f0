#include "solvers/partition/prepared_cut.hpp"

#include <optional>

namespace coseg {

GraphInput PreparedCut::graph_input(const CutInput& input) const {
    return {neighbors, overlaps, input.mesh_of, input.positions};
}

PartitionEvidence PreparedCut::evidence(const CutInput& input) const {
    return {neighbors,     overlaps,         input.descriptors,
            input.mesh_of, input.patch_area, links_count ? std::optional(terms.base.view()) : std::nullopt};
}

ClusteringTask PreparedCut::clustering(const CutInput& input, const CutOptions& options,
                                       const std::vector<CutStart>& starts) const {
    return {graph_input(input), terms, starts, options.spectral, options.drop_below, options.parts};
}

PreparedCut prepared_cut(const Comm& comm, const CutInput& input, const CutOptions& options) {
    // At most: an entry and its transpose may fall together, never apart.
    const std::int64_t entries = 2 * all_sum(comm, static_cast<std::int64_t>(input.coefficients.rows.size()));
    const auto patches = static_cast<int>(input.mesh_of.size());
    PreparedCut cut;
    cut.one_rank = entries <= options.one_rank_entries;
    cut.links_count = cut.one_rank && options.choice.links > 0.0;
    cut.neighbors = gather_patch_pairs(comm, input.neighbors_local, patches);
    cut.overlaps = gather_patch_pairs(comm, input.overlaps_local, patches);
    const GraphOptions graphs{.form = options.form,
                              .minima_rule = options.minima_rule,
                              .placed = asks_for_positions(options.starts),
                              .complete = cut.one_rank};
    cut.terms = graph_terms(comm, base_affinity(comm, input.coefficients, cut.neighbors, graphs),
                            {cut.neighbors, cut.overlaps, input.mesh_of, input.positions}, graphs);
    return cut;
}

}  // namespace coseg
