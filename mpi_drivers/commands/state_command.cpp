// coseg state: what a state folder holds, whether it is whole, and how it gets smaller.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "io/files/hdf5_file.hpp"
#include "io/folders/state_folder.hpp"
#include "io/folders/state_lock.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

enum class StateAction { list, verify, prune };
constexpr std::array<EnumName<StateAction>, 3> enum_names(StateAction /*type*/) {
    return {{{StateAction::list, "list"}, {StateAction::verify, "verify"}, {StateAction::prune, "prune"}}};
}

struct StateOptions {
    std::string directory;
    StateAction action = StateAction::list;
    double unused_days = 30.0;
    bool dry_run = false;
};

constexpr double seconds_per_day = 86400.0;

std::string sized(std::uintmax_t bytes) {
    return decimal(static_cast<double>(bytes) / (1 << 20), 1) + " MiB";
}

std::string counted(const std::vector<StateFile>& files) {
    std::uintmax_t bytes = 0;
    for (const StateFile& file : files) bytes += file.bytes;
    return std::to_string(files.size()) + (files.size() == 1 ? " file, " : " files, ") + sized(bytes);
}

void list(const Comm& world, const StateOptions& options) {
    agree(world, [&] {
        if (!world.is_root()) return;
        const StateFolder folder = StateFolder::open(options.directory);
        const std::vector<StateFile> files = folder.files();
        for (const StateFile& file : files) {
            std::printf("%12ju bytes  unused for %6.1f days  %s  %s\n", file.bytes,
                        static_cast<double>(file.age_seconds) / seconds_per_day,
                        read_summary(file.path).c_str(), file.path.c_str());
        }
        std::printf("%s: %s\n", folder.path().c_str(), counted(files).c_str());
        const std::vector<StateFile> leftovers = folder.leftovers();
        if (!leftovers.empty())
            std::printf("set aside or left behind: %s; coseg state prune removes them\n",
                        counted(leftovers).c_str());
    });
}

/// Every file is read by one of the ranks.
void verify(const Comm& world, const StateOptions& options) {
    std::vector<std::string> paths;
    agree(world, [&] {
        if (!world.is_root()) return;
        for (const StateFile& file : StateFolder::open(options.directory).files()) paths.push_back(file.path);
    });
    broadcast(world, paths);
    std::vector<std::string> damaged;
    for (std::size_t k = static_cast<std::size_t>(world.rank()); k < paths.size();
         k += static_cast<std::size_t>(world.size())) {
        try {
            verify_checksum(paths[k]);
        } catch (const Error& error) {
            damaged.emplace_back(error.what());
        }
    }
    damaged = all_gather_records(world, damaged);
    if (world.is_root()) {
        for (const std::string& sentence : damaged) std::cout << sentence << '\n';
        std::cout << paths.size() - damaged.size() << " of " << paths.size() << " files are whole"
                  << std::endl;
    }
    if (damaged.empty()) return;
    throw AgreedError(ExitCode::input,
                      options.directory + ": " + std::to_string(damaged.size()) +
                          " damaged; a run sets such files aside and computes anew what they held");
}

void remove_files(const std::vector<StateFile>& files) {
    for (const StateFile& file : files) {
        std::error_code cause;
        std::filesystem::remove(file.path, cause);
        if (cause) throw Error(ExitCode::output, file.path + ": cannot be removed (" + cause.message() + ")");
        // The solver's folders are many; one that is empty now goes too, others refuse.
        std::filesystem::remove(std::filesystem::path(file.path).parent_path(), cause);
    }
}

void prune(const Comm& world, const StateOptions& options) {
    agree(world, [&] {
        if (!world.is_root()) return;
        const StateFolder folder = StateFolder::open(options.directory);
        const StateLock lock(folder.lock_file(), LockMode::exclusive);
        std::vector<StateFile> unused;
        for (const StateFile& file : folder.files()) {
            if (static_cast<double>(file.age_seconds) >= options.unused_days * seconds_per_day)
                unused.push_back(file);
        }
        const std::vector<StateFile> leftovers = folder.leftovers();
        if (!options.dry_run) {
            remove_files(unused);
            remove_files(leftovers);
        }
        std::cout << (options.dry_run ? "would remove " : "removed ") << counted(unused) << ", unused for "
                  << options.unused_days << " days or longer, and " << counted(leftovers)
                  << ", set aside or left behind" << std::endl;
    });
}

void run_state(const Comm& world, const StateOptions& options) {
    switch (options.action) {
        case StateAction::list:
            return list(world, options);
        case StateAction::verify:
            return verify(world, options);
        case StateAction::prune:
            return prune(world, options);
    }
}

}  // namespace

Command add_state_command(CLI::App& parent) {
    const auto options = std::make_shared<StateOptions>();
    CLI::App* app = parent.add_subcommand("state", "List, verify or prune the folder of `coseg run --state`");
    add_enum_option(
        *app, "ACTION", options->action,
        "list: files with size, age and content; verify: read all, compare checksums; prune: remove "
        "what has not been used for long, and damaged files")
        ->required();
    app->add_option("DIR", options->directory, "The state folder")->required();
    app->add_option("--unused-days", options->unused_days,
                    "prune: what no run has used for so many days goes")
        ->check(CLI::Range(0.0, 1e6))
        ->check(finite_number)
        ->capture_default_str();
    app->add_flag("--dry-run", options->dry_run, "prune: only say what would be removed");
    return {app, [options](const Invocation& invocation) { run_state(invocation.world, *options); }};
}

}  // namespace coseg
