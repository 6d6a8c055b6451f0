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
    /// Options that say where things are, what is printed and when a run ends. Nothing that a state folder
    /// keeps depends on them.
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

/// What an option takes. A text may also be a number, as of --links.
enum class OptionKind { on_or_off, whole_number, number, numbers, text };
constexpr std::array<EnumName<OptionKind>, 5> enum_names(OptionKind /*type*/) {
    return {{{OptionKind::on_or_off, "on or off"},
             {OptionKind::whole_number, "whole number"},
             {OptionKind::number, "number"},
             {OptionKind::numbers, "numbers"},
             {OptionKind::text, "text"}}};
}

struct OptionValue {
    std::string key;  ///< the option's name without its dashes
    std::string value;
    Affects affects = Affects::nothing;
    OptionKind kind = OptionKind::text;
};

/// The options that affect a stage up to `last`, as lines of KEY=VALUE. The key of that stage's outcome in a
/// state folder is made from this text.
std::string option_text(const std::vector<OptionValue>& values, Affects last);

}  // namespace coseg
