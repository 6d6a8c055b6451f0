#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

namespace {

constexpr const char* single_prefix = "single:";

/// Sidi et al. 2011: one over-segmentation, descriptors that count alike, clusters in a diffusion map.
void choose_descriptor_space(RunOptions& options) {
    options.oversegmentations = 1;
    options.cut_noise = 0.0;
    options.feature_weights = equal_descriptor_weights();
    options.partition = "diffusion";
}

/// A descriptor that has no weight by default is asked for all the same.
void give_weight(std::vector<double>& weights, const std::string& name) {
    const std::vector<Descriptor>& table = descriptor_table();
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table[row].name == name && !(weights[row] > 0.0)) weights[row] = 1.0;
    }
}

}  // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names = {"default", "paper"};
    for (const std::string& descriptor : descriptor_names()) names.push_back(single_prefix + descriptor);
    names.insert(names.end(), {"independent", "concatenated", "descriptor-space"});
    return names;
}

RunOptions preset_options(const std::string& preset) {
    RunOptions options;
    options.preset = preset;
    if (preset == "independent" || preset == "concatenated") options.variant = preset;
    if (preset == "descriptor-space") choose_descriptor_space(options);
    if (preset.starts_with(single_prefix)) {
        options.variant = "single-feature";
        options.feature = preset.substr(std::string(single_prefix).size());
        give_weight(options.feature_weights, options.feature);
    }
    if (preset == "paper") {
        options.oversegmentations = 1;
        options.cut_noise = 0.0;
        options.histogram = "unit-sum";
        options.ranges = "global";
        options.feature_weights = equal_descriptor_weights();
        options.scope = "paper";
        options.lambda = 1000.0;
        options.affinity = "formula-8";
        options.adjacency = 0.0;
        options.overlap = 0.0;
        options.mesh_balance = 0.0;
        options.choose = false;
        options.refine = "fuzzy";
    }
    return options;
}

}  // namespace coseg
