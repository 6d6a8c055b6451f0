#include "mpi_drivers/partition/run_model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>

#include "io/data_files/result_files.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/record_file.hpp"
#include "io/folders/finished_run.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "solvers/alignment/shape_alignment.hpp"
#include "solvers/subspace/mesh_links.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// How many shapes of a large collection a model keeps.
constexpr std::size_t kept_of_many = 64;

/// The meshes to keep, ascending: all of a small collection, else those whose names have the least hashes.
std::vector<int> kept_meshes(const std::vector<MeshFacts>& meshes, std::uint64_t seed) {
    std::vector<int> order(meshes.size());
    std::iota(order.begin(), order.end(), 0);
    if (order.size() <= static_cast<std::size_t>(meshes_linked_to_all)) return order;
    const auto hash = [&](int m) { return hash_words({seed, hash_text(meshes[at(m)].name)}); };
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(hash(a), a) < std::pair(hash(b), b); });
    order.resize(kept_of_many);
    std::sort(order.begin(), order.end());
    return order;
}

/// An option of a stage that a model keeps.
template <class Stage, class T>
struct KeptOption {
    const char* name;  ///< in the file
    Stage RunOptions::*stage;
    T Stage::*member;

    [[nodiscard]] const T& in(const RunOptions& options) const { return options.*stage.*member; }
    [[nodiscard]] T& in(RunOptions& options) const { return options.*stage.*member; }
};
template <class Stage, class T>
constexpr KeptOption<Stage, T> kept_option(const char* name, Stage RunOptions::*stage, T Stage::*member) {
    return {name, stage, member};
}

/// Calls visit(option) for all of them in the order of the file. The seed is that of every stage.
template <class Visit>
void for_each_kept_option(Visit&& visit) {
    constexpr auto description = &RunOptions::description;
    constexpr auto features = &RunOptions::features;
    constexpr auto optimise = &RunOptions::optimise;
    visit(kept_option("parts", &RunOptions::partition, &PartitionOptions::parts));
    visit(kept_option("seed", description, &DescriptionOptions::seed));
    visit(kept_option("weld", description, &DescriptionOptions::weld));
    visit(kept_option("remesh", description, &DescriptionOptions::remesh));
    visit(kept_option("patches", description, &DescriptionOptions::patches));
    visit(kept_option("oversegmentations", description, &DescriptionOptions::oversegmentations));
    visit(kept_option("cut-noise", description, &DescriptionOptions::cut_noise));
    visit(kept_option("geodesic-samples", description, &DescriptionOptions::geodesic_samples));
    visit(kept_option("bins", features, &FeatureOptions::bins));
    visit(kept_option("word-sets", features, &FeatureOptions::word_sets));
    visit(kept_option("histogram", features, &FeatureOptions::histogram));
    visit(kept_option("ranges", features, &FeatureOptions::ranges));
    visit(kept_option("feature-weights", features, &FeatureOptions::weights));
    visit(kept_option("face-feature-weight", features, &FeatureOptions::face_feature_weight));
    visit(kept_option("alpha", optimise, &OptimiseOptions::alpha));
    visit(kept_option("beta", optimise, &OptimiseOptions::beta));
    visit(kept_option("lambda", optimise, &OptimiseOptions::lambda));
    visit(kept_option("gap", optimise, &OptimiseOptions::gap));
    visit(kept_option("refine", &RunOptions::output, &OutputOptions::refine));
}

template <class T>
void write_option(Hdf5Writer& file, const std::string& name, const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        file.attribute(name, value);
    } else if constexpr (std::is_integral_v<T>) {
        file.attribute(name, static_cast<std::int64_t>(value));
    } else if constexpr (kinds::is_vector<T>) {
        file.write(name, value);
    } else {
        file.attribute(name, to_string(value));
    }
}

void write_options(Hdf5Writer& file, const RunOptions& options) {
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::features));
    for_each_kept_option([&](const auto& option) { write_option(file, option.name, option.in(options)); });
}

/// What a text says: an enumerator of T, or how borders are welded.
template <class T>
std::optional<T> said_by(const std::string& text) {
    if constexpr (std::is_same_v<T, WeldChoice>) {
        return parsed_weld(text);
    } else {
        return named<T>(text);
    }
}

