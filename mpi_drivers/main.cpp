// The one entry and the one exit: parses the command line, runs a subcommand, and turns every failure into
// one sentence on rank 0 and a documented exit code on all ranks.

#include <malloc.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/config_file.hpp"
#include "mpi_drivers/options/help_pages.hpp"
#include "mpi_drivers/process/mpi_start.hpp"
#include "mpi_drivers/process/self_launch.hpp"
#include "mpi_drivers/process/signals.hpp"
#include "mpi_drivers/process/version.hpp"
#include "src/base/error.hpp"
#include "src/base/spelling.hpp"

namespace {

using coseg::AgreedError;
using coseg::Comm;
using coseg::Error;
using coseg::ExitCode;

struct Arguments {
    std::vector<std::string> own;    ///< before `--`
    std::vector<std::string> petsc;  ///< after `--`
};

Arguments split_arguments(int argc, char** argv) {
    Arguments arguments;
    bool after_dashes = false;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (!after_dashes && argument == "--") {
            after_dashes = true;
        } else {
            (after_dashes ? arguments.petsc : arguments.own).push_back(argument);
        }
    }
    return arguments;
}

/// CLI11 would only say that a subcommand is required.
void refuse_unknown_command(const std::vector<coseg::Command>& commands,
                            const std::vector<std::string>& words) {
    if (words.empty() || words.front().starts_with("-")) return;
    const std::string& first = words.front();
    std::string list;
    std::vector<std::string> names;
    for (const coseg::Command& command : commands) {
        if (command.app->get_name() == first) return;
        names.push_back(command.app->get_name());
        list += (list.empty() ? "" : ", ") + names.back();
    }
    const std::string meant = coseg::nearest_word(first, names);
    throw CLI::ParseError("'" + first + "' is not a command" +
                              (meant.empty() ? "" : "; did you mean " + meant + "?") +
                              (meant.empty() ? "; the" : " The") + " commands are " + list,
                          CLI::ExitCodes::ExtrasError);
}

/// Every rank parses the same words, so every rank fails alike and only rank 0 speaks.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error, bool is_root) {
    if (error.get_exit_code() == 0) return is_root ? app.exit(error) : 0;  // --help, --version
    if (is_root) {
        std::fprintf(stderr, "coseg: %s\nRun 'coseg --help' or 'coseg COMMAND --help' for the options.\n",
                     error.what());
    }
    return static_cast<int>(ExitCode::usage);
}

int agreed_exit(const AgreedError& error, bool is_root) {
    if (is_root) std::fprintf(stderr, "coseg: %s\n", error.what());
    return static_cast<int>(error.code());
}

/// A failure that the other ranks do not know of: they may wait in a collective call, so all are ended here.
[[noreturn]] void end_all_ranks(int rank, const std::string& cause, ExitCode code) {
    std::fprintf(stderr, "coseg: rank %d: %s\n", rank, cause.c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    std::abort();
}

int run_command(const std::vector<coseg::Command>& commands, const coseg::Invocation& invocation) {
    const Comm& world = invocation.world;
    try {
        for (const coseg::Command& command : commands) {
            if (command.app->parsed()) command.run(invocation);
        }
        return static_cast<int>(ExitCode::success);
    } catch (const AgreedError& error) {
        return agreed_exit(error, world.is_root());
    } catch (const Error& error) {
        if (world.size() == 1) return agreed_exit(AgreedError(error.code(), error.what()), true);
        end_all_ranks(world.rank(), error.what(), error.code());
    } catch (const std::bad_alloc&) {
        end_all_ranks(world.rank(), "out of memory; use more nodes or fewer shapes", ExitCode::internal);
    } catch (const std::exception& error) {
        end_all_ranks(world.rank(), error.what(), ExitCode::internal);
    }
}

int parse_and_run(const Comm& world, int argc, char** argv) {
    const Arguments arguments = split_arguments(argc, argv);
    CLI::App app("coseg: co-segmentation of collections of 3D shapes", "coseg");
    app.set_version_flag("--version", coseg::version_text);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 success, 1 internal error, 2 usage, 3 input, 4 output, 5 no convergence, "
        "75 checkpointed (the same command continues).");
    const std::vector<coseg::Command> commands = {
        coseg::add_run_command(app),    coseg::add_assign_command(app),   coseg::add_render_command(app),
        coseg::add_report_command(app), coseg::add_export_command(app),   coseg::add_score_command(app),
        coseg::add_check_command(app),  coseg::add_generate_command(app), coseg::add_describe_command(app),
        coseg::add_state_command(app),  coseg::add_cluster_command(app),  coseg::add_solve_command(app),
        coseg::add_edit_command(app),   coseg::add_man_command(app),      coseg::add_completion_command(app)};
    if (arguments.own.empty()) {
        if (world.is_root()) {
            std::cout << app.help() << std::flush;
            std::fputs("coseg: a subcommand is required, as in 'coseg run'\n", stderr);
        }
        return static_cast<int>(ExitCode::usage);
    }
    try {
        refuse_unknown_command(commands, arguments.own);
        std::vector<std::string> words = coseg::with_config_file(world, arguments.own);
        for (const coseg::Command& command : commands) {
            if (!words.empty() && command.app->get_name() == words.front())
                coseg::refuse_unknown_options(*command.app, words);
        }
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(words);
        for (const coseg::Command& command : commands) {
            if (command.app->parsed()) coseg::refuse_empty_values(*command.app);
        }
    } catch (const CLI::ParseError& error) {
        return report_parse_error(app, error, world.is_root());
    } catch (const AgreedError& error) {
        return agreed_exit(error, world.is_root());
    } catch (const std::exception& error) {
        return agreed_exit(AgreedError(ExitCode::internal, error.what()), world.is_root());
    }
    return run_command(commands, {world, arguments.petsc});
}

/// A result that could not be printed (a full disk, a closed pipe) is no success.
int with_output_written(int code) {
    std::cout.flush();
    if (std::cout.good() || code != static_cast<int>(ExitCode::success)) return code;
    std::fprintf(stderr, "coseg: standard output cannot be written; redirect it to where there is space\n");
    return static_cast<int>(ExitCode::output);
}

/// A state folder that only a configuration file names is not seen here.
bool has_state_folder(int argc, char** argv) {
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
        const std::string_view word = argv[i];
        if (word == "--state" || word.starts_with("--state=")) return true;
    }
    return false;
}

/// libpsm2, which Open MPI loads whether there is such a network or not, makes malloc keep what is freed, for
/// the sake of pinned pages: large arrays are then cut from one heap, which grows with every stage and never
/// shrinks.
void return_freed_memory() {
    constexpr int mebibyte = 1 << 20;
    mallopt(M_MMAP_MAX, 65536);  // glibc's own value
    mallopt(M_MMAP_THRESHOLD, 4 * mebibyte);
    mallopt(M_TRIM_THRESHOLD, 64 * mebibyte);
}

}  // namespace

// What is thrown outside a subcommand (out of memory at start) may end the program at once.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
    coseg::launch_on_all_cores(argc, argv);
    if (has_state_folder(argc, argv)) coseg::heed_stop_requests();
    coseg::let_long_files_fail();
    coseg::initialise_mpi(MPI_THREAD_FUNNELED);  // threads that watch call no MPI
    return_freed_memory();
    int code = 0;
    {
        const Comm world(MPI_COMM_WORLD);
        code = with_output_written(parse_and_run(world, argc, argv));
    }
    MPI_Finalize();
    return code;
}
