#include "mpi_drivers/options/named_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "mpi_drivers/options/run_option_table.hpp"
#include "src/base/error.hpp"
#include "src/base/spelling.hpp"

namespace coseg {

namespace {

/// What a caller says in another way, or what has no meaning without a terminal.
constexpr std::array<std::string_view, 9> of_the_command_line = {
    "parts", "out", "force", "strict", "quiet", "verbose", "json-log", "state", "config"};

bool is_of_command_line(const std::string& name) {
    return std::find(of_the_command_line.begin(), of_the_command_line.end(), name) !=
           of_the_command_line.end();
}

void refuse_unusable(const std::vector<NamedOption>& given, const std::vector<std::string>& names) {
    for (const auto& [name, value] : given) {
        if (std::find(names.begin(), names.end(), name) != names.end()) {
            if (!value.empty()) continue;
            throw Error(ExitCode::usage, "'" + name + "' has an empty value; give one, or leave it out");
        }
        const std::string meant = nearest_word(name, names);
        throw Error(ExitCode::usage, "'" + name + "' is no option" +
                                         (meant.empty() ? "; coseg run --help-all lists the options"
                                                        : "; did you mean '" + meant + "'?"));
    }
}

/// The member of every option of the table that has a name here.
template <class T>
std::vector<T> named_in(const RunOptionTable& table, T OptionValue::*member) {
    std::vector<T> members;
    for (const OptionValue& option : table.values()) {
        if (!is_of_command_line(option.key)) members.push_back(option.*member);
    }
    return members;
}

}  // namespace

RunOptions options_by_name(const std::vector<NamedOption>& given) {
    CLI::App app;
    RunOptions options;
    const RunOptionTable table(app, options);
    refuse_unusable(given, named_in(table, &OptionValue::key));
    std::vector<std::string> words = {"--parts=2", "--out=-", "-"};  // required, and given in another way
    for (const auto& [name, value] : given) words.push_back("--" + name + "=" + value);
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        throw Error(ExitCode::usage, error.what());
    }
    options.output.folder.clear();
    options.process.inputs.clear();
    return options;
}

std::vector<std::string> named_option_names() {
    CLI::App app;
    RunOptions options;
    return named_in(RunOptionTable(app, options), &OptionValue::key);
}

std::vector<OptionKind> named_option_kinds() {
    CLI::App app;
    RunOptions options;
    return named_in(RunOptionTable(app, options), &OptionValue::kind);
}

}  // namespace coseg