template <class T>
void read_option(const Hdf5Reader& file, const std::string& name, T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        value = read_scalar<T>(file, name);
    } else if constexpr (kinds::is_vector<T>) {
        value = file.read<typename T::value_type>(name);
    } else {
        const std::optional<T> said = said_by<T>(file.text(name));
        if (!said)
            throw Error(ExitCode::input,
                        file.path() + ": '" + name + "' has an unknown value; run coseg run again");
        value = *said;
    }
}

RunOptions read_options(const Hdf5Reader& file) {
    RunOptions options;
    for_each_kept_option([&](const auto& option) { read_option(file, option.name, option.in(options)); });
    set_seed(options, options.description.seed);
    return options;
}

/// Those that a model's file keeps, and defaults elsewhere.
RunOptions kept_options(const RunOptions& run) {
    RunOptions options;
    for_each_kept_option([&](const auto& option) { option.in(options) = option.in(run); });
    set_seed(options, options.description.seed);
    return options;
}

std::string range_name(const Descriptor& descriptor) { return "ranges/" + descriptor.name; }
std::string words_name(const Descriptor& descriptor, std::size_t set) {
    return "words/" + descriptor.name + "/" + std::to_string(set);
}

void write_bins(Hdf5Writer& file, const ModelPatches& patches) {
    const int dimensions = patches.descriptors.empty() ? 0 : patches.descriptors.back().given_dimensions;
    file.attribute("face-feature-dimensions", std::int64_t{dimensions});
    for (std::size_t h = 0; h < patches.bins.size(); ++h) {
        const Descriptor& descriptor = patches.descriptors[h];
        if (const auto* range = std::get_if<FeatureRange>(&patches.bins[h])) {
            file.write(range_name(descriptor), range->edges);
            continue;
        }
        const auto& words = std::get<std::vector<Eigen::MatrixXf>>(patches.bins[h]);
        for (std::size_t set = 0; set < words.size(); ++set)
            file.write_matrix(words_name(descriptor, set), words[set]);
    }
}

FeatureBins read_bins(const Hdf5Reader& file, const Descriptor& descriptor) {
    if (descriptor.bins != BinKind::words)
        return FeatureRange{RangeKind::global_percentile, file.read<double>(range_name(descriptor))};
    std::vector<Eigen::MatrixXf> words;
    for (std::size_t set = 0; file.has(words_name(descriptor, set)); ++set)
        words.push_back(file.read_matrix<float>(words_name(descriptor, set)));
    return words;
}

void read_features(const Hdf5Reader& file, RunModel& model) {
    std::vector<Descriptor> table = descriptor_table();
    model.face_feature_dimensions = read_scalar<int>(file, "face-feature-dimensions");
    if (model.face_feature_dimensions > 0)
        table.push_back(face_features_descriptor(model.face_feature_dimensions,
                                                 model.options.features.face_feature_weight));
    for (const Descriptor& descriptor : table) {
        const std::string name = "features/" + descriptor.name;
        if (!file.has(name)) continue;
        model.histograms.push_back(file.read_matrix<float>(name).cast<double>());
        model.bins.push_back(read_bins(file, descriptor));
    }
}

bool places_fit(const PatchPlaces& places, std::size_t patches) {
    const auto is_patch = [&](int p) { return p >= 0 && at(p) < patches; };
    const auto is_area = [](double area) { return std::isfinite(area) && area >= 0.0; };
    return places.area.size() == patches && at(places.positions.cols()) == patches &&
           std::all_of(places.area.begin(), places.area.end(), is_area) && places.positions.allFinite() &&
           places.frame.mean.allFinite() && places.frame.directions.allFinite() &&
           places.frame.correlation.allFinite() && std::isfinite(places.shapes.agreement) &&
           std::all_of(
               places.neighbors.begin(), places.neighbors.end(), [&](const GlobalPatchNeighbors& pair) {
                   return is_patch(pair.patch_a) && is_patch(pair.patch_b) && pair.boundary_length >= 0.0;
               });
}

