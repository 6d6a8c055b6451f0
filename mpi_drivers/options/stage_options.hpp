#pragma once
// The options of each stage of a run. A function takes the options of its own stage, and no others.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "solvers/affinity/affinity.hpp"
#include "solvers/subspace/subspace_problem.hpp"
#include "solvers/variants/subspace_variants.hpp"
#include "src/base/enum_names.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/histograms/histogram.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/pictures/shape_view.hpp"
#include "src/records/fields.hpp"
#include "src/repair/border_welding.hpp"

namespace coseg {

/// Whether a mesh gets even triangles before it is described.
enum class RemeshMode {
    automatic,  ///< where its own triangles are too long for patches
    always,
    never,
};
constexpr std::array<EnumName<RemeshMode>, 3> enum_names(RemeshMode /*type*/) {
    return {{{RemeshMode::automatic, "auto"}, {RemeshMode::always, "always"}, {RemeshMode::never, "never"}}};
}

/// How borders of a mesh that nearly touch are treated.
struct WeldChoice {
    enum class Rule {
        automatic,  ///< joined where they are as near as rounding leaves them
        exact,      ///< joined only where their coordinates are equal
        within
    };  ///< within: joined within a tolerance
    Rule rule = Rule::automatic;
    double tolerance = 0.0;  ///< Rule::within alone: a share of the mesh's size, in (0, 0.01]
    static constexpr auto fields() {
        return std::tuple(field("rule", &WeldChoice::rule), field("tolerance", &WeldChoice::tolerance));
    }
};
/// "auto", "exact" or a number above 0 and up to 0.01; nothing for any other text.
std::optional<WeldChoice> parsed_weld(std::string_view text);
std::string to_string(const WeldChoice& weld);
BorderLimits border_limits(const WeldChoice& weld);

/// In place of a number of over-segmentations: as many as the number of shapes asks for.
inline constexpr int found_oversegmentations = 0;

/// The options that a mesh's description depends on, and no others: the descriptions in a state folder are
/// found by them (description_file.hpp).
struct DescriptionOptions {
    std::uint64_t seed = 1;
    WeldChoice weld = {};
    RemeshMode remesh = RemeshMode::automatic;
    int patches = 50;  ///< per over-segmentation
    /// Per mesh; with_oversegmentations() puts a number where found_oversegmentations stands.
    int oversegmentations = found_oversegmentations;
    double cut_noise = 0.3;  ///< log-normal deviation of edge weights between over-segmentations
    int geodesic_samples = 300;
    std::vector<int> descriptors;  ///< rows of descriptor_table(), ascending; see description_options
    static constexpr auto fields() {
        return std::tuple(field("seed", &DescriptionOptions::seed), field("weld", &DescriptionOptions::weld),
                          field("remesh", &DescriptionOptions::remesh),
                          field("patches", &DescriptionOptions::patches),
                          field("oversegmentations", &DescriptionOptions::oversegmentations),
                          field("cut-noise", &DescriptionOptions::cut_noise),
                          field("geodesic-samples", &DescriptionOptions::geodesic_samples),
                          field("descriptors", &DescriptionOptions::descriptors));
    }
};

/// The options with the number of over-segmentations that the meshes of a collection of so many shapes get,
/// where they leave it open: 3, and for fewer than 16 shapes so many more that the cut sees no fewer patches
/// than those of 16, but at most 12.
DescriptionOptions with_oversegmentations(DescriptionOptions options, std::size_t shapes);

/// The range of values over which the bins of a scalar feature lie.
enum class BinRanges {
    adapted,  ///< curvature in bins of equal mass, the others rescaled per mesh
    global,   ///< equal widths over all meshes
};
constexpr std::array<EnumName<BinRanges>, 2> enum_names(BinRanges /*type*/) {
    return {{{BinRanges::adapted, "adapted"}, {BinRanges::global, "global"}}};
}

/// Options of the stage that makes features of patches from descriptors of faces.
struct FeatureOptions {
    std::uint64_t seed = 1;
    int bins = 100;     ///< of a histogram; words of a set of shape contexts
    int word_sets = 1;  ///< of shape contexts, whose similarities are averaged
    HistogramScaling histogram = HistogramScaling::square_root;
    BinRanges ranges = BinRanges::adapted;
    std::vector<double> weights = default_descriptor_weights();  ///< of each row of descriptor_table()
    std::string face_features;         ///< folder of the numbers that the user gives for every face; "": none
    double face_feature_weight = 1.0;  ///< weight of these numbers
};

/// The number of other meshes in which a patch may have matches, in mesh scope.
struct LinkChoice {
    enum class Rule {
        automatic,
        all,
        number
    };  ///< automatic: all in small collections, default_links in others
    Rule rule = Rule::automatic;
    int meshes = 0;  ///< Rule::number alone: at least 2
};
/// "auto", "all" or a number of at least 2; nothing for any other text.
std::optional<LinkChoice> parsed_links(std::string_view text);
std::string to_string(const LinkChoice& links);

/// Options of the stage that finds coefficients from features.
struct OptimiseOptions {
    std::uint64_t seed = 1;  ///< of the sample of links
    SubspaceVariant variant = SubspaceVariant::multi_feature;
    std::string feature = "shape_diameter";  ///< variant single_feature only
    PenaltyScope scope = PenaltyScope::meshes;
    LinkChoice links;
    double alpha = 0.01;    ///< of the l2,1 penalty
    double beta = 0.1;      ///< of the l1 penalty
    double lambda = 100.0;  ///< of the scope's squared sums
    SolverChoice solver = SolverChoice::automatic;
    double gap = 1e-4;  ///< relative duality gap at which the optimiser stops
    int max_iterations = 10000;
    double max_seconds = 3600.0;
};

/// The method by which patches become parts.
enum class PartitionMethod {
    spectral,   ///< normalised cut of the coefficients' affinity
    diffusion,  ///< clusters of the descriptors alone, in a diffusion map
};
constexpr std::array<EnumName<PartitionMethod>, 2> enum_names(PartitionMethod /*type*/) {
    return {{{PartitionMethod::spectral, "spectral"}, {PartitionMethod::diffusion, "diffusion"}}};
}

/// Whether shapes are turned by their parts.
enum class AlignMode {
    automatic,  ///< where they do not stand alike in their files
    off,
};
constexpr std::array<EnumName<AlignMode>, 2> enum_names(AlignMode /*type*/) {
    return {{{AlignMode::automatic, "auto"}, {AlignMode::off, "off"}}};
}

/// PartitionOptions::parts where the shapes say how many parts there are.
inline constexpr int found_parts = -1;

/// Options of the stage that finds the part of every patch from coefficients.
struct PartitionOptions {
    std::uint64_t seed = 1;   ///< of subsets, and of the diffusion map's clusters
    int parts = 0;            ///< K; 0: as many as the examples have labels; or found_parts
    std::string examples;     ///< folder of the labels that the user gives for some shapes; "": none
    std::string corrections;  ///< file of what a person says of the partition; "": none
    std::string constraints;  ///< file of links and absent parts alone; "": none
    PartitionMethod method = PartitionMethod::spectral;
    AffinityForm affinity = AffinityForm::links;
    double drop_below = 0.0;  ///< entries of the affinity below are dropped
    double cut_offset = 0.0;  ///< SpectralOptions::offset
    double adjacency = 5.0;   ///< weight against the links between meshes, where `choose` is off
    double overlap = 1.0;     ///< weight of overlaps, as a share of adjacency
    double mesh_balance = 0.3;
    int subsets = 0;        ///< meshes in a subset; 0: the collection is solved whole
    bool segments = false;  ///< a second pass on whole segments
    bool choose = true;     ///< whether one of several starts is chosen
    bool levels = false;    ///< a tree of parts, coarser and finer than K
    bool places = true;     ///< starts whose links are weighed by where their patches lie
    AlignMode align = AlignMode::automatic;
};

/// The way in which boundaries between parts are moved into creases.
enum class RefineMode {
    none,
    fuzzy,   ///< fuzzy cuts (Katz and Tal 2003)
    held,    ///< fuzzy cuts in which faces far from the boundary are held by their part
    scored,  ///< likewise, and faces prefer the part that they look like in the other meshes
};
constexpr std::array<EnumName<RefineMode>, 4> enum_names(RefineMode /*type*/) {
    return {{{RefineMode::none, "none"},
             {RefineMode::fuzzy, "fuzzy"},
             {RefineMode::held, "held"},
             {RefineMode::scored, "scored"}}};
}

/// What a run leaves in its folder.
struct OutputOptions {
    std::string folder;
    bool force = false;  ///< earlier results in the folder are replaced
    RefineMode refine = RefineMode::scored;
    bool keep_features = false;
    bool keep_model = true;
    bool sheet = true;
    bool html = true;
    bool profile = false;
    ViewChoice view;
};

/// Options that say where a run's meshes and its kept state are and what the run prints. Nothing that it
/// computes depends on these.
struct ProcessOptions {
    std::vector<std::string> inputs;
    bool strict = false;  ///< a mesh that cannot be used ends the run
    std::string config;
    std::string state;  ///< folder; "" keeps nothing
    double checkpoint_seconds = 60.0;
    bool quiet = false;
    bool verbose = false;
    bool json_log = false;
    bool watches_signals = true;  ///< off where the process belongs to somebody else, see run_folders.hpp

    [[nodiscard]] Verbosity verbosity() const noexcept;
    [[nodiscard]] LogForm log_form() const noexcept { return json_log ? LogForm::json : LogForm::text; }
};

}  // namespace coseg
