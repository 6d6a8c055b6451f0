#include "mpi_drivers/run_options.hpp"

namespace coseg {

RunOptions preset_options(const std::string& preset) {
    RunOptions options;
    options.preset = preset;
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
