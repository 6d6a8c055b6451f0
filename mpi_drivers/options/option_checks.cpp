#include "mpi_drivers/options/option_checks.hpp"

#include <unistd.h>

#include <filesystem>

#include "io/files/atomic_file.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

/// Devices and pipes may be written to by several; files may not, and those that are not there yet.
bool are_one_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    for (const std::string& path : {a, b}) {
        const fs::file_status status = fs::status(path, ignored);
        if (fs::exists(status) && !fs::is_regular_file(status)) return false;
    }
    return fs::weakly_canonical(fs::absolute(a, ignored), ignored) ==
           fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

}  // namespace

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
    if (!fs::is_regular_file(output, ignored)) return;
    for (const std::string& input : inputs) {
        const std::string file = input.starts_with("@") ? input.substr(1) : input;
        if (fs::equivalent(output, file, ignored))
            throw Error(ExitCode::usage, option + ": '" + output +
                                             "' is an input, which would be overwritten; name another file");
    }
}

void check_output_files(const std::vector<std::pair<std::string, std::string>>& outputs,
                        const std::vector<std::string>& inputs) {
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const auto& [option, path] = outputs[k];
        if (path.empty()) continue;
        refuse_output_over_input(option, path, inputs);
        for (std::size_t i = 0; i < k; ++i) {
            if (!outputs[i].second.empty() && are_one_file(outputs[i].second, path))
                throw Error(ExitCode::usage, outputs[i].first + " and " + option + " name the same file '" +
                                                 path + "'; name two files");
        }
        try_file(path);
    }
}

void check_output_folder(const std::string& folder) {
    std::error_code cause;
    const fs::path path = fs::absolute(folder, cause);
    const auto refuse = [&](const std::string& why) {
        throw Error(ExitCode::output, folder + ": cannot be made (" + why + "); name another folder");
    };
    for (fs::path part = path; !part.empty(); part = part.parent_path()) {
        const fs::file_status status = fs::status(part, cause);
        if (cause == std::errc::filename_too_long) refuse(cause.message());
        if (fs::exists(status) && !fs::is_directory(status)) refuse(part.string() + " is a file");
        if (fs::exists(status) && ::access(part.c_str(), W_OK | X_OK) != 0)
            refuse(part.string() + " cannot be written to");
        if (fs::exists(status) || part == part.parent_path()) return;
    }
}

}  // namespace coseg
