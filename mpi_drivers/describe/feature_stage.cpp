#include "mpi_drivers/describe/feature_stage.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "mpi_drivers/describe/patch_gather.hpp"
#include "solvers/kmeans/shape_words.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/histograms/feature_range.hpp"
#include "src/histograms/histogram.hpp"
#include "src/patches/mesh_patch_pairs.hpp"
#include "src/patches/patch_positions.hpp"

namespace coseg {

namespace {

using BinsOfMeshes = std::vector<std::vector<int>>;  // per local mesh: bin of each working face

/// Of a descriptor of numbers.
RangeKind range_kind(BinKind bins, const FeatureOptions& options) {
    if (options.ranges == BinRanges::global || bins == BinKind::global_percentile)
        return RangeKind::global_percentile;
    return bins == BinKind::equal_mass ? RangeKind::equal_mass : RangeKind::per_mesh_percentile;
}

std::string name_of(RangeKind kind) {
    switch (kind) {
        case RangeKind::equal_mass:
            return "equal mass";
        case RangeKind::global_percentile:
            return "1st to 99th percentile of the collection";
        case RangeKind::per_mesh_percentile:
            return "1st to 99th percentile of each mesh, rescaled to 0..1";
    }
    return "";
}

/// The paper counts faces; areas make the histograms independent of the triangulation.
Eigen::VectorXd face_weights(const MeshDescription& mesh, HistogramScaling scaling) {
    if (scaling == HistogramScaling::counts) return Eigen::VectorXd::Ones(mesh.geometry.area.size());
    return mesh.geometry.area;
}

/// What a feature is made of.
struct FeatureInput {
    const Collection& collection;
    const Descriptor& descriptor;
    const FeatureOptions& options;
    const FeatureBins* given;  ///< null: they are to be made
};

/// Bins of numbers, and their range.
BinsOfMeshes number_bins(const Comm& comm, const FeatureInput& input, std::vector<FaceValues> values,
                         FeatureRange& range) {
    const std::vector<MeshDescription>& meshes = input.collection.local;
    const RangeKind kind = range_kind(input.descriptor.bins, input.options);
    std::vector<FeatureOfMesh> of_meshes;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        auto& numbers = std::get<Eigen::VectorXd>(values[k]);
        if (kind == RangeKind::per_mesh_percentile) rescale_per_mesh(numbers, meshes[k].geometry.area);
        of_meshes.push_back({meshes[k].key, &numbers, &meshes[k].geometry.area});
    }
    range = input.given != nullptr
                ? std::get<FeatureRange>(*input.given)
                : agree_on_range(comm, kind, input.options.bins, of_meshes, input.options.seed);
    BinsOfMeshes bins;
    agree(comm, [&] {
        for (const FeatureOfMesh& mesh : of_meshes) bins.push_back(bin_of_face(*mesh.values, range));
    });
    return bins;
}

Eigen::MatrixXd mesh_histograms(const MeshDescription& mesh, const std::vector<int>& bins, int patches,
                                const FeatureOptions& options) {
    const HistogramScaling scaling = options.histogram;
    const Eigen::VectorXd weights = face_weights(mesh, scaling);
    Eigen::MatrixXd columns(options.bins, patches);
    Eigen::Index next = 0;
    for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
        const int count = mesh.patch_counts[s];
        columns.middleCols(next, count) =
            patch_histograms(bins, mesh.patches[s], count, options.bins, weights, scaling);
        next += count;
    }
    return columns;
}

/// The rows from `first` on, as many as there are bins, become the histograms of this rank's patches, divided
/// and weighted.
void fill_histograms(const Comm& comm, const FeatureInput& input, const BinsOfMeshes& bins, double divisor,
                     Eigen::Index first, FeatureMatrices::Block rows) {
    const Collection& collection = input.collection;
    agree(comm, [&] {
        for (std::size_t k = 0; k < collection.local.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const int count = collection.numbering.count(mesh.mesh);
            rows.block(first, collection.numbering.first(mesh.mesh, 0), input.options.bins, count) =
                input.descriptor.weight * (mesh_histograms(mesh, bins[k], count, input.options) / divisor);
        }
    });
}

/// Who has filled which patches.
std::vector<FilledColumns> filled_columns(const Collection& collection) {
    std::vector<FilledColumns> filled;
    for (std::size_t m = 0; m < collection.meshes.size(); ++m) {
        const int begin = collection.numbering.first(static_cast<int>(m), 0);
        filled.push_back(
            {begin, begin + collection.numbering.count(static_cast<int>(m)), collection.meshes[m].owner});
    }
    return filled;
}

BinsOfMeshes nearest_words(const Comm& comm, const std::vector<ShapeWordInput>& contexts,
                           const Eigen::MatrixXf& centres) {
    BinsOfMeshes bins;
    agree(comm, [&] {
        for (const ShapeWordInput& mesh : contexts) bins.push_back(words_of(*mesh.context, centres));
    });
    return bins;
}

