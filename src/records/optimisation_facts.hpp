#pragma once
// The problem that a run has solved, for its report.

#include <cstdint>
#include <string>
#include <tuple>

#include "src/records/fields.hpp"

namespace coseg {

struct OptimisationFacts {
    std::string variant;
    /// The scope that was used. One mesh alone is always solved in row scope, and ssc and ssqp too.
    std::string scope;
    int links = 0;          ///< the number of meshes in which a patch may have matches, at most
    int subsets = 1;        ///< the number of subsets in which the collection was solved
    int common_meshes = 0;  ///< meshes in every subset, if there are several
    /// The mean share of the common meshes' area on which a subset agrees with the first.
    double subset_agreement = 1.0;
    std::int64_t allowed_pairs = 0;  ///< the number of pairs that the certificate covers
    static constexpr auto fields() {
        return std::tuple(
            field("variant", &OptimisationFacts::variant), field("scope", &OptimisationFacts::scope),
            field("links", &OptimisationFacts::links), field("subsets", &OptimisationFacts::subsets),
            field("common_meshes", &OptimisationFacts::common_meshes),
            field("subset_agreement", &OptimisationFacts::subset_agreement),
            field("allowed_pairs", &OptimisationFacts::allowed_pairs));
    }
};

}  // namespace coseg
