#include "mpi_drivers/options/run_option_table.hpp"

#include <sstream>
#include <type_traits>
#include <utility>

#include "io/mesh_files/mesh_format.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/launch_option.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "mpi_drivers/options/weld_option.hpp"
#include "src/base/text.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/pictures/shape_view.hpp"
#include "src/records/part_limits.hpp"

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
    if constexpr (NamedEnum<T> || std::is_same_v<T, LinkChoice> || std::is_same_v<T, WeldChoice>) {
        text << to_string(value);
    } else if constexpr (std::is_same_v<T, bool>) {
        text << (value ? "true" : "false");
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
        for (std::size_t i = 0; i < value.size(); ++i) text << (i > 0 ? "," : "") << value[i];
    } else {
        text << value;
    }
    return text.str();
}

template <class T>
constexpr OptionKind kind_of() {
    if constexpr (std::is_same_v<T, bool>) return OptionKind::on_or_off;
    if constexpr (std::is_integral_v<T>) return OptionKind::whole_number;
    if constexpr (std::is_floating_point_v<T>) return OptionKind::number;
    if constexpr (std::is_same_v<T, std::vector<double>>) return OptionKind::numbers;
    return OptionKind::text;
}

const CLI::Validator links_text(
    [](std::string& text) {
        return parsed_links(text) ? std::string() : text + " is none of auto, all and a number of at least 2";
    },
    "auto|all|NUMBER");

const std::string auto_word = "auto";

/// A number from 1 to `most`, or the word auto.
CLI::Validator number_or_auto(int most) {
    const auto check = [most](std::string& text) {
        const int number = whole_number(text).value_or(0);
        const bool is_fine = text == auto_word || (number >= 1 && number <= most);
        return is_fine ? std::string()
                       : text + " is neither auto nor a number from 1 to " + std::to_string(most);
    };
    return {check, "auto|NUMBER"};
}

const CLI::Validator view_name(
    [](std::string& text) {
        const bool is_known = text == widest_view || named_view(text, UpAxis::y).has_value();
        return is_known ? std::string()
                        : text +
                              " is no view; take auto, front, back, left, right, top, bottom, "
                              "corner, or AZIMUTH,ELEVATION in degrees";
    },
    "");

const CLI::Validator not_of_descriptions(
    [](std::string&) { return std::string("descriptions do not depend on it; give it to coseg run"); }, "");

/// Of all features that a run may have.
std::vector<std::string> feature_names() {
    std::vector<std::string> names = descriptor_names();
    names.emplace_back(face_features_name);
    return names;
}

const CLI::Validator subset_size(
    [](std::string& text) {
        return text == "1" || text == "2" || text == "3" ? std::string("a subset needs at least 4 shapes")
                                                         : std::string();
    },
    "");

}  // namespace

void RunOptionTable::remember(const Row& row, OptionKind kind, std::function<std::string()> print) {
    printers_.push_back({row.key, row.affects, kind, std::move(print)});
}

template <class T>
CLI::Option* RunOptionTable::add(const Row& row, T& variable) {
    remember(row, kind_of<T>(), [&variable] { return printed(variable); });
    const std::string name = "--" + row.key;
    if constexpr (NamedEnum<T>) {
        return add_enum_option(app_, name, variable, row.help)->group(row.group);
    } else {
        CLI::Option* option =
            app_.add_option(name, variable, row.help)->capture_default_str()->group(row.group);
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::vector<double>>)
            option->check(finite_number);
        if constexpr (kind_of<T>() == OptionKind::whole_number) option->transform(decimal_digits);
        return option;
    }
}

CLI::Option* RunOptionTable::add_switch(const Row& row, bool& variable) {
    remember(row, OptionKind::on_or_off, [&variable] { return printed(variable); });
    const std::string standard = variable ? " (on by default)" : " (off by default)";
    return app_.add_flag("--" + row.key + ",!--no-" + row.key, variable, row.help + standard)
        ->group(row.group);
}

RunOptionTable::RunOptionTable(CLI::App& app, RunOptions& options, OptionSet set)
    : app_(app), options_(options) {
    add_input_and_output(set);
    if (set == OptionSet::run) add_picture();
    add_patches();
    add_features(set);
    if (set == OptionSet::describe) return;
    add_problem();
    add_solver();
    add_partition();
    add_choice();
}

