#include "mpi_drivers/partition/segment_stage.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "src/base/disjoint_sets.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

struct Segments {
    std::vector<int> of_patch;  ///< numbered by mesh, then by lowest patch
    std::vector<int> first_of;  ///< per mesh; and their number at the end
};

Segments find_segments(const Comm& comm, const Collection& collection,
                       const std::vector<int>& part_of_patch) {
    const int patches = collection.numbering.patch_count();
    DisjointSets sets(at(patches));
    const auto join = [&](int a, int b) {
        if (part_of_patch[at(a)] == part_of_patch[at(b)]) sets.join(a, b);
    };
    for (const GlobalPatchNeighbors& r : gather_patch_pairs(comm, local_neighbors(collection), patches))
        join(r.patch_a, r.patch_b);
    for (const GlobalPatchOverlap& r : gather_patch_pairs(comm, local_overlaps(collection), patches))
        join(r.patch_a, r.patch_b);
    Segments segments;
    segments.of_patch.assign(at(patches), -1);
    const std::vector<int> mesh_of = collection.numbering.mesh_of();
    int count = 0;
    for (int i = 0; i < patches; ++i) {
        while (segments.first_of.size() <= at(mesh_of[at(i)])) segments.first_of.push_back(count);
        const int lowest = sets.lowest(i);
        segments.of_patch[at(i)] = lowest == i ? count++ : segments.of_patch[at(lowest)];
    }
    segments.first_of.push_back(count);
    return segments;
}

/// Neighbourhoods of a mesh's segments: boundary lengths added over its over-segmentations, concavity
/// weighted by them.
std::vector<PatchNeighbors> segment_neighbors(const MeshDescription& mesh, const PatchNumbering& numbering,
                                              const Segments& segments) {
    std::map<std::pair<int, int>, std::pair<double, double>> sums;  // length, length * concavity
    const int first_segment = segments.first_of[at(mesh.mesh)];
    for (std::size_t s = 0; s < mesh.neighbors.size(); ++s) {
        const int first = numbering.first(mesh.mesh, static_cast<int>(s));
        for (const PatchNeighbors& n : mesh.neighbors[s]) {
            const std::pair<int, int> pair =
                std::minmax(segments.of_patch[at(first + n.patch_a)] - first_segment,
                            segments.of_patch[at(first + n.patch_b)] - first_segment);
            if (pair.first == pair.second) continue;
            sums[pair].first += n.boundary_length;
            sums[pair].second += n.boundary_length * n.concavity;
        }
    }
    std::vector<PatchNeighbors> neighbors;
    for (const auto& [pair, sum] : sums) {
        const double length = sum.first / static_cast<double>(mesh.neighbors.size());
        neighbors.push_back(
            {pair.first, pair.second, length, sum.first > 0.0 ? sum.second / sum.first : 0.0});
    }
    return neighbors;
}

Collection segment_collection(const Collection& collection, const Segments& segments) {
    Collection result;
    result.meshes = collection.meshes;
    std::vector<int> counts;
    for (std::size_t m = 0; m + 1 < segments.first_of.size(); ++m)
        counts.push_back(segments.first_of[m + 1] - segments.first_of[m]);
    result.numbering = PatchNumbering(1, counts);
    for (const MeshDescription& mesh : collection.local) {
        MeshDescription part;
        part.mesh = mesh.mesh;
        part.key = mesh.key;
        part.patch_counts = {counts[at(mesh.mesh)]};
        part.neighbors = {segment_neighbors(mesh, collection.numbering, segments)};
        result.local.push_back(std::move(part));
    }
    return result;
}

Eigen::MatrixXd segment_histograms(const FeatureMatrices::ConstBlock& patches,
                                   const std::vector<double>& area, const Segments& segments,
                                   HistogramScaling scaling) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(patches.rows(), segments.first_of.back());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(segments.first_of.back());
    for (Eigen::Index i = 0; i < patches.cols(); ++i) {
        const int s = segments.of_patch[at(static_cast<int>(i))];
        const double a = scaling == HistogramScaling::counts ? 1.0 : area[at(static_cast<int>(i))];
        if (scaling == HistogramScaling::square_root) {
            sums.col(s) += a * patches.col(i).cwiseAbs2();
        } else {
            sums.col(s) += a * patches.col(i);
        }
        areas[s] += a;
    }
    if (scaling == HistogramScaling::counts) return sums;
    for (Eigen::Index s = 0; s < sums.cols(); ++s) sums.col(s) /= areas[s] > 0.0 ? areas[s] : 1.0;
    return scaling == HistogramScaling::square_root ? sums.cwiseSqrt().eval() : sums;
}

PatchFeatures segment_features(const PatchFeatures& features, const Segments& segments,
                               int oversegmentations) {
    PatchFeatures result;
    std::vector<Eigen::MatrixXd> histograms;
    for (std::size_t h = 0; h < features.histograms.size(); ++h)
        histograms.push_back(
            segment_histograms(features.histograms[h], features.patch_area, segments, features.scaling));
    result.histograms = histograms;
    result.descriptors = features.descriptors;
    result.patch_area.assign(at(segments.first_of.back()), 0.0);
    for (std::size_t i = 0; i < features.patch_area.size(); ++i)
        result.patch_area[at(segments.of_patch[i])] += features.patch_area[i] / oversegmentations;
    return result;
}

}  // namespace

CutResult partition_segments(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                             const CutResult& first, const PartitionTask& task) {
    const Segments segments = find_segments(comm, collection, first.part_of_patch);
    const Collection whole = segment_collection(collection, segments);
    PatchFeatures described = segment_features(features, segments, collection.numbering.oversegmentations());
    const Optimisation optimisation = optimise(comm, whole, described, task.optimise, task.tiles);
    const CutResult cut = cut_or_found(
        comm,
        partition_input(comm, whole, std::move(described), optimisation.result.coefficients, task.partition),
        task.partition, task.cuts);
    std::vector<int> part_of_patch;
    for (const int segment : segments.of_patch) part_of_patch.push_back(cut.part_of_patch[at(segment)]);
    CutResult result = described_partition(part_of_patch, task.partition.parts,
                                           collection.numbering.mesh_of(), features.patch_area);
    result.starts = first.starts;
    result.chosen = first.chosen;
    return result;
}

}  // namespace coseg