bool fits_together(const RunModel& model) {
    const std::size_t patches = model.part_of_patch.size();
    const auto below = [](const std::vector<int>& numbers, std::size_t limit) {
        return std::all_of(numbers.begin(), numbers.end(),
                           [&](int n) { return n >= 0 && static_cast<std::size_t>(n) < limit; });
    };
    const bool columns_fit =
        std::all_of(model.histograms.begin(), model.histograms.end(),
                    [&](const Eigen::MatrixXd& x) { return static_cast<std::size_t>(x.cols()) == patches; });
    return patches > 0 && !model.histograms.empty() && columns_fit && model.mesh_of.size() == patches &&
           below(model.mesh_of, model.mesh_names.size()) &&
           model.options.features.weights.size() == descriptor_table().size() &&
           model.options.description.oversegmentations > 0 &&
           below(model.part_of_patch, static_cast<std::size_t>(std::max(model.options.partition.parts, 0))) &&
           places_fit(model.places, patches);
}

/// The meshes of kept patches, in the order in which both a file and a model in memory have them.
struct KeptPatchPlaces {
    std::vector<int> mesh_of;
    std::vector<int> parts;
    std::vector<std::string> names;
};
KeptPatchPlaces places_of(const Collection& collection, const ModelPatches& patches,
                          const std::vector<int>& part_of_patch) {
    KeptPatchPlaces places;
    for (const int mesh : patches.meshes) {
        const auto count = static_cast<std::size_t>(collection.numbering.count(mesh));
        places.mesh_of.insert(places.mesh_of.end(), count, static_cast<int>(places.names.size()));
        places.names.push_back(collection.meshes[at(mesh)].name);
    }
    for (const int p : patches.columns) places.parts.push_back(part_of_patch[at(p)]);
    return places;
}

void write_patches(Hdf5Writer& file, const Collection& collection, const ModelPatches& patches,
                   const std::vector<int>& part_of_patch) {
    const KeptPatchPlaces places = places_of(collection, patches, part_of_patch);
    for (std::size_t h = 0; h < patches.histograms.size(); ++h) {
        file.write_matrix("features/" + patches.descriptors[h].name, patches.histograms[h], true);
    }
    file.write("mesh_of", places.mesh_of);
    file.write("part_of_patch", places.parts);
    file.write_texts("mesh_names", places.names);
    write_record(file, "places", patches.places);
}

/// The patches of these meshes, ascending.
std::vector<int> columns_of(const Collection& collection, const std::vector<int>& meshes) {
    std::vector<int> columns;
    for (const int mesh : meshes) {
        const int first = collection.numbering.first(mesh, 0);
        for (int p = first; p < first + collection.numbering.count(mesh); ++p) columns.push_back(p);
    }
    return columns;
}

/// The pairs of neighbours among these patches, ascending, with their numbers there, on all ranks.
/// Collective.
std::vector<GlobalPatchNeighbors> kept_neighbors(const Comm& comm, const Collection& collection,
                                                 const std::vector<int>& columns) {
    std::vector<GlobalPatchNeighbors> local;
    for (GlobalPatchNeighbors pair : local_neighbors(collection)) {
        const auto first = std::lower_bound(columns.begin(), columns.end(), pair.patch_a);
        if (first == columns.end() || *first != pair.patch_a) continue;
        const auto second = std::lower_bound(columns.begin(), columns.end(), pair.patch_b);
        pair.patch_a = static_cast<int>(first - columns.begin());
        pair.patch_b = static_cast<int>(second - columns.begin());
        local.push_back(pair);
    }
    return gather_patch_pairs(comm, local, static_cast<int>(columns.size()));
}

int given_dimensions(const ModelPatches& patches) {
    return patches.descriptors.empty() ? 0 : patches.descriptors.back().given_dimensions;
}

}  // namespace

RunModel run_model(const Collection& collection, const ModelPatches& patches,
                   const std::vector<int>& part_of_patch, const RunOptions& options) {
    RunModel model;
    model.options = kept_options(options);
    for (const FeatureBins& bins : patches.bins) {
        const auto* range = std::get_if<FeatureRange>(&bins);
        model.bins.push_back(range == nullptr ? bins
                                              : FeatureRange{RangeKind::global_percentile, range->edges});
    }
    for (const Eigen::MatrixXf& matrix : patches.histograms)
        model.histograms.emplace_back(matrix.cast<double>());
    model.face_feature_dimensions = given_dimensions(patches);
    KeptPatchPlaces places = places_of(collection, patches, part_of_patch);
    model.mesh_of = std::move(places.mesh_of);
    model.part_of_patch = std::move(places.parts);
    model.mesh_names = std::move(places.names);
    model.places = patches.places;
    return model;
}