/// The preset is the first option because CLI11 runs callbacks in the order of definition: what else is given
/// overrides it.
void RunOptionTable::add_preset() {
    remember({"preset", Affects::nothing, in_out_group, ""}, OptionKind::text,
             [this] { return options_.preset; });
    app_.add_option_function<std::string>(
            "--preset", [this](const std::string& preset) { options_ = preset_options(preset); },
            "default; paper: the paper's text, and where that is silent the code that it names; or a "
            "baseline: single:FEATURE, independent, concatenated (features), descriptor-space (Sidi et al. "
            "2011); other options override it")
        ->check(CLI::IsMember(preset_names()))
        ->default_str("default")
        ->group(in_out_group);
}

void RunOptionTable::add_seed() {
    remember({"seed", Affects::describe, in_out_group, ""}, OptionKind::whole_number,
             [this] { return printed(options_.description.seed); });
    app_.add_option_function<std::uint64_t>(
            "--seed", [this](const std::uint64_t& seed) { set_seed(options_, seed); },
            "Seed of all randomness; the same seed gives the same bytes")
        ->default_str(printed(options_.description.seed))
        ->check(unsigned_number)
        ->transform(decimal_digits)
        ->group(in_out_group);
}

void RunOptionTable::add_input_and_output(OptionSet set) {
    ProcessOptions& process = options_.process;
    add_preset();
    app_.add_option(
            "input", process.inputs,
            "Meshes (" + readable_formats() + "), folders of them, or @LIST: a file with a path a line")
        ->required()
        ->type_name("MESH|DIRECTORY|@LIST");
    if (set == OptionSet::run) add_results();
    add_switch({"strict", Affects::nothing, in_out_group,
                "A mesh that cannot be used ends the run instead of being set aside"},
               process.strict);
    if (set == OptionSet::run)
        add_switch({"keep-features", Affects::output, in_out_group,
                    "Also write DIR/features.h5, which coseg cluster reads"},
                   options_.output.keep_features);
    add_switch({"quiet", Affects::nothing, in_out_group, "No progress lines; warnings and errors only"},
               process.quiet);
    add_switch({"verbose", Affects::nothing, in_out_group, "Also say what the steps of a stage took"},
               process.verbose);
    add_switch(
        {"json-log", Affects::nothing, in_out_group, "Progress and warnings as one JSON object a line"},
        process.json_log);
    add_seed();
    add_ranks_option(app_)->group(in_out_group);
    add_state(set);
    add({"config", Affects::nothing, in_out_group,
         "Read options from a TOML or INI file; the command line wins"},
        process.config)
        ->type_name("FILE");
}

void RunOptionTable::add_picture() {
    OutputOptions& output = options_.output;
    add_switch({"sheet", Affects::output, picture_group,
                "Draw contact_sheet.png, every shape coloured by part, and affinity.png"},
               output.sheet);
    add_switch({"html", Affects::output, picture_group, "Write report.html: the run as one page to look at"},
               output.html);
    add({"view", Affects::output, picture_group,
         "View of the picture: auto, a name or AZIMUTH,ELEVATION; see coseg render --help"},
        output.view.view)
        ->check(view_name);
    add({"up", Affects::output, picture_group, "The axis that points up: auto, x, y, z"}, output.view.up);
}

CLI::Option* RunOptionTable::add_number_or_auto(const Row& row, int& variable, int found, int most) {
    remember(row, OptionKind::text,
             [&variable, found] { return variable == found ? auto_word : std::to_string(variable); });
    const auto take = [&variable, found](const std::string& text) {
        variable = text == auto_word ? found : whole_number(text).value();  // checked before
    };
    return app_.add_option_function<std::string>("--" + row.key, take, row.help)
        ->check(number_or_auto(most))
        ->group(row.group);
}

