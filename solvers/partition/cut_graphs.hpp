#pragma once
// The graphs that the starts of a cut are cut in: links, adjacency and overlap in several proportions.

#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "solvers/affinity/global_patch_pairs.hpp"
#include "solvers/affinity/position_correlation.hpp"
#include "solvers/affinity/shared_sparse_rows.hpp"
#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/start_outcome.hpp"

namespace coseg {

/// What graphs are made of beside the links; as in CutInput.
struct GraphInput {
    const std::vector<GlobalPatchNeighbors>& neighbors;  ///< of all meshes
    const std::vector<GlobalPatchOverlap>& overlaps;     ///< likewise
    const std::vector<int>& mesh_of;
    const Eigen::Matrix3Xd* positions = nullptr;
};

struct GraphOptions {
    AffinityForm form = AffinityForm::links;
    bool minima_rule = true;
    bool placed = false;    ///< a graph is weighed by position
    bool complete = false;  ///< every node holds all rows of the terms, and a rank those of a graph
};

/// The terms of which all graphs are sums.
struct GraphTerms {
    SharedSparseRows base;
    PositionFrame frame;
    double placed_share = 1.0;  ///< total of the base weighed by place over its own
    SharedSparseRows adjacency;
    SharedSparseRows overlap;
    double adjacency_scale = 0.0;
    double overlap_scale = 0.0;
    SharedSparseRows within_mesh_affinity;  ///< A' + O', complete: what a patch set aside follows
};

/// Whether a start's graph is weighed by position.
bool asks_for_positions(const std::vector<CutStart>& starts);

/// The links of which all graphs are made; rows as the coefficients' columns. Collective.
SparseRows base_affinity(const Comm& comm, const SparseCoefficients& coefficients,
                         const std::vector<GlobalPatchNeighbors>& neighbors, const GraphOptions& options);

/// The rows of the terms are those of the base, or all if `complete`. Collective.
GraphTerms graph_terms(const Comm& comm, SparseRows base, const GraphInput& input,
                       const GraphOptions& options);

/// The graph of these weights, rows as those of the terms. Serial.
SparseRows graph_of(const GraphTerms& terms, const GraphInput& input, GraphWeights weights,
                    double drop_below);

}  // namespace coseg