ModelPatches model_patches(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                           std::uint64_t seed, bool on_all_ranks) {
    ModelPatches patches;
    patches.meshes = kept_meshes(collection.meshes, seed);
    patches.columns = columns_of(collection, patches.meshes);
    patches.places.neighbors = kept_neighbors(comm, collection, patches.columns);
    if (!comm.is_root() && !on_all_ranks) return {};
    patches.descriptors = features.descriptors;
    patches.bins = features.bins;
    for (const int p : patches.columns) patches.places.area.push_back(features.patch_area[at(p)]);
    patches.places.positions = features.positions(Eigen::all, patches.columns);
    for (std::size_t h = 0; h < features.histograms.size(); ++h)
        patches.histograms.emplace_back(features.histograms[h](Eigen::all, patches.columns).cast<float>());
    return patches;
}

ModelPatches in_frame(ModelPatches patches, const Eigen::Matrix3Xd& positions,
                      const ShapeAlignment& alignment, const PositionFrame& frame) {
    PatchPlaces& places = patches.places;
    places.positions = positions(Eigen::all, patches.columns);
    places.frame = frame;
    places.shapes = frame_of_shapes(alignment);
    return patches;
}

void write_run_model(const Comm& comm, const std::string& folder, const Collection& collection,
                     const ModelPatches& patches, const std::vector<int>& part_of_patch,
                     const RunOptions& options) {
    agree(comm, [&] {
        if (!comm.is_root()) return;
        Hdf5Writer file(folder + "/" + result_files::model, model_format, model_version);
        file.summary("model of " + std::to_string(collection.meshes.size()) + " meshes, " +
                     std::to_string(patches.meshes.size()) + " kept, " +
                     std::to_string(options.partition.parts) + " parts");
        write_options(file, options);
        write_bins(file, patches);
        write_patches(file, collection, patches, part_of_patch);
        file.commit();
    });
}

void refuse_other_face_features(const RunModel& model, const FeatureOptions& own) {
    const bool is_given = !own.face_features.empty();
    if (is_given && model.face_feature_dimensions == 0)
        throw AgreedError(ExitCode::usage, "--face-features: the run was made without it; leave it out");
    if (!is_given && model.face_feature_dimensions > 0)
        throw AgreedError(
            ExitCode::usage,
            "--face-features: the run was made with it; give the folder of what the new shapes have");
}

void refuse_other_dimensions(const RunModel& model, const CollectionDescriptors& descriptors) {
    const int given = descriptors.table.back().given_dimensions;
    if (given == model.face_feature_dimensions) return;
    throw AgreedError(ExitCode::input, "--face-features: there are " + std::to_string(given) +
                                           " numbers a face, but the run was made with " +
                                           std::to_string(model.face_feature_dimensions));
}

RunModel agreed_run_model(const Comm& comm, const std::string& folder, StageLog& log) {
    RunModel model;
    agree(comm, [&] { model = read_run_model(folder); });
    if (!model.same_build) {
        log.warn(folder +
                 " was made by a coseg that computes features from other sources or settings: where these "
                 "differ in result, labels suffer; run coseg run again to be sure");
    }
    return model;
}

RunModel read_run_model(const std::string& folder) {
    namespace fs = std::filesystem;
    const std::string path = (fs::path(folder) / result_files::model).string();
    if (!fs::exists(path)) {
        const bool is_run = fs::exists(report_path(folder));
        throw Error(ExitCode::input,
                    is_run
                        ? "'" + folder + "' holds no " + result_files::model +
                              ": run coseg run again, without --no-keep-model"
                        : "'" + folder + "' is no run; name the folder that coseg run was given with --out");
    }
    const Hdf5Reader file(path, model_format, model_version);
    RunModel model;
    model.options = read_options(file);
    model.same_build = file.text("source_fingerprint") == source_fingerprint(KeptPiece::features);
    read_features(file, model);
    model.mesh_of = file.read<std::int32_t>("mesh_of");
    model.part_of_patch = file.read<std::int32_t>("part_of_patch");
    model.mesh_names = file.read_texts("mesh_names");
    read_record(file, "places", model.places);
    if (!fits_together(model))
        throw Error(ExitCode::input, path + ": its parts do not fit together; run coseg run again");
    return model;
}

}  // namespace coseg
