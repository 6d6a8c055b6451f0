#pragma once
// The command line of the program: all subcommands, the parsing of what the user gave, and what is said of
// mistakes in it.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mpi_drivers/options/command.hpp"
#include "src/base/error.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/launch_request.hpp"

namespace coseg {

/// Says what went wrong, on rank 0 alone, and returns the exit code.
int told(const Error& error, bool is_root);

class CommandLine {
  public:
    CommandLine(int argc, char** argv);

    /// Parses the words. Returns the exit code if the program is to end with it, after --help, --version or
    /// a mistake, which are then answered; nothing if a command is to run. This form is for a process that
    /// works alone and needs no MPI. Call one of the two, once.
    std::optional<int> parse();
    /// The same on all ranks, of which rank 0 reads the file of --config and answers. Collective.
    std::optional<int> parse(const Comm& comm);

    /// Whether the run has a state folder. Before anything is parsed, one that only a configuration file
    /// names is not seen.
    [[nodiscard]] bool keeps_state() const;
    /// How the parsed command is to be started, if it divides its work over ranks.
    [[nodiscard]] std::optional<LaunchRequest> launch_request() const;
    /// Runs the parsed command. Throws as Command::run does; collective.
    void run(const Comm& world) const;

  private:
    /// What the parsing of all words comes to, which `read` gives from those of the command line and an
    /// OptionTest of keys that are passed over.
    template <class Read>
    std::optional<int> answered(bool is_root, Read&& read);
    void parse_words(std::vector<std::string> words);
    /// Whether coseg run has the option and the given command has it not: commands that describe meshes for a
    /// run read the file of that run.
    [[nodiscard]] bool is_of_runs_alone(const std::string& option) const;
    [[nodiscard]] const Command* parsed_command() const;

    std::vector<std::string> words_;            // before `--`
    std::vector<std::string> petsc_arguments_;  // after `--`
    CLI::App app_;
    std::vector<Command> commands_;
};

}  // namespace coseg
