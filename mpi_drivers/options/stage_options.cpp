#include "mpi_drivers/options/stage_options.hpp"

#include <charconv>

namespace coseg {

std::optional<LinkChoice> parsed_links(std::string_view text) {
    if (text == "auto") return LinkChoice{};
    if (text == "all") return LinkChoice{LinkChoice::Rule::all, 0};
    LinkChoice links{LinkChoice::Rule::number, 0};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, links.meshes);
    if (error != std::errc() || rest != end || links.meshes < 2) return std::nullopt;
    return links;
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
