#pragma once
// The forms of subspace clustering that the paper names besides its own, on the same features and with the
// same kind of result.

#include "solvers/variants/subspace_solver.hpp"
#include "src/base/enum_names.hpp"

namespace coseg {

enum class SubspaceVariant {
    multi_feature,   ///< equations (6)-(7): the problem as it stands
    single_feature,  ///< equation (5): one of its features alone
    /// no consistency penalty: every feature is solved alone, and the coefficients stand side by side.
    independent,
    concatenated,  ///< CFV: the features stacked into one
    ssc,           ///< equation (2) with W >= 0, on the stacked features: beta ||W||_{1,1} alone
    ssc_signed,    ///< the same with W of any sign
    ssqp,          ///< equation (4) on the stacked features: lambda ||W^T W||_{1,1} alone
};

constexpr std::array<EnumName<SubspaceVariant>, 7> enum_names(SubspaceVariant /*type*/) {
    return {{{SubspaceVariant::multi_feature, "multi-feature"},
             {SubspaceVariant::single_feature, "single-feature"},
             {SubspaceVariant::independent, "independent"},
             {SubspaceVariant::concatenated, "concatenated"},
             {SubspaceVariant::ssc, "ssc"},
             {SubspaceVariant::ssc_signed, "ssc-signed"},
             {SubspaceVariant::ssqp, "ssqp"}}};
}

/// Whether the variant keeps the problem's scope and allowed meshes. ssc and ssqp are those of the
/// literature, over all pairs.
bool keeps_scope(SubspaceVariant variant);

/// Solves the variant of `problem`. `feature`, counted from 0, is that of single_feature. With one feature
/// the group norm ||W||_{2,1} is ||W||_{1,1}, so that alpha and beta add up. The coefficients have H values a
/// pair for multi_feature and independent, and one for the others, which may be negative for ssc_signed. The
/// certificate of `independent` is the sum of those of its features. Throws as solve_subspace does, and
/// AgreedError(usage) where there is no such feature. Collective.
SolveResult solve_variant(const Comm& comm, const SubspaceProblem& problem, SubspaceVariant variant,
                          int feature, const SolveOptions& options);

}  // namespace coseg
