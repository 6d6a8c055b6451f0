#pragma once
// A start of the cut, what speaks for the partition that came of it, and how that is weighed. A new term of
// the choice stands here and where it is found (solvers/partition/partition_choice.cpp), and nowhere else.

#include <array>
#include <string_view>
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

/// Which two clusters become one.
enum class MergeRule {
    normalized_cut,  ///< those whose union increases the normalised cut (Shi and Malik 2000) the least
    /// Those with the largest links / sqrt(volume * volume). This spares a small cluster that hangs together
    /// less well than the large ones, which the normalised cut gives up first.
    linkage,
};
constexpr std::array<EnumName<MergeRule>, 2> enum_names(MergeRule /*type*/) {
    return {{{MergeRule::normalized_cut, "normalized_cut"}, {MergeRule::linkage, "linkage"}}};
}

/// One attempt: the graph is cut into `clusters`, these are merged into the parts by their links in it.
struct CutStart {
    GraphWeights graph;
    int clusters = 2;
    MergeRule merging = MergeRule::normalized_cut;
    friend bool operator==(const CutStart&, const CutStart&) = default;
    static constexpr auto fields() {
        return std::tuple(inlined(&CutStart::graph), field("clusters", &CutStart::clusters),
                          field("merging", &CutStart::merging));
    }
};

/// How much of a descriptor's spread inside the meshes lies between the parts, see between_part_variance();
/// in [0, 1].
struct BetweenPartVariance {
    double pooled = 0.0;    ///< by one mean a part, the same in all meshes
    double per_mesh = 0.0;  ///< by means of each mesh's own; at least `pooled`, but for rounding
    friend bool operator==(const BetweenPartVariance&, const BetweenPartVariance&) = default;
    static constexpr auto fields() {
        return std::tuple(field("pooled", &BetweenPartVariance::pooled),
                          field("per_mesh", &BetweenPartVariance::per_mesh));
    }
};

/// What speaks for a partition; larger is better in each.
struct PartitionTerms {
    double crease = 0.0;                         ///< see boundary_crease(); at most 0
    double overlap = 0.0;                        ///< see overlap_agreement(); in [0, 1]
    std::vector<BetweenPartVariance> explained;  ///< per descriptor that the choice looks at
    /// The mean concavity mc along the boundaries between parts, weighted by length; in [0, 1].
    double concavity = 0.0;
    double presence = 0.0;          ///< see presence(); in [0, 1]
    double link_consistency = 0.0;  ///< see link_consistency(); in [0, 1]
    friend bool operator==(const PartitionTerms&, const PartitionTerms&) = default;
    static constexpr auto fields() {
        return std::tuple(
            field("crease", &PartitionTerms::crease), field("overlap_agreement", &PartitionTerms::overlap),
            field("explained", &PartitionTerms::explained), field("concavity", &PartitionTerms::concavity),
            field("presence", &PartitionTerms::presence),
            field("link_consistency", &PartitionTerms::link_consistency));
    }
};

/// How the terms are weighed: crease, overlap and what is explained of the descriptors make a score; among
/// the partitions whose score comes within `margin` of the best, the last three decide together with it.
struct ChoiceWeights {
    double crease = 1.9;
    double overlap = 1.6;
    /// Deviations over the partitions that count at least: where nearly all partitions are alike, what sets
    /// the odd one apart is not magnified.
    double least_crease = 0.2;
    double least_overlap = 0.0025;
    double least_explained = 0.07;
    double margin = 0.3;  ///< share of the way from the best score down to the median of all
    double score = 1.3;   ///< of the score itself among those within the margin
    double concavity = 1.2;
    double presence = 0.8;
    double link_consistency = 0.6;
};

/// What came of a start.
struct StartOutcome {
    CutStart start;
    PartitionTerms terms;
    double score = 0.0;   ///< see partition_scores
    int parts_found = 0;  ///< parts with a patch; fewer than asked for where clusters came out empty
    int set_aside = 0;    ///< patches that took no part in the cut and followed their neighbours
    int unreached = 0;    ///< of these: without any labelled neighbour, given to the largest cluster
    friend bool operator==(const StartOutcome&, const StartOutcome&) = default;
    static constexpr auto fields() {
        return std::tuple(
            inlined(&StartOutcome::start), inlined(&StartOutcome::terms),
            field("score", &StartOutcome::score), field("parts_found", &StartOutcome::parts_found),
            field("set_aside", &StartOutcome::set_aside), field("unreached", &StartOutcome::unreached));
    }
};

}  // namespace coseg
