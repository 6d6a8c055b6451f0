#pragma once
// What `coseg run` is asked to do: every option's value, and the presets.

#include <cstdint>
#include <string>
#include <vector>

#include "src/descriptors/descriptor_table.hpp"

namespace coseg {

struct RunOptions {
    std::string preset = "default";

    std::vector<std::string> inputs;
    int parts = 0;
    std::string out;
    std::string config;
    bool force = false;
    bool strict = false;
    bool quiet = false;
    bool verbose = false;
    bool json_log = false;
    bool keep_features = false;
    bool profile = false;
    bool keep_model = true;
    std::uint64_t seed = 1;
    std::string state;
    double checkpoint_seconds = 60.0;

    std::string remesh = "auto";

    bool sheet = true;
    bool html = true;
    std::string view = "auto";
    std::string up = "auto";

    int patches = 50;
    int oversegmentations = 3;
    double cut_noise = 0.3;

    int geodesic_samples = 300;
    int bins = 100;
    int word_sets = 1;
    std::string histogram = "square-root";
    std::string ranges = "adapted";
    std::vector<double> feature_weights =
        default_descriptor_weights();  ///< of each row of descriptor_table()

    std::string face_features;         ///< folder of what the user gives for every face; "": none
    double face_feature_weight = 1.0;  ///< of these

    std::string variant = "multi-feature";
    std::string feature = "shape_diameter";  ///< variant single-feature only
    std::string scope = "mesh";
    std::string links = "auto";
    double alpha = 0.01;
    double beta = 0.1;
    double lambda = 100.0;
    std::string solver = "auto";
    double gap = 1e-4;
    int max_iterations = 10000;
    double max_seconds = 3600.0;

    std::string affinity = "links";
    double adjacency = 5.0;
    double overlap = 1.0;
    double mesh_balance = 0.3;
    std::string partition = "spectral";
    int subsets = 0;  ///< meshes in a subset; 0: the collection is solved whole
    bool segments = false;
    bool choose = true;
    std::string refine = "held";
    bool articulated = true;
    bool places = true;
};

/// The names of the presets, in the order of --help.
std::vector<std::string> preset_names();

/// The options that a preset stands for: "default"; "paper" for the literal text of Hu, Fan and Liu (2012); and what the
/// two are to be compared with: "single:FEATURE", "independent", "concatenated", "descriptor-space".
/// Options given on the command line or in the configuration file override the preset's.
RunOptions preset_options(const std::string& preset);

}  // namespace coseg
