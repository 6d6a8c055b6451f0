#pragma once
// The options of `coseg run`: those of its stages, and the presets.

#include <cstdint>
#include <string>
#include <vector>

#include "mpi_drivers/options/stage_options.hpp"

namespace coseg {

struct RunOptions {
    /// The name for the report alone. The values that it means are in the options of the stages.
    std::string preset = "default";
    DescriptionOptions description;
    FeatureOptions features;
    OptimiseOptions optimise;
    PartitionOptions partition;
    OutputOptions output;
    ProcessOptions process;
};

/// Whether corrections and constraints follow the parts of such a run: two parts or more, of one normalised
/// cut of the whole collection.
bool can_be_corrected(const PartitionOptions& partition);

/// Throws AgreedError(usage) where options exclude each other. The options are the same on every rank.
void refuse_contradictions(const RunOptions& options);

/// The options with which new shapes are labelled like those of a run: those of describing and labelling are
/// the run's, and the others are `own`.
RunOptions options_of_assignment(const RunOptions& run, const RunOptions& own);

/// Gives every stage that draws at random the same seed.
void set_seed(RunOptions& options, std::uint64_t seed);

/// The options of a description with the descriptors to compute: all that count by default, whatever their
/// weights, so that a state folder serves other weights too; others where they have a weight.
DescriptionOptions description_options(const RunOptions& options);

/// The names of the presets, in the order of --help.
std::vector<std::string> preset_names();

/// The values that a preset stands for: "default"; "paper" for the text of Hu, Fan and Liu (2012), and where
/// that is silent for the code that it names; and what the two are to be compared with: "single:FEATURE",
/// "independent", "concatenated", "descriptor-space". Options given on the command line or in the
/// configuration file override the preset's. `preset`: one of preset_names().
RunOptions preset_options(const std::string& preset);

}  // namespace coseg
