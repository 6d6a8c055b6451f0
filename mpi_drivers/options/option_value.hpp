#pragma once
// An option of a run after parsing: its value as text, and what depends on it.

#include <array>
#include <string>
#include <vector>

#include "src/base/enum_names.hpp"

namespace coseg {

/// The first stage of a run whose outcome changes with an option; all later ones change with it. The order is
/// that of the stages.
enum class Affects {
    /// Where things are, what is said, when a run ends: nothing that a state folder keeps depends on it.
    nothing,
    describe,  ///< the descriptions of meshes
    features,  ///< the features of patches
    solve,     ///< the coefficients
    cut,       ///< the parts of patches
    output,    ///< labels of faces, pictures and other files
};
constexpr std::array<EnumName<Affects>, 6> enum_names(Affects /*type*/) {
    return {{{Affects::nothing, "nothing"},
             {Affects::describe, "describe"},
             {Affects::features, "features"},
             {Affects::solve, "solve"},
             {Affects::cut, "cut"},
             {Affects::output, "output"}}};
}

struct OptionValue {
    std::string key;  ///< the option's name without its dashes
    std::string value;
    Affects affects = Affects::nothing;
};

/// KEY=VALUE, one a line, of the options that affect a stage up to `last`: what a state folder's key of that
/// stage's outcome is made from.
std::string option_text(const std::vector<OptionValue>& values, Affects last);

}  // namespace coseg
