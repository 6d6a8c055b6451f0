#include "mpi_drivers/commands/command_line.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <utility>

#include "mpi_drivers/options/config_file.hpp"
#include "mpi_drivers/options/help_pages.hpp"
#include "mpi_drivers/options/launch_option.hpp"
#include "mpi_drivers/process/version.hpp"
#include "src/base/spelling.hpp"

namespace coseg {

namespace {

std::vector<Command> all_commands(CLI::App& app) {
    return {add_run_command(app),    add_assign_command(app),   add_render_command(app),
            add_report_command(app), add_export_command(app),   add_score_command(app),
            add_check_command(app),  add_generate_command(app), add_describe_command(app),
            add_state_command(app),  add_cluster_command(app),  add_solve_command(app),
            add_edit_command(app),   add_man_command(app),      add_completion_command(app)};
}

/// CLI11 would only say that a subcommand is required.
void refuse_unknown_command(const std::vector<Command>& commands, const std::string& first) {
    if (first.starts_with("-")) return;
    std::string list;
    std::vector<std::string> names;
    for (const Command& command : commands) {
        if (command.app->get_name() == first) return;
        names.push_back(command.app->get_name());
        list += (list.empty() ? "" : ", ") + names.back();
    }
    const std::string meant = nearest_word(first, names);
    throw CLI::ParseError("'" + first + "' is not a command" +
                              (meant.empty() ? "" : "; did you mean " + meant + "?") +
                              (meant.empty() ? "; the" : " The") + " commands are " + list,
                          CLI::ExitCodes::ExtrasError);
}

/// Every rank parses the same words, so every rank fails alike and only rank 0 speaks.
int told_parse_error(const CLI::App& app, const CLI::ParseError& error, bool is_root) {
    if (error.get_exit_code() == 0) return is_root ? app.exit(error) : 0;  // --help, --version
    if (is_root) {
        std::fprintf(stderr, "coseg: %s\nRun 'coseg --help' or 'coseg COMMAND --help' for the options.\n",
                     error.what());
    }
    return static_cast<int>(ExitCode::usage);
}

int told_of_no_command(const CLI::App& app, bool is_root) {
    if (is_root) {
        std::cout << app.help() << std::flush;
        std::fputs("coseg: a subcommand is required, as in 'coseg run'\n", stderr);
    }
    return static_cast<int>(ExitCode::usage);
}

}  // namespace

int told(const Error& error, bool is_root) {
    if (is_root) std::fprintf(stderr, "coseg: %s\n", error.what());
    return static_cast<int>(error.code());
}

CommandLine::CommandLine(int argc, char** argv)
    : app_("coseg: co-segmentation of collections of 3D shapes", "coseg") {
    char** const end = argv + argc;
    char** const dashes = std::find_if(argv + std::min(argc, 1), end,
                                       [](const char* word) { return std::string_view(word) == "--"; });
    words_.assign(argv + std::min(argc, 1), dashes);
    if (dashes != end) petsc_arguments_.assign(dashes + 1, end);
    app_.set_version_flag("--version", version_text);
    app_.require_subcommand(1);
    app_.footer(
        "Exit codes: 0 success, 1 internal error, 2 usage, 3 input, 4 output, 5 no convergence, "
        "75 checkpointed (the same command continues).");
    commands_ = all_commands(app_);
}

void CommandLine::parse_words(std::vector<std::string> words) {
    for (const Command& command : commands_) {
        if (command.app->get_name() == words.front()) refuse_unknown_options(*command.app, words);
    }
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app_.parse(words);
    if (const Command* command = parsed_command()) refuse_empty_values(*command->app);
}

template <class Read>
std::optional<int> CommandLine::answered(bool is_root, Read&& read) {
    if (words_.empty()) return told_of_no_command(app_, is_root);
    try {
        refuse_unknown_command(commands_, words_.front());
        parse_words(read(words_, [this](const std::string& option) { return is_of_runs_alone(option); }));
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        return told_parse_error(app_, error, is_root);
    } catch (const Error& error) {
        return told(error, is_root);
    } catch (const std::exception& error) {
        return told(Error(ExitCode::internal, error.what()), is_root);
    }
}

bool CommandLine::is_of_runs_alone(const std::string& option) const {
    const auto has_option = [&](const std::string& name) {
        return std::any_of(commands_.begin(), commands_.end(), [&](const Command& command) {
            return command.app->get_name() == name && command.app->get_option_no_throw(option) != nullptr;
        });
    };
    return has_option("run") && !has_option(words_.front());
}

std::optional<int> CommandLine::parse() {
    return answered(true,
                    [](const auto& words, const OptionTest& test) { return with_config_file(words, test); });
}

std::optional<int> CommandLine::parse(const Comm& comm) {
    return answered(comm.is_root(), [&](const auto& words, const OptionTest& test) {
        return with_config_file(comm, words, test);
    });
}

bool CommandLine::keeps_state() const {
    const std::optional<LaunchRequest> request = launch_request();
    return is_given(words_, "--state") || (request && request->keeps_state);
}

std::optional<LaunchRequest> CommandLine::launch_request() const {
    const Command* command = parsed_command();
    return command == nullptr ? std::nullopt : coseg::launch_request(*command->app);
}

void CommandLine::run(const Comm& world) const {
    if (const Command* command = parsed_command()) command->run({world, petsc_arguments_});
}

const Command* CommandLine::parsed_command() const {
    const auto found = std::find_if(commands_.begin(), commands_.end(),
                                    [](const Command& command) { return command.app->parsed(); });
    return found == commands_.end() ? nullptr : &*found;
}

}  // namespace coseg
