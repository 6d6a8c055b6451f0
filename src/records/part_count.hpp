#pragma once
// What speaks for a number of parts, where the number is not given.

#include <tuple>

#include "src/records/fields.hpp"

namespace coseg {

struct PartCountFigures {
    int parts = 0;
    double score = 0.0;        ///< of the best partition found, see partition_score
    double least_share = 0.0;  ///< of the area, mean over meshes: that of the smallest part
    double rarest = 0.0;       ///< share of the meshes that have the part which fewest have
    /// Mean adjusted Rand index, by area, of the best partition and the best ones of the other graphs; at
    /// most 1.
    double agreement = 0.0;
    double merit = 0.0;  ///< by which numbers are compared, see count_parts()
    friend bool operator==(const PartCountFigures&, const PartCountFigures&) = default;
    static constexpr auto fields() {
        return std::tuple(
            field("parts", &PartCountFigures::parts), field("score", &PartCountFigures::score),
            field("least_share", &PartCountFigures::least_share), field("rarest", &PartCountFigures::rarest),
            field("agreement", &PartCountFigures::agreement), field("merit", &PartCountFigures::merit));
    }
};

}  // namespace coseg
