#pragma once
// What `coseg run` is asked to do: the options of its stages, and the presets.

#include <cstdint>
#include <string>
#include <vector>

#include "mpi_drivers/options/stage_options.hpp"

namespace coseg {

struct RunOptions {
    /// For the report alone: what it stands for is in the options of the stages.
    std::string preset = "default";
    DescriptionOptions description;
    FeatureOptions features;
    OptimiseOptions optimise;
    PartitionOptions partition;
    OutputOptions output;
    ProcessOptions process;
};

/// Throws AgreedError(usage) where options cannot be joined. The same on every rank.
void refuse_contradictions(const RunOptions& options);

/// What labels new shapes like those of a run: how they are described and labelled is the run's, the rest
/// `own`.
RunOptions options_of_assignment(const RunOptions& run, const RunOptions& own);

/// Gives every stage that draws at random the same seed.
void set_seed(RunOptions& options, std::uint64_t seed);

/// The options of a description with the descriptors to compute: all that count by default, whatever their
/// weights, so that a state folder serves other weights too; others where they have a weight.
DescriptionOptions description_options(const RunOptions& options);

/// The names of the presets, in the order of --help.
std::vector<std::string> preset_names();

/// The values that a preset stands for: "default"; "paper" for the literal text of Hu, Fan and Liu (2012);
/// and what the two are to be compared with: "single:FEATURE", "independent", "concatenated",
/// "descriptor-space". Options given on the command line or in the configuration file override the preset's.
/// `preset`: one of preset_names().
RunOptions preset_options(const std::string& preset);

}  // namespace coseg
