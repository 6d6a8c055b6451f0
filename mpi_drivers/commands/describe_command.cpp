// coseg describe: the first stage of a run alone, into a state folder; also one shard of it, for job arrays.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/run_option_table.hpp"
#include "mpi_drivers/process/run_state.hpp"

namespace coseg {

namespace {

struct Shard {
    int index = 0;
    int count = 1;
};

Shard parsed_shard(const std::string& text) {
    Shard shard;
    char rest = 0;
    const bool good = std::sscanf(text.c_str(), "%d/%d%c", &shard.index, &shard.count, &rest) == 2 &&
                      shard.count >= 1 && 0 <= shard.index && shard.index < shard.count;
    if (good) return shard;
    throw AgreedError(ExitCode::usage,
                      "--shard " + text + ": write I/N, a number from 0 to N-1 and their count, e.g. 0/8");
}

/// Every N-th by size, so that shards take about the same time.
std::vector<MeshEntry> entries_of(const Shard& shard, std::vector<MeshEntry> entries) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const MeshEntry& a, const MeshEntry& b) { return a.bytes > b.bytes; });
    std::vector<MeshEntry> own;
    for (std::size_t k = static_cast<std::size_t>(shard.index); k < entries.size();
         k += static_cast<std::size_t>(shard.count)) {
        own.push_back(std::move(entries[k]));
    }
    return own;
}

void describe(const Comm& world, const RunOptions& options, const std::string& shard_text) {
    const Shard shard = parsed_shard(shard_text);
    const ProcessOptions& process = options.process;
    StageLog log(world, process.verbosity(), process.log_form());
    const RunState state(world, process.state, LockMode::shared, process.checkpoint_seconds);
    const std::vector<MeshEntry> all = list_meshes(world, process.inputs);
    const DescriptionOptions description = with_oversegmentations(description_options(options), all.size());
    log.begin("describe");
    const DescribeTotals totals =
        describe_into_state(world, entries_of(shard, all), description, process.strict, state, log);
    log.end(std::to_string(totals.described) + " described, " + std::to_string(totals.reused) +
            " were in the state folder");
    for (const SetAside& mesh : totals.set_aside) log.warn("set aside: " + mesh.reason);
    for (const std::string& warning : totals.warnings) log.warn(warning);
}

}  // namespace

Command add_describe_command(CLI::App& parent) {
    CLI::App* app = parent.add_subcommand(
        "describe", "Patches and descriptors of meshes into a state folder, for runs to come");
    const auto options = std::make_shared<RunOptions>();
    const auto shard = std::make_shared<std::string>("0/1");
    const auto table = std::make_shared<RunOptionTable>(*app, *options, OptionSet::describe);
    app->add_option("--shard", *shard, "I/N: only the I-th (from 0) of N parts of the meshes, for job arrays")
        ->capture_default_str();
    return {app, [options, shard, table](const Invocation& invocation) {
                describe(invocation.world, *options, *shard);
            }};
}

}  // namespace coseg
