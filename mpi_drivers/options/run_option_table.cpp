#include "mpi_drivers/options/run_option_table.hpp"

#include <sstream>
#include <type_traits>

#include "io/mesh_files/mesh_format.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

namespace {

constexpr const char* in_out_group = "Input and output";
constexpr const char* picture_group = "Picture";
constexpr const char* patches_group = "Patches and features";
constexpr const char* optimise_group = "Optimisation";
constexpr const char* partition_group = "Partition into parts";

template <class T>
std::string printed(const T& value) {
    std::ostringstream text;
    if constexpr (std::is_same_v<T, bool>) {
        text << (value ? "true" : "false");
    } else if constexpr (std::is_same_v<T, std::vector<double>> ||
                         std::is_same_v<T, std::vector<std::string>>) {
        for (std::size_t i = 0; i < value.size(); ++i) text << (i > 0 ? "," : "") << value[i];
    } else {
        text << value;
    }
    return text.str();
}

const CLI::Validator unsigned_number(
    [](std::string& text) { return text.starts_with("-") ? text + " is negative" : std::string(); }, "");

const CLI::Validator links_text(
    [](std::string& text) {
        int links = 0;
        if (text == "auto" || text == "all") return std::string();
        const bool number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos &&
                            CLI::detail::lexical_cast(text, links);
        return number && links >= 2 ? std::string()
                                    : text + " is none of auto, all and a number of at least 2";
    },
    "auto|all|NUMBER");

const CLI::Validator view_name(
    [](std::string& text) {
        const bool is_known = text == "auto" || named_view(text, UpAxis::y).has_value();
        return is_known ? std::string()
                        : text +
                              " is no view; take auto, front, back, left, right, top, bottom, "
                              "corner, or AZIMUTH,ELEVATION in degrees";
    },
    "");

/// Of all features that a run may have.
std::vector<std::string> feature_names() {
    std::vector<std::string> names = descriptor_names();
    names.emplace_back(face_features_name);
    return names;
}

}  // namespace

template <class T>
CLI::Option* RunOptionTable::add(CLI::App& app, const std::string& key, T& variable, const std::string& help,
                                 const std::string& group) {
    printers_.emplace_back(key, [&variable] { return printed(variable); });
    CLI::Option* option = app.add_option("--" + key, variable, help)->capture_default_str()->group(group);
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::vector<double>>) {
        option->check(finite_number);
    }
    if constexpr (std::is_unsigned_v<T>) option->check(unsigned_number);
    return option;
}

CLI::Option* RunOptionTable::add_switch(CLI::App& app, const std::string& key, bool& variable,
                                        const std::string& help, const std::string& group) {
    printers_.emplace_back(key, [&variable] { return printed(variable); });
    const std::string standard = variable ? " (on by default)" : " (off by default)";
    return app.add_flag("--" + key + ",!--no-" + key, variable, help + standard)->group(group);
}

RunOptionTable::RunOptionTable(CLI::App& app, RunOptions& options, OptionSet set) : options_(options) {
    add_input_and_output(app, set);
    if (set == OptionSet::run) add_picture(app);
    add_patches_and_features(app, set);
    if (set == OptionSet::describe) return;
    add_optimisation(app);
    add_partition(app);
}

