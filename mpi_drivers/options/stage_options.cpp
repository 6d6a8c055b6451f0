#include "mpi_drivers/options/stage_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

#include "src/base/text.hpp"

namespace coseg {

std::optional<LinkChoice> parsed_links(std::string_view text) {
    if (text == "auto") return LinkChoice{};
    if (text == "all") return LinkChoice{LinkChoice::Rule::all, 0};
    const std::optional<int> meshes = whole_number(text);
    if (!meshes || *meshes < 2) return std::nullopt;
    return LinkChoice{LinkChoice::Rule::number, *meshes};
}

std::optional<WeldChoice> parsed_weld(std::string_view text) {
    constexpr double largest = 0.01;
    if (text == "auto") return WeldChoice{};
    if (text == "exact") return WeldChoice{WeldChoice::Rule::exact, 0.0};
    WeldChoice weld{WeldChoice::Rule::within, 0.0};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, weld.tolerance);
    const bool is_in_range = weld.tolerance > 0.0 && weld.tolerance <= largest;
    if (error != std::errc() || rest != end || !is_in_range) return std::nullopt;
    return weld;
}

std::string to_string(const WeldChoice& weld) {
    switch (weld.rule) {
        case WeldChoice::Rule::automatic:
            return "auto";
        case WeldChoice::Rule::exact:
            return "exact";
        case WeldChoice::Rule::within:
            break;
    }
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), weld.tolerance);
    return {text.data(), end};
}

DescriptionOptions with_oversegmentations(DescriptionOptions options, std::size_t shapes) {
    constexpr std::size_t least = 3;
    constexpr std::size_t most = 12;
    constexpr std::size_t in_all = 48;  // of 16 shapes with the least number
    if (options.oversegmentations == found_oversegmentations) {
        const std::size_t wanted = (in_all + shapes - 1) / std::max<std::size_t>(shapes, 1);
        options.oversegmentations = static_cast<int>(std::clamp(wanted, least, most));
    }
    return options;
}

BorderLimits border_limits(const WeldChoice& weld) {
    switch (weld.rule) {
        case WeldChoice::Rule::automatic:
            return {};
        case WeldChoice::Rule::exact:
            return no_border_welding;
        case WeldChoice::Rule::within:
            break;
    }
    return border_welding_within(weld.tolerance);
}

Verbosity ProcessOptions::verbosity() const noexcept {
    if (quiet) return Verbosity::quiet;
    return verbose ? Verbosity::verbose : Verbosity::normal;
}

std::string to_string(const LinkChoice& links) {
    switch (links.rule) {
        case LinkChoice::Rule::automatic:
            return "auto";
        case LinkChoice::Rule::all:
            return "all";
        case LinkChoice::Rule::number:
            break;
    }
    return std::to_string(links.meshes);
}

}  // namespace coseg