void RunOptionTable::add_results() {
    OutputOptions& output = options_.output;
    add_number_or_auto(
        {"parts", Affects::cut, in_out_group,
         "Number of parts K that the shapes are cut into, 1 to 1000, or auto: 2 to 12, found from the "
         "shapes; required unless --examples is given"},
        options_.partition.parts, found_parts, most_parts);
    // Where the labels are has no effect; they themselves are part of what a cut is found by.
    add({"examples", Affects::nothing, in_out_group,
         "Folder with labels of yours for one shape or more, NAME.seg with a number a face (0, 1, ..., or -1 "
         "for faces of which nothing is said): the others get the same parts"},
        options_.partition.examples)
        ->type_name("DIR");
    add({"corrections", Affects::nothing, in_out_group,
         "corrections.json of coseg edit: the parts as a person has corrected them"},
        options_.partition.corrections)
        ->type_name("FILE");
    add({"constraints", Affects::nothing, in_out_group,
         "Faces that have the same part or different ones, parts that a shape does not have: CSV or JSON, "
         "see "
         "docs/editing.md"},
        options_.partition.constraints)
        ->type_name("FILE");
    add({"out", Affects::nothing, in_out_group,
         "Folder for the results; must be new or empty unless --force"},
        output.folder)
        ->required();
    add_switch({"keep-model", Affects::output, in_out_group,
                "Write DIR/model.h5, by which coseg assign labels more shapes like these"},
               output.keep_model);
    add_switch(
        {"force", Affects::nothing, in_out_group, "Replace earlier results in a folder that is not empty"},
        output.force);
    add_switch({"profile", Affects::output, in_out_group,
                "Say where each rank's time went: a table of stages and PETSc's log (also DIR/profile.txt), "
                "and DIR/trace.json for Perfetto or Chrome"},
               output.profile);
}

void RunOptionTable::add_state(OptionSet set) {
    add({"state", Affects::nothing, in_out_group,
         "Folder that keeps what is computed: a later run uses what still holds, one that was ended "
         "continues"},
        options_.process.state)
        ->type_name("DIR")
        ->required(set == OptionSet::describe);
    if (set == OptionSet::describe) return;
    add({"checkpoint-seconds", Affects::nothing, in_out_group,
         "With --state: the optimiser's progress is written so often"},
        options_.process.checkpoint_seconds)
        ->check(CLI::Range(0.0, 1e9));
}

void RunOptionTable::add_patches() {
    DescriptionOptions& description = options_.description;
    const Row weld{"weld", Affects::describe, patches_group, weld_help};
    remember(weld, OptionKind::text, [&description] { return printed(description.weld); });
    add_weld_option(app_, description.weld)->group(patches_group);
    add({"remesh", Affects::describe, patches_group,
         "Even triangles inside the program: always, never, or auto: for meshes whose triangles are too long "
         "for patches"},
        description.remesh);
    add({"patches", Affects::describe, patches_group, "Patches per over-segmentation of a mesh"},
        description.patches)
        ->check(CLI::Range(2, 1000));
    add_number_or_auto(
        {"oversegmentations", Affects::describe, patches_group,
         "Over-segmentations per mesh, pooled, 1 to 20, or auto: 3, and up to 12 for fewer than 16 "
         "shapes"},
        description.oversegmentations, found_oversegmentations, 20)
        ->default_str(auto_word);
    add({"cut-noise", Affects::describe, patches_group,
         "Log-normal noise on edge weights that makes over-segmentations differ"},
        description.cut_noise)
        ->check(CLI::Range(0.0, 2.0));
    add({"geodesic-samples", Affects::describe, patches_group,
         "Sample points a mesh for geodesic distances and shape contexts"},
        description.geodesic_samples)
        ->check(CLI::Range(10, 5000));
}

void RunOptionTable::add_features(OptionSet set) {
    FeatureOptions& features = options_.features;
    add({"bins", Affects::features, patches_group, "Histogram bins, and words of shape contexts"},
        features.bins)
        ->check(CLI::Range(2, 1000));
    add({"word-sets", Affects::features, patches_group,
         "Sets of shape-context words whose similarities are averaged"},
        features.word_sets)
        ->check(CLI::Range(1, 100));
    add({"histogram", Affects::features, patches_group,
         "Scaling of histograms: counts, unit-sum, square-root"},
        features.histogram);
    add({"ranges", Affects::features, patches_group,
         "Bin ranges: adapted (curvature in equal-mass bins, the others rescaled per mesh), or global (equal "
         "widths over all meshes)"},
        features.ranges);
    add_feature_weights();
    add_face_features(set);
}