void RunOptionTable::add_input_and_output(CLI::App& app, OptionSet set) {
    // The preset is the first option because CLI11 runs callbacks in the order of definition: what else is given overrides it.
    printers_.emplace_back("preset", [this] { return options_.preset; });
    app.add_option_function<std::string>(
           "--preset", [this](const std::string& preset) { options_ = preset_options(preset); },
           "default; paper: its literal text; or a baseline: single:FEATURE, independent, concatenated "
           "(features), "
           "descriptor-space (Sidi et al. 2011); other options override it")
        ->check(CLI::IsMember(preset_names()))
        ->default_str("default")
        ->group(in_out_group);
    app.add_option(
           "input", options_.inputs,
           "Meshes (" + readable_formats() + "), folders of them, or @LIST: a file with a path a line")
        ->required()
        ->type_name("MESH|DIRECTORY|@LIST");
    if (set == OptionSet::run) add_results(app);
    add_switch(app, "strict", options_.strict,
               "A mesh that cannot be used ends the run instead of being set aside", in_out_group);
    add_switch(app, "keep-features", options_.keep_features,
               "Also write DIR/features.h5, which coseg cluster reads", in_out_group);
    add_switch(app, "quiet", options_.quiet, "No progress lines; warnings and errors only", in_out_group);
    add_switch(app, "verbose", options_.verbose, "Also say what the steps of a stage took", in_out_group);
    add_switch(app, "json-log", options_.json_log, "Progress and warnings as one JSON object a line",
               in_out_group);
    add(app, "seed", options_.seed, "Seed of all randomness; the same seed gives the same bytes",
        in_out_group);
    app.add_option("--ranks", ranks_, "Ranks of a run that is started without mpirun; 0: one for each core")
        ->check(CLI::Range(0, 100000))
        ->group(in_out_group);
    add_state(app, set);
    add(app, "config", options_.config, "Read options from a TOML or INI file; the command line wins",
        in_out_group)
        ->type_name("FILE");
}

void RunOptionTable::add_picture(CLI::App& app) {
    add_switch(app, "sheet", options_.sheet,
               "Draw contact_sheet.png, every shape coloured by part, and affinity.png", picture_group);
    add_switch(app, "html", options_.html, "Write report.html: the run as one page to look at",
               picture_group);
    add(app, "view", options_.view,
        "View of the picture: auto, a name or AZIMUTH,ELEVATION; see coseg render --help", picture_group)
        ->check(view_name);
    add(app, "up", options_.up, "The axis that points up: auto, x, y, z", picture_group)
        ->check(CLI::IsMember({"auto", "x", "y", "z"}));
}

void RunOptionTable::add_results(CLI::App& app) {
    add(app, "parts", options_.parts, "Number of parts K that the shapes are cut into", in_out_group)
        ->required()
        ->check(CLI::Range(1, 1000));
    add(app, "out", options_.out, "Folder for the results; must be new or empty unless --force", in_out_group)
        ->required();
    add_switch(app, "keep-model", options_.keep_model,
               "Write DIR/model.h5, by which coseg assign labels more shapes like these", in_out_group);
    add_switch(app, "force", options_.force, "Replace earlier results in a folder that is not empty",
               in_out_group);
    add_switch(
        app, "profile", options_.profile,
        "Say where each rank's time went: a table of stages and PETSc's log (also DIR/profile.txt), and "
        "DIR/trace.json for Perfetto or Chrome",
        in_out_group);
}

void RunOptionTable::add_state(CLI::App& app, OptionSet set) {
    add(app, "state", options_.state,
        "Folder that keeps what is computed: a later run uses what still holds, one that was ended continues",
        in_out_group)
        ->type_name("DIR")
        ->required(set == OptionSet::describe);
    if (set == OptionSet::describe) return;
    add(app, "checkpoint-seconds", options_.checkpoint_seconds,
        "With --state: the optimiser's progress is written so often", in_out_group)
        ->check(CLI::Range(0.0, 1e9));
}

