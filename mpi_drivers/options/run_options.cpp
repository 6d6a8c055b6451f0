#include "mpi_drivers/options/run_options.hpp"

#include "src/descriptors/feature.hpp"

namespace coseg {

namespace {

constexpr const char* single_prefix = "single:";

/// Sidi et al. 2011: one over-segmentation, descriptors that count alike, clusters in a diffusion map.
void choose_descriptor_space(RunOptions& options) {
    options.oversegmentations = 1;
    options.cut_noise = 0.0;
    options.feature_weights = {1.0, 1.0, 1.0, 1.0, 1.0};
    options.partition = "diffusion";
}

}  // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names = {"default", "paper"};
    for (const char* feature : feature_names) names.push_back(std::string(single_prefix) + feature);
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
    }
    if (preset == "paper") {
        options.oversegmentations = 1;
        options.cut_noise = 0.0;
        options.histogram = "unit-sum";
        options.ranges = "global";
        options.feature_weights = {1.0, 1.0, 1.0, 1.0, 1.0};
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