/// Histograms over several sets of words, one below the other, scaled so that inner products are the mean
/// over the sets (square roots), or columns the mean: where k-means puts its borders is chance, which several
/// sets even out.
std::vector<Eigen::MatrixXf> fill_word_histograms(const Comm& comm, const FeatureInput& input,
                                                  const std::vector<FaceValues>& values,
                                                  const FeatureMatrices::Block& rows) {
    const FeatureOptions& options = input.options;
    std::vector<ShapeWordInput> vectors;
    for (std::size_t k = 0; k < values.size(); ++k)
        vectors.push_back({input.collection.local[k].key, &std::get<Eigen::MatrixXf>(values[k])});
    const auto sets = static_cast<double>(options.word_sets);
    const bool is_root = options.histogram == HistogramScaling::square_root;
    std::vector<Eigen::MatrixXf> words;
    for (int set = 0; set < options.word_sets; ++set) {
        const std::uint64_t seed =
            set == 0 ? options.seed : hash_words({options.seed, static_cast<std::uint64_t>(set)});
        Eigen::MatrixXf centres;
        BinsOfMeshes bins;
        if (input.given != nullptr) {
            centres = std::get<std::vector<Eigen::MatrixXf>>(*input.given).at(at(set));
            bins = nearest_words(comm, vectors, centres);
        } else {
            bins = shape_words(comm, vectors, options.bins, seed, &centres);
        }
        words.push_back(std::move(centres));
        fill_histograms(comm, input, bins, is_root ? std::sqrt(sets) : sets,
                        static_cast<Eigen::Index>(set) * options.bins, rows);
    }
    return words;
}

/// Areas and positions of all patches. Collective.
void gather_patches(const Comm& comm, const Collection& collection, PatchFeatures& features) {
    std::vector<Eigen::MatrixXd> local;
    for (const MeshDescription& mesh : collection.local) {
        Eigen::MatrixXd columns(4, collection.numbering.count(mesh.mesh));
        Eigen::Index next = 0;
        for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
            const int count = mesh.patch_counts[s];
            columns.middleCols(next, count) << patch_areas(mesh.geometry, mesh.patches[s], count).transpose(),
                patch_positions(mesh.geometry, mesh.patches[s], count);
            next += count;
        }
        local.push_back(std::move(columns));
    }
    const Eigen::MatrixXd all = gather_patch_columns(comm, collection, local, 4);
    const Eigen::VectorXd areas = all.row(0).transpose();
    features.patch_area.assign(areas.begin(), areas.end());
    features.positions = all.bottomRows(3);
}

/// Takes the values of one row out of what is known of each mesh.
std::vector<FaceValues> taken_values(std::vector<FaceDescriptors>& descriptors, int row) {
    std::vector<FaceValues> values;
    for (FaceDescriptors& of_mesh : descriptors) {
        const auto found = std::find_if(of_mesh.begin(), of_mesh.end(),
                                        [&](const FaceDescriptor& one) { return one.row == row; });
        if (found == of_mesh.end())
            throw Error(ExitCode::internal, "a mesh was described without descriptor " + std::to_string(row));
        values.push_back(std::move(found->values));
        of_mesh.erase(found);
    }
    return values;
}

/// Fills in feature k, and says by which bins.
FeatureBins fill_feature(const Comm& comm, const FeatureInput& input, std::vector<FaceValues> values,
                         std::size_t k, PatchFeatures& features) {
    if (input.descriptor.bins == BinKind::words)
        return fill_word_histograms(comm, input, values, features.histograms.fill(k));
    FeatureRange range;
    const BinsOfMeshes bins = number_bins(comm, input, std::move(values), range);
    features.ranges.push_back({input.descriptor.name,
                               name_of(range_kind(input.descriptor.bins, input.options)), range.edges.front(),
                               range.edges.back()});
    fill_histograms(comm, input, bins, 1.0, 0, features.histograms.fill(k));
    return range;
}

/// Where shared memory does not suffice.
void warn_of_copies(const PatchFeatures& features, StageLog& log) {
    if (!features.histograms.fell_back()) return;
    log.warn(
        "shared memory (/dev/shm) has no room for the features, so every rank holds a copy of its own; "
        "the results are the same");
}

}  // namespace

PatchFeatures patch_features(const Comm& comm, const Collection& collection,
                             CollectionDescriptors descriptors, const FeatureOptions& options,
                             const std::vector<FeatureBins>* given, StageLog& log) {
    log.begin("features");
    PatchFeatures features;
    features.scaling = options.histogram;
    std::vector<int> of_row;  // the row of each feature
    std::vector<Eigen::Index> heights;
    for (std::size_t row = 0; row < descriptors.table.size(); ++row) {
        const Descriptor& descriptor = descriptors.table[row];
        if (!(descriptor.weight > 0.0)) continue;
        features.descriptors.push_back(descriptor);
        of_row.push_back(static_cast<int>(row));
        heights.push_back(descriptor.bins == BinKind::words ? options.word_sets * options.bins
                                                            : options.bins);
    }
    features.histograms = FeatureMatrices(comm, heights, collection.numbering.patch_count());
    for (std::size_t k = 0; k < of_row.size(); ++k) {
        const FeatureInput input{collection, features.descriptors[k], options,
                                 given != nullptr ? &given->at(k) : nullptr};
        features.bins.push_back(
            fill_feature(comm, input, taken_values(descriptors.of_mesh, of_row[k]), k, features));
    }
    features.histograms.share(filled_columns(collection));
    gather_patches(comm, collection, features);
    descriptors.of_mesh.clear();
    malloc_trim(0);  // what the allocator holds in small pieces goes back: the next stages ask for large ones
    log.end(std::to_string(features.histograms.size()) +
            (features.histograms.size() == 1 ? " feature of " : " features of ") +
            std::to_string(options.bins) + (given != nullptr ? " bins, those of the run" : " bins"));
    warn_of_copies(features, log);
    return features;
}

}  // namespace coseg