void RunOptionTable::add_patches_and_features(CLI::App& app, OptionSet set) {
    add(app, "remesh", options_.remesh,
        "Even triangles inside the program: always, never, or auto: for meshes whose triangles are too long "
        "for "
        "patches",
        patches_group)
        ->check(CLI::IsMember({"auto", "always", "never"}));
    add(app, "patches", options_.patches, "Patches per over-segmentation of a mesh", patches_group)
        ->check(CLI::Range(2, 1000));
    add(app, "oversegmentations", options_.oversegmentations, "Over-segmentations per mesh, pooled",
        patches_group)
        ->check(CLI::Range(1, 20));
    add(app, "cut-noise", options_.cut_noise,
        "Log-normal noise on edge weights that makes over-segmentations differ", patches_group)
        ->check(CLI::Range(0.0, 2.0));
    add(app, "geodesic-samples", options_.geodesic_samples,
        "Sample points a mesh for geodesic distances and shape contexts", patches_group)
        ->check(CLI::Range(10, 5000));
    add(app, "bins", options_.bins, "Histogram bins, and words of shape contexts", patches_group)
        ->check(CLI::Range(2, 1000));
    add(app, "word-sets", options_.word_sets, "Sets of shape-context words whose similarities are averaged",
        patches_group)
        ->check(CLI::Range(1, 100));
    add(app, "histogram", options_.histogram, "Scaling of histograms: counts, unit-sum, square-root",
        patches_group)
        ->check(CLI::IsMember({"counts", "unit-sum", "square-root"}));
    add(app, "ranges", options_.ranges,
        "Bin ranges: adapted (curvature in equal-mass bins, the others rescaled per mesh), or global (equal "
        "widths over all meshes)",
        patches_group)
        ->check(CLI::IsMember({"adapted", "global"}));
    add_feature_weights(app);
    add_face_features(app, set);
}

void RunOptionTable::add_face_features(CLI::App& app, OptionSet set) {
    CLI::Option* folder = add(app, "face-features", options_.face_features,
                              "Folder with numbers of yours for every face, NAME.npy or NAME.h5 (dataset "
                              "features), faces x numbers: one "
                              "more feature, binned, or by words where a face has several",
                              patches_group)
                              ->type_name("DIR");
    if (set == OptionSet::describe) {
        folder->check(CLI::Validator(
            [](std::string&) {
                return std::string("descriptions do not depend on it; give it to coseg run");
            },
            ""));
    }
    add(app, "face-feature-weight", options_.face_feature_weight, "Weight of what --face-features gives",
        patches_group)
        ->check(CLI::Range(0.0, 1000.0));
}

void RunOptionTable::add_feature_weights(CLI::App& app) {
    std::string phrases;
    for (const Descriptor& row : descriptor_table()) phrases += (phrases.empty() ? "" : ", ") + row.phrase;
    const std::vector<double> standard = default_descriptor_weights();
    printers_.emplace_back("feature-weights", [this] { return printed(options_.feature_weights); });
    // One text joined by commas: as a list of up to so many numbers it would take the inputs after it for weights.
    app.add_option_function<std::string>(
           "--feature-weights",
           [this, standard](const std::string& text) {
               std::vector<double> weights;
               for (const std::string& number : CLI::detail::split(text, ','))
                   weights.push_back(std::stod(number));
               if (weights.size() > standard.size()) {
                   throw CLI::ValidationError(
                       "--feature-weights",
                       "there are only " + std::to_string(standard.size()) + " descriptors");
               }
               // Those that are not given keep their default, so that a list for fewer descriptors stays what it was.
               weights.insert(weights.end(), standard.begin() + static_cast<std::ptrdiff_t>(weights.size()),
                              standard.end());
               options_.feature_weights = std::move(weights);
           },
           "Weights of " + phrases +
               "; 0 leaves one out, those at the end that are not given keep their default")
        ->multi_option_policy(CLI::MultiOptionPolicy::Join)
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1000.0))
        ->check(finite_number)
        ->type_name("NUMBER,...")
        ->default_str(printed(standard))
        ->group(patches_group);
}

