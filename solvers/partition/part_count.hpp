#pragma once
// Finds out how many parts the shapes of a collection have.

#include <string>
#include <vector>

#include "solvers/partition/cut_input.hpp"
#include "solvers/partition/nested_levels.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/part_count.hpp"

namespace coseg {

/// The numbers that are tried.
constexpr int least_part_count = 2;
constexpr int largest_part_count = 12;

/// What a part more must be worth, and what agreement of the graphs counts against a point of the score.
/// Source: none; looked for on eleven labelled sets and eleven generated families, see docs/method.md,
/// section 7. From .3 to .8 and from 10 to 16 the numbers that are taken hardly change.
constexpr double price_of_part = 0.5;
constexpr double worth_of_agreement = 12.0;

struct CountedParts {
    std::vector<PartCountFigures> figures;  ///< by falling merit
    PartitionsByNumber partitions;          ///< the best ones found
};

/// Partitions into 2 to 12 parts, and the figures of these numbers with the merit
///     score + worth_of_agreement * agreement - price_of_part * parts.
/// Every graph of options.starts is cut into 8, 14 and 24 clusters, which are merged into each number of
/// parts up to two thirds of theirs; the best partitions of two graphs are improved by moves of single
/// patches. options.parts is not looked at, nor are examples. Empty where there are too few patches for 2
/// parts. The same bytes on any number of ranks. Collective. Throws as partition_patches.
CountedParts count_parts(const Comm& comm, const CutInput& input, CutOptions options);

/// Whether the first one is better than the second by more than the price of a part.
bool is_clear(const std::vector<PartCountFigures>& by_merit);

/// One sentence: the number that is taken, the two next ones and why they come after it, and whether nothing
/// is clear.
std::string part_count_sentence(const std::vector<PartCountFigures>& by_merit);

}  // namespace coseg
