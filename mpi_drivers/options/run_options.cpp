#include "mpi_drivers/options/run_options.hpp"

#include <algorithm>

#include "src/base/error.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

namespace {

/// The paper's text, and where that is silent the code that it names.
RunOptions as_in_the_paper() {
    RunOptions options;
    options.description.oversegmentations = 1;
    options.description.cut_noise = 0.0;
    options.features.histogram = HistogramScaling::unit_sum;
    options.features.ranges = BinRanges::global;
    options.features.weights = equal_descriptor_weights();
    options.optimise.scope = PenaltyScope::rows;
    options.optimise.lambda = 1000.0;
    options.partition.affinity = AffinityForm::formula_8;
    options.partition.drop_below = 1e-6;
    options.partition.cut_offset = 0.5;
    options.partition.adjacency = 0.0;
    options.partition.overlap = 0.0;
    options.partition.mesh_balance = 0.0;
    options.partition.choose = false;
    options.output.refine = RefineMode::fuzzy;
    return options;
}

RunOptions of_variant(SubspaceVariant variant) {
    RunOptions options;
    options.optimise.variant = variant;
    return options;
}

/// A descriptor that has no weight by default gets one.
RunOptions of_feature(const std::string& name) {
    RunOptions options = of_variant(SubspaceVariant::single_feature);
    options.optimise.feature = name;
    const std::vector<std::string> names = descriptor_names();
    for (std::size_t row = 0; row < names.size(); ++row) {
        double& weight = options.features.weights[row];
        if (names[row] == name && !(weight > 0.0)) weight = 1.0;
    }
    return options;
}

/// Sidi et al. 2011: one over-segmentation, descriptors that count alike, clusters in a diffusion map.
RunOptions in_descriptor_space() {
    RunOptions options;
    options.description.oversegmentations = 1;
    options.description.cut_noise = 0.0;
    options.features.weights = equal_descriptor_weights();
    options.partition.method = PartitionMethod::diffusion;
    return options;
}

/// A row a preset, with its name among its values.
std::vector<RunOptions> presets() {
    std::vector<RunOptions> all;
    const auto add = [&](const std::string& name, RunOptions options) {
        options.preset = name;
        all.push_back(std::move(options));
    };
    add("default", {});
    add("paper", as_in_the_paper());
    for (const std::string& name : descriptor_names()) add("single:" + name, of_feature(name));
    add("independent", of_variant(SubspaceVariant::independent));
    add("concatenated", of_variant(SubspaceVariant::concatenated));
    add("descriptor-space", in_descriptor_space());
    return all;
}

/// Whether the parts are not those of one normalised cut of the whole collection.
bool cuts_otherwise(const PartitionOptions& partition) {
    return partition.subsets > 0 || partition.segments || partition.method == PartitionMethod::diffusion;
}

}  // namespace

bool can_be_corrected(const PartitionOptions& partition) {
    return !cuts_otherwise(partition) && partition.parts != 1;
}

void refuse_contradictions(const RunOptions& options) {
    const std::vector<double>& weights = options.features.weights;
    const bool has_own =
        !options.features.face_features.empty() && options.features.face_feature_weight > 0.0;
    if (!has_own && std::none_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; }))
        throw AgreedError(ExitCode::usage,
                          "--feature-weights: all are zero; give at least one that is positive");
    const PartitionOptions& partition = options.partition;
    const bool is_cut_otherwise = cuts_otherwise(partition);
    const bool is_chosen = partition.choose && !is_cut_otherwise;
    if (!partition.examples.empty() && is_cut_otherwise)
        throw AgreedError(ExitCode::usage,
                          "--examples cannot be joined with --subsets, --segments or --partition diffusion");
    if ((!partition.corrections.empty() || !partition.constraints.empty()) && !can_be_corrected(partition))
        throw AgreedError(ExitCode::usage,
                          "--corrections and --constraints need two parts or more, and cannot be joined with "
                          "--subsets, --segments or --partition diffusion");
    if (partition.levels && (!is_chosen || partition.parts == 1))
        throw AgreedError(
            ExitCode::usage,
            "--levels needs two parts or more, and cannot be joined with --no-choose, --subsets, "
            "--segments or --partition diffusion");
    if (partition.parts == found_parts && !is_chosen)
        throw AgreedError(ExitCode::usage,
                          "--parts auto compares partitions by their scores, and cannot be joined with "
                          "--no-choose (which --preset paper sets), --subsets, --segments or --partition "
                          "diffusion; give --parts a number");
    // An offset, as the paper's code adds one to the affinity, leaves the balance without a meaning.
    if (options.partition.cut_offset > 0.0 && options.partition.mesh_balance > 0.0)
        throw AgreedError(ExitCode::usage,
                          "--mesh-balance cannot be joined with --cut-offset, which --preset paper sets; "
                          "leave one of them out");
}

RunOptions options_of_assignment(const RunOptions& run, const RunOptions& own) {
    RunOptions options = run;
    options.process = own.process;
    options.output = own.output;
    options.output.refine = run.output.refine;
    options.output.keep_model = false;
    options.features.face_features = own.features.face_features;
    options.partition.examples = own.partition.examples;
    return options;
}

void set_seed(RunOptions& options, std::uint64_t seed) {
    options.description.seed = seed;
    options.features.seed = seed;
    options.optimise.seed = seed;
    options.partition.seed = seed;
}

DescriptionOptions description_options(const RunOptions& options) {
    DescriptionOptions description = options.description;
    description.descriptors.clear();
    const std::vector<Descriptor>& table = descriptor_table();
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table[row].weight > 0.0 || options.features.weights.at(row) > 0.0)
            description.descriptors.push_back(static_cast<int>(row));
    }
    return description;
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const RunOptions& preset : presets()) names.push_back(preset.preset);
    return names;
}

RunOptions preset_options(const std::string& preset) {
    const std::vector<RunOptions> all = presets();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const RunOptions& row) { return row.preset == preset; });
    if (found == all.end()) throw Error(ExitCode::usage, "--preset: '" + preset + "' is not a preset");
    return *found;
}

}  // namespace coseg