void RunOptionTable::add_optimisation(CLI::App& app) {
    add(app, "variant", options_.variant,
        "Form of the problem: multi-feature; single-feature (see --feature); independent (no consistency "
        "over the "
        "features); concatenated (features stacked); ssc, ssc-signed, ssqp (stacked features, all pairs)",
        optimise_group)
        ->check(CLI::IsMember(variant_names()));
    add(app, "feature", options_.feature, "The feature of --variant single-feature", optimise_group)
        ->check(CLI::IsMember(feature_names()));
    add(app, "scope", options_.scope,
        "What lambda's squared sums run over: paper (whole rows), or mesh (the links of a patch to one mesh)",
        optimise_group)
        ->check(CLI::IsMember({"paper", "mesh"}));
    add(app, "links", options_.links,
        "Mesh scope: other meshes in which a patch looks for matches: all, a number (a seeded sample of "
        "meshes), or "
        "auto: all in small collections",
        optimise_group)
        ->check(links_text);
    add(app, "alpha", options_.alpha, "Weight of the l2,1 penalty: consistency over the features",
        optimise_group)
        ->check(CLI::Range(0.0, 1e12));
    add(app, "beta", options_.beta, "Weight of the l1 penalty: sparseness", optimise_group)
        ->check(CLI::Range(0.0, 1e12));
    add(app, "lambda", options_.lambda, "Weight of the squared sums", optimise_group)
        ->check(CLI::Range(0.0, 1e12));
    add(app, "solver", options_.solver, "auto, dense or working-set", optimise_group)
        ->check(CLI::IsMember({"auto", "dense", "working-set"}));
    add(app, "gap", options_.gap, "Relative duality gap at which the optimiser stops", optimise_group)
        ->check(CLI::Range(1e-12, 1.0));
    add(app, "max-iterations", options_.max_iterations, "Limit of the optimiser's iterations", optimise_group)
        ->check(CLI::Range(1, 100000000));
    add(app, "max-seconds", options_.max_seconds, "Limit of the optimiser's time", optimise_group)
        ->check(CLI::Range(0.001, 1e9));
}

void RunOptionTable::add_partition(CLI::App& app) {
    add(app, "affinity", options_.affinity,
        "links (row-normalised links between meshes) or formula-8 (the paper's)", partition_group)
        ->check(CLI::IsMember({"links", "formula-8"}));
    add(app, "adjacency", options_.adjacency,
        "Weight of the adjacency of patches of a mesh against their links to other meshes; 0 gives the "
        "paper's text",
        partition_group)
        ->check(CLI::Range(0.0, 1000.0));
    add(app, "overlap", options_.overlap,
        "Weight of overlaps between over-segmentations, as a share of adjacency", partition_group)
        ->check(CLI::Range(0.0, 1000.0));
    add(app, "mesh-balance", options_.mesh_balance,
        "How dear it is to cut whole shapes apart instead of parts; 0 gives the paper's cut", partition_group)
        ->check(CLI::Range(0.0, 1.0));
    add_switch(app, "choose", options_.choose,
               "Try several adjacency weights and cluster numbers, choose without labels", partition_group);
    add(app, "subsets", options_.subsets,
        "Solve overlapping subsets of so many shapes, a third of them common to all, and reconcile their "
        "parts; 0 solves "
        "the collection whole",
        partition_group)
        ->check(CLI::Validator(
            [](std::string& text) {
                return text == "1" || text == "2" || text == "3"
                           ? std::string("a subset needs at least 4 shapes")
                           : std::string();
            },
            ""))
        ->check(CLI::Range(0, 1000000));
    add_switch(app, "segments", options_.segments,
               "A second pass on the whole segments that the first one gave", partition_group);
    add(app, "partition", options_.partition,
        "spectral (normalised cut of the affinity), or diffusion (patches clustered by their descriptors "
        "alone: no "
        "coefficients, adjacency or choice)",
        partition_group)
        ->check(CLI::IsMember({"spectral", "diffusion"}));
    add(app, "refine", options_.refine,
        "Boundaries between parts moved into creases by fuzzy cuts in a strip of 10 triangles: none, fuzzy "
        "(Katz and "
        "Tal 2003), or held (what is far from the boundary is held by its part)",
        partition_group)
        ->check(CLI::IsMember({"none", "fuzzy", "held"}));
    add_switch(app, "articulated", options_.articulated,
               "With --choose: cuts without adjacency among those tried, for shapes of many limbs",
               partition_group);
    add_switch(
        app, "places", options_.places,
        "With --choose: cuts with links weighed by where their patches lie among those tried, for shapes "
        "that stand alike",
        partition_group);
}

std::vector<std::pair<std::string, std::string>> RunOptionTable::resolved() const {
    std::vector<std::pair<std::string, std::string>> values;
    for (const auto& [key, print] : printers_) values.emplace_back(key, print());
    return values;
}

}  // namespace coseg
