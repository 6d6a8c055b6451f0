#pragma once
// A start of the cut, the terms that speak for the partition that it gave, and their weights. A new term of
// the choice is added here and where it is computed (solvers/choice/partition_terms.cpp), and nowhere
// else.

#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// The graph S = base + adjacency A' + overlap O', with A' and O' of solvers/affinity/affinity.hpp scaled to
/// the total of the base.
struct GraphWeights {
    double adjacency = 0.0;
    double overlap = 0.0;
    /// The base is weighed by the positions of its ends (solvers/affinity/position_correlation.hpp); A' and
    /// O' are scaled to its total then.
    bool placed = false;
    friend bool operator==(const GraphWeights&, const GraphWeights&) = default;
    static constexpr auto fields() {
        return std::tuple(field("adjacency", &GraphWeights::adjacency),
                          field("overlap", &GraphWeights::overlap), field("placed", &GraphWeights::placed));
    }
};

/// One attempt: the graph is cut into `clusters`, and these are merged into the parts
/// (solvers/choice/cluster_merging.hpp).
struct CutStart {
    GraphWeights graph;
    int clusters = 2;
    friend bool operator==(const CutStart&, const CutStart&) = default;
    static constexpr auto fields() {
        return std::tuple(inlined(&CutStart::graph), field("clusters", &CutStart::clusters));
    }
};

/// The share of a descriptor's spread inside the meshes that lies between the parts, in [0, 1]; see
/// between_part_variance().
struct BetweenPartVariance {
    double pooled = 0.0;    ///< with one mean for each part, the same in all meshes
    double per_mesh = 0.0;  ///< with means of each mesh's own; at least `pooled`, up to rounding
    friend bool operator==(const BetweenPartVariance&, const BetweenPartVariance&) = default;
    static constexpr auto fields() {
        return std::tuple(field("pooled", &BetweenPartVariance::pooled),
                          field("per_mesh", &BetweenPartVariance::per_mesh));
    }
};

/// The terms by which partitions are compared; larger is better in each. None depends on which other
/// partitions there are.
struct PartitionTerms {
    std::vector<BetweenPartVariance> explained;  ///< one for each descriptor that the choice uses
    double crease = 0.0;                         ///< see boundary_crease(); at most 0
    double overlap = 0.0;                        ///< see overlap_agreement(); in [0, 1]
    /// The mean concavity mc along the boundaries between parts, weighted by length; in [0, 1].
    double concavity = 0.0;
    double size = 0.0;   ///< see size_steadiness(); at most 0
    double links = 0.0;  ///< see links_inside(); in [0, 1]
    friend bool operator==(const PartitionTerms&, const PartitionTerms&) = default;
    static constexpr auto fields() {
        return std::tuple(
            field("explained", &PartitionTerms::explained), field("crease", &PartitionTerms::crease),
            field("overlap_agreement", &PartitionTerms::overlap),
            field("concavity", &PartitionTerms::concavity), field("size_steadiness", &PartitionTerms::size),
            field("links_inside", &PartitionTerms::links));
    }
};

/// The weights of the terms in the score; those of the explained shares are in the table of descriptors.
/// Source: fitted on labelled sets and generated families, see docs/method.md, section 7.
struct ChoiceWeights {
    double crease = 1.4;
    double overlap = 100.0;
    double concavity = 8.0;
    double size = 4.0;
    double links = 20.0;
};

/// The outcome of a start.
struct StartOutcome {
    CutStart start;
    PartitionTerms terms;
    double score = 0.0;       ///< see partition_score
    int moved = 0;            ///< moves of single patches after the merging; 0 for all but the best starts
    int parts_found = 0;      ///< parts with a patch; fewer than asked for where clusters came out empty
    bool degenerate = false;  ///< see is_degenerate()
    int set_aside = 0;        ///< patches that took no part in the cut and followed their neighbours
    int unreached = 0;        ///< of these: without any labelled neighbour, given to the largest cluster
    friend bool operator==(const StartOutcome&, const StartOutcome&) = default;
    static constexpr auto fields() {
        return std::tuple(
            inlined(&StartOutcome::start), inlined(&StartOutcome::terms),
            field("score", &StartOutcome::score), field("moved", &StartOutcome::moved),
            field("parts_found", &StartOutcome::parts_found), field("degenerate", &StartOutcome::degenerate),
            field("set_aside", &StartOutcome::set_aside), field("unreached", &StartOutcome::unreached));
    }
};

}  // namespace coseg