void RunOptionTable::add_face_features(OptionSet set) {
    // Where the numbers are has no effect; they themselves are part of the features that a cut is found by.
    CLI::Option* folder =
        add({"face-features", Affects::nothing, patches_group,
             "Folder with numbers of yours for every face, NAME.npy or NAME.h5 (dataset features), faces x "
             "numbers: one more feature, binned, or by words where a face has several"},
            options_.features.face_features)
            ->type_name("DIR");
    if (set == OptionSet::describe) folder->check(not_of_descriptions);
    add({"face-feature-weight", Affects::features, patches_group, "Weight of what --face-features gives"},
        options_.features.face_feature_weight)
        ->check(CLI::Range(0.0, 1000.0));
}

void RunOptionTable::add_feature_weights() {
    std::string phrases;
    for (const Descriptor& row : descriptor_table()) phrases += (phrases.empty() ? "" : ", ") + row.phrase;
    const Row row{"feature-weights", Affects::features, patches_group,
                  "Weights of " + phrases +
                      "; 0 leaves one out, those at the end that are not given keep their default"};
    std::vector<double>& weights = options_.features.weights;
    remember(row, OptionKind::numbers, [&weights] { return printed(weights); });
    const std::vector<double> standard = default_descriptor_weights();
    const auto take = [&weights, standard](const std::string& text) {
        std::vector<double> given;
        for (const std::string& number : CLI::detail::split(text, ',')) {
            given.push_back(0.0);
            CLI::detail::lexical_cast(number, given.back());  // checked before
        }
        if (given.size() > standard.size()) {
            throw CLI::ValidationError("--feature-weights",
                                       "there are only " + std::to_string(standard.size()) + " descriptors");
        }
        // Those that are not given keep their default, so that a list for fewer descriptors stays what it
        // was.
        given.insert(given.end(), standard.begin() + static_cast<std::ptrdiff_t>(given.size()),
                     standard.end());
        weights = std::move(given);
    };
    // One text joined by commas: as a list of up to so many numbers it would take the inputs after it for
    // weights.
    app_.add_option_function<std::string>("--" + row.key, take, row.help)
        ->multi_option_policy(CLI::MultiOptionPolicy::Join)
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1000.0))
        ->check(finite_number)
        ->type_name("NUMBER,...")
        ->default_str(printed(standard))
        ->group(patches_group);
}

void RunOptionTable::add_problem() {
    OptimiseOptions& optimise = options_.optimise;
    add({"variant", Affects::solve, optimise_group,
         "Form of the problem: multi-feature; single-feature (see --feature); independent (no consistency "
         "over the features); concatenated (features stacked); ssc, ssc-signed, ssqp (stacked features, all "
         "pairs)"},
        optimise.variant);
    add({"feature", Affects::solve, optimise_group, "The feature of --variant single-feature"},
        optimise.feature)
        ->check(CLI::IsMember(feature_names()));
    add({"scope", Affects::solve, optimise_group,
         "What lambda's squared sums run over: rows (whole rows, as in the paper), or meshes (the links of a "
         "patch to one mesh)"},
        optimise.scope);
    const Row links{"links", Affects::solve, optimise_group,
                    "Mesh scope: other meshes in which a patch looks for matches: all, a number (a seeded "
                    "sample of meshes), or auto: all in small collections"};
    remember(links, OptionKind::text, [&optimise] { return printed(optimise.links); });
    app_.add_option_function<std::string>(
            "--links", [&optimise](const std::string& text) { optimise.links = parsed_links(text).value(); },
            links.help)
        ->check(links_text)
        ->default_str(printed(optimise.links))
        ->group(optimise_group);
    add({"alpha", Affects::solve, optimise_group,
         "Weight of the l2,1 penalty: consistency over the features"},
        optimise.alpha)
        ->check(CLI::Range(0.0, most_penalty));
    add({"beta", Affects::solve, optimise_group, "Weight of the l1 penalty: sparseness"}, optimise.beta)
        ->check(CLI::Range(0.0, most_penalty));
    add({"lambda", Affects::solve, optimise_group, "Weight of the squared sums"}, optimise.lambda)
        ->check(CLI::Range(0.0, most_penalty));
}

