#include "mpi_drivers/options/option_checks.hpp"

#include <filesystem>

#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

CLI::Validator gap_from(double least) {
    const auto check = [least](std::string& text) {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        if (is_number && value >= least && value <= 1.0) return std::string();
        return "'" + text + "' is no number from " + significant(least) + " to 1";
    };
    return {check, ""};
}

void refuse_output_over_input(const std::string& option, const std::string& output,
                              const std::vector<std::string>& inputs) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(output, ignored)) return;
    for (const std::string& input : inputs) {
        const std::string file = input.starts_with("@") ? input.substr(1) : input;
        if (std::filesystem::equivalent(output, file, ignored))
            throw Error(ExitCode::usage, option + ": '" + output +
                                             "' is an input, which would be overwritten; name another file");
    }
}

}  // namespace coseg
