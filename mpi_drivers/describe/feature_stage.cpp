#include "mpi_drivers/describe/feature_stage.hpp"

#include <malloc.h>

#include <cmath>
#include <span>
#include <utility>

#include "mpi_drivers/describe/patch_gather.hpp"
#include "solvers/kmeans/shape_words.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/histograms/feature_range.hpp"
#include "src/histograms/histogram.hpp"
#include "src/patches/mesh_patch_pairs.hpp"
#include "src/patches/patch_positions.hpp"

namespace coseg {

namespace {

using BinsOfMeshes = std::vector<std::vector<int>>;  // per local mesh: bin of each working face

HistogramScaling scaling_of(const std::string& name) {
    if (name == "counts") return HistogramScaling::counts;
    return name == "unit-sum" ? HistogramScaling::unit_sum : HistogramScaling::square_root;
}

RangeKind range_kind(Feature feature, const RunOptions& options) {
    if (options.ranges == "global") return RangeKind::global_percentile;
    return feature == Feature::gaussian_curvature ? RangeKind::equal_mass : RangeKind::per_mesh_percentile;
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

BinsOfMeshes scalar_bins(const Comm& comm, Collection& collection, Feature feature, const RunOptions& options,
                         const FeatureBins* given, PatchFeatures& features) {
    const RangeKind kind = range_kind(feature, options);
    const auto index = static_cast<std::size_t>(feature);
    std::vector<FeatureOfMesh> values;
    for (MeshDescription& mesh : collection.local) {
        if (kind == RangeKind::per_mesh_percentile)
            rescale_per_mesh(mesh.descriptors[index], mesh.geometry.area);
        values.push_back({mesh.key, &mesh.descriptors[index], &mesh.geometry.area});
    }
    const FeatureRange range = given != nullptr
                                   ? given->ranges.at(features.bins.ranges.size())
                                   : agree_on_range(comm, kind, options.bins, values, options.seed);
    features.ranges.push_back({feature_names[index], name_of(kind), range.edges.front(), range.edges.back()});
    features.bins.ranges.push_back(range);
    BinsOfMeshes bins;
    agree(comm, [&] {
        for (const MeshDescription& mesh : collection.local)
            bins.push_back(bin_of_face(mesh.descriptors[index], range));
    });
    return bins;
}

Eigen::MatrixXd mesh_histograms(const MeshDescription& mesh, const std::vector<int>& bins, int patches,
                                const RunOptions& options) {
    const HistogramScaling scaling = scaling_of(options.histogram);
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

/// The rows from `first` on, as many as there are bins, become the histograms of this rank's patches, divided and weighted.
void fill_histograms(const Comm& comm, const Collection& collection, const BinsOfMeshes& bins,
                     const RunOptions& options, double divisor, double weight, Eigen::Index first,
                     FeatureMatrices::Block rows) {
    agree(comm, [&] {
        for (std::size_t k = 0; k < collection.local.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            const int count = collection.numbering.count(mesh.mesh);
            rows.block(first, collection.numbering.first(mesh.mesh, 0), options.bins, count) =
                weight * (mesh_histograms(mesh, bins[k], count, options) / divisor);
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

/// Histograms over several sets of words, one below the other, scaled so that inner products are the mean over the
/// sets (square roots), or columns the mean: where k-means puts its borders is chance, which several sets even out.
void fill_word_histograms(const Comm& comm, const Collection& collection, const RunOptions& options,
                          const FeatureBins* given, FeatureBins& bins_used, double weight,
                          const FeatureMatrices::Block& rows) {
    std::vector<ShapeWordInput> contexts;
    for (const MeshDescription& mesh : collection.local) contexts.push_back({mesh.key, &mesh.shape_context});
    const auto sets = static_cast<double>(options.word_sets);
    const bool is_root = scaling_of(options.histogram) == HistogramScaling::square_root;
    for (int set = 0; set < options.word_sets; ++set) {
        const std::uint64_t seed =
            set == 0 ? options.seed : hash_words({options.seed, static_cast<std::uint64_t>(set)});
        const Eigen::MatrixXf* known =
            given != nullptr ? &given->words.at(static_cast<std::size_t>(set)) : nullptr;
        Eigen::MatrixXf centres;
        const BinsOfMeshes bins = known != nullptr
                                      ? nearest_words(comm, contexts, *known)
                                      : shape_words(comm, contexts, options.bins, seed, &centres);
        bins_used.words.push_back(known != nullptr ? *known : centres);
        fill_histograms(comm, collection, bins, options, is_root ? std::sqrt(sets) : sets, weight,
                        static_cast<Eigen::Index>(set) * options.bins, rows);
    }
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

/// What the allocator then holds in small pieces goes back to the system: the next stages ask for large ones.
void release_descriptors(Collection& collection) {
    for (MeshDescription& mesh : collection.local) {
        mesh.shape_context.resize(0, 0);
        for (Eigen::VectorXd& values : mesh.descriptors) values.resize(0);
    }
    malloc_trim(0);
}

}  // namespace

PatchFeatures patch_features(const Comm& comm, Collection& collection, const RunOptions& options,
                             const FeatureBins* given) {
    PatchFeatures features;
    std::vector<Eigen::Index> rows;
    for (int h = 0; h < feature_total; ++h) {
        if (!(options.feature_weights[at(h)] > 0.0)) continue;
        features.feature_of.push_back(h);
        const int sets = static_cast<Feature>(h) == Feature::shape_context ? options.word_sets : 1;
        rows.push_back(static_cast<Eigen::Index>(sets) * options.bins);
    }
    features.histograms = FeatureMatrices(comm, rows, collection.numbering.patch_count());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto feature = static_cast<Feature>(features.feature_of[k]);
        const double weight = options.feature_weights[at(features.feature_of[k])];
        if (feature == Feature::shape_context) {
            fill_word_histograms(comm, collection, options, given, features.bins, weight,
                                 features.histograms.fill(k));
        } else {
            const BinsOfMeshes bins = scalar_bins(comm, collection, feature, options, given, features);
            fill_histograms(comm, collection, bins, options, 1.0, weight, 0, features.histograms.fill(k));
        }
    }
    features.histograms.share(filled_columns(collection));
    gather_patches(comm, collection, features);
    release_descriptors(collection);
    return features;
}

void warn_of_copies(const PatchFeatures& features, const StageLog& log) {
    if (!features.histograms.fell_back()) return;
    log.warn(
        "shared memory (/dev/shm) has no room for the features, so every rank holds a copy of its own; "
        "the results are the same");
}

}  // namespace coseg