void RunOptionTable::add_solver() {
    OptimiseOptions& optimise = options_.optimise;
    add({"solver", Affects::solve, optimise_group, "auto, dense or working-set"}, optimise.solver);
    add({"gap", Affects::solve, optimise_group, "Relative duality gap at which the optimiser stops"},
        optimise.gap)
        ->check(gap_from(1e-12));
    add({"max-iterations", Affects::solve, optimise_group, "Limit of the optimiser's iterations"},
        optimise.max_iterations)
        ->check(CLI::Range(1, 100000000));
    // What the clock has ended is not kept, so that nothing which is kept depends on it.
    add({"max-seconds", Affects::nothing, optimise_group, "Limit of the optimiser's time"},
        optimise.max_seconds)
        ->check(CLI::Range(0.001, 1e9));
}

void RunOptionTable::add_partition() {
    PartitionOptions& partition = options_.partition;
    add({"affinity", Affects::cut, partition_group,
         "links (every patch's own links sum to 1) or formula-8 (the paper's)"},
        partition.affinity);
    add({"drop-below", Affects::cut, partition_group,
         "Entries of the affinity below this are dropped; the paper's code has 1e-6"},
        partition.drop_below)
        ->check(CLI::Range(0.0, 1.0));
    add({"cut-offset", Affects::cut, partition_group,
         "What the normalised cut adds to the affinity's diagonal, and twice to the degrees; the paper's "
         "code has 0.5 (cannot be combined with --mesh-balance)"},
        partition.cut_offset)
        ->check(CLI::Range(0.0, 1e6));
    add({"adjacency", Affects::cut, partition_group,
         "Weight of the adjacency of patches of a mesh against their links to other meshes; 0 gives the "
         "paper's text"},
        partition.adjacency)
        ->check(CLI::Range(0.0, 1000.0));
    add({"overlap", Affects::cut, partition_group,
         "Weight of overlaps between over-segmentations, as a share of adjacency"},
        partition.overlap)
        ->check(CLI::Range(0.0, 1000.0));
    add({"mesh-balance", Affects::cut, partition_group,
         "Penalty tau on cutting between whole shapes (0: the paper's cut)"},
        partition.mesh_balance)
        ->check(CLI::Range(0.0, 1.0));
}

void RunOptionTable::add_choice() {
    PartitionOptions& partition = options_.partition;
    add_switch({"choose", Affects::cut, partition_group,
                "Try several adjacency weights and cluster numbers, merge and choose without labels"},
               partition.choose);
    add_switch(
        {"levels", Affects::cut, partition_group,
         "Also write levels/2, levels/3, ...: one nested tree of parts, from 2 to 3 K or 24, in which each "
         "level joins two parts of the next finer one"},
        partition.levels);
    add({"subsets", Affects::cut, partition_group,
         "Solve overlapping subsets of so many shapes, a third of them common to all, and reconcile their "
         "parts; 0 solves the collection whole"},
        partition.subsets)
        ->check(subset_size)
        ->check(CLI::Range(0, 1000000));
    add_switch({"segments", Affects::cut, partition_group,
                "A second pass on the whole segments that the first one gave"},
               partition.segments);
    add({"partition", Affects::cut, partition_group,
         "spectral (normalised cut of the affinity), or diffusion (patches clustered by their descriptors "
         "alone: no coefficients, adjacency or choice)"},
        partition.method);
    add({"refine", Affects::output, partition_group,
         "Boundaries between parts moved by fuzzy cuts: none; fuzzy (Katz and Tal 2003, within 10 "
         "triangles); held "
         "(what is far from the boundary is held by its part); or scored (likewise, and faces prefer the "
         "part "
         "that they look like in other meshes)"},
        options_.output.refine);
    add_switch({"places", Affects::cut, partition_group,
                "With --choose: cuts with links weighed by where their patches lie among those tried, for "
                "shapes that stand alike"},
               partition.places);
    add({"align", Affects::cut, partition_group,
         "Shapes that do not stand alike are turned by their parts, for pictures, places and "
         "DIR/alignment.json: auto, off"},
        partition.align);
}

std::vector<OptionValue> RunOptionTable::values() const {
    std::vector<OptionValue> values;
    for (const Printer& row : printers_) values.push_back({row.key, row.print(), row.affects, row.kind});
    return values;
}

std::vector<OptionValue> option_values(RunOptions options) {
    CLI::App unused;
    return RunOptionTable(unused, options).values();
}

}  // namespace coseg
