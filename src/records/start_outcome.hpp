#pragma once
// A start of the cut, the terms that speak for the partition that it gave, and their weights. A new term of
// the choice is added here and where it is computed (solvers/partition/partition_choice.cpp), and nowhere
// else.

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

/// Says which two clusters are merged next.
enum class MergeRule {
    normalized_cut,  ///< those whose union raises the normalised cut (Shi and Malik 2000) the least
    /// Those with the largest links / sqrt(volume * volume). This spares a small cluster that hangs together
    /// less well than the large ones, which the normalised cut gives up first.
    linkage,
};
constexpr std::array<EnumName<MergeRule>, 2> enum_names(MergeRule /*type*/) {
    return {{{MergeRule::normalized_cut, "normalized_cut"}, {MergeRule::linkage, "linkage"}}};
}

/// One attempt: the graph is cut into `clusters`, and these are merged into the parts by their links in it.
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

/// The terms by which partitions are compared; larger is better in each.
struct PartitionTerms {
    double crease = 0.0;                         ///< see boundary_crease(); at most 0
    double overlap = 0.0;                        ///< see overlap_agreement(); in [0, 1]
    std::vector<BetweenPartVariance> explained;  ///< one for each descriptor that the choice uses
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

/// The weights of the terms. Crease, overlap and the explained shares of the descriptors make a score. Among
/// the partitions whose score comes within `margin` of the best, the last three terms decide together with
/// the score.
struct ChoiceWeights {
    double crease = 1.9;
    double overlap = 1.6;
    /// The least standard deviations over the partitions. Where nearly all partitions are alike, a deviation
    /// below these would magnify what is different in the odd one.
    double least_crease = 0.2;
    double least_overlap = 0.0025;
    double least_explained = 0.07;
    double margin = 0.3;  ///< share of the way from the best score to the median of all
    double score = 1.3;   ///< weight of the score among the partitions within the margin
    double concavity = 1.2;
    double presence = 0.8;
    double link_consistency = 0.6;
};

/// The outcome of a start.
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
