#include "mpi_drivers/options/weld_option.hpp"

#include <string>

namespace coseg {

namespace {

const CLI::Validator weld_text(
    [](std::string& text) {
        return parsed_weld(text)
                   ? std::string()
                   : text + " is none of auto, exact and a share of the size above 0 and up to 0.01";
    },
    "auto|exact|SHARE");

}  // namespace

CLI::Option* add_weld_option(CLI::App& app, WeldChoice& variable) {
    const auto take = [&variable](const std::string& text) { variable = parsed_weld(text).value(); };
    return app.add_option_function<std::string>("--weld", take, weld_help)
        ->check(weld_text)
        ->default_str(to_string(variable));
}

}  // namespace coseg
