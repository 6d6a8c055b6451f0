#include "mpi_drivers/feature_stage.hpp"

#include <malloc.h>

#include <cmath>
#include <span>
#include <utility>

#include "mpi_drivers/patch_gather.hpp"
#include "solvers/shape_words.hpp"
#include "src/feature_range.hpp"
#include "src/histogram.hpp"
#include "src/patch_relations.hpp"
#include "src/seeded_random.hpp"

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
    const HistogramOptions scaling{.scaling = scaling_of(options.histogram)};
    const Eigen::VectorXd weights = face_weights(mesh, scaling.scaling);
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

Eigen::MatrixXd gathered_histograms(const Comm& comm, const Collection& collection, const BinsOfMeshes& bins,
                                    const RunOptions& options) {
    std::vector<Eigen::MatrixXd> local;
    agree(comm, [&] {
        for (std::size_t k = 0; k < collection.local.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            local.push_back(mesh_histograms(mesh, bins[k], collection.numbering.count(mesh.mesh), options));
        }
    });
    return gather_patch_columns(comm, collection, local, options.bins);
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
Eigen::MatrixXd word_histograms(const Comm& comm, const Collection& collection, const RunOptions& options,
                                const FeatureBins* given, FeatureBins& bins_used) {
    std::vector<ShapeWordInput> contexts;
    for (const MeshDescription& mesh : collection.local) contexts.push_back({mesh.key, &mesh.shape_context});
    const auto sets = static_cast<double>(options.word_sets);
    const bool is_root = scaling_of(options.histogram) == HistogramScaling::square_root;
    Eigen::MatrixXd all(options.bins * options.word_sets, collection.numbering.patch_count());
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
        all.middleRows(static_cast<Eigen::Index>(set) * options.bins, options.bins) =
            gathered_histograms(comm, collection, bins, options) / (is_root ? std::sqrt(sets) : sets);
    }
    return all;
}

std::vector<double> gathered_areas(const Comm& comm, const Collection& collection) {
    std::vector<Eigen::MatrixXd> local;
    for (const MeshDescription& mesh : collection.local) {
        Eigen::MatrixXd areas(1, collection.numbering.count(mesh.mesh));
        Eigen::Index next = 0;
        for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
            const int count = mesh.patch_counts[s];
            areas.middleCols(next, count) = patch_areas(mesh.geometry, mesh.patches[s], count).transpose();
            next += count;
        }
        local.push_back(std::move(areas));
    }
    const Eigen::MatrixXd all = gather_patch_columns(comm, collection, local, 1);
    return {all.data(), all.data() + all.size()};
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
    for (int h = 0; h < feature_total; ++h) {
        const double weight = options.feature_weights[static_cast<std::size_t>(h)];
        if (!(weight > 0.0)) continue;
        const auto feature = static_cast<Feature>(h);
        if (feature == Feature::shape_context) {
            features.histograms.push_back(weight *
                                          word_histograms(comm, collection, options, given, features.bins));
        } else {
            const BinsOfMeshes bins = scalar_bins(comm, collection, feature, options, given, features);
            features.histograms.push_back(weight * gathered_histograms(comm, collection, bins, options));
        }
        features.feature_of.push_back(h);
    }
    features.patch_area = gathered_areas(comm, collection);
    release_descriptors(collection);
    return features;
}

}  // namespace coseg
