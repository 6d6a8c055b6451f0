#include "mpi_drivers/partition/cut_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/partition/part_count.hpp"
#include "solvers/spectral/diffusion_clusters.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

std::vector<GlobalPatchNeighbors> neighbors_of(const MeshDescription& mesh, int first) {
    std::vector<GlobalPatchNeighbors> pairs;
    for (std::size_t s = 0; s < mesh.neighbors.size(); ++s) {
        for (const PatchNeighbors& n : mesh.neighbors[s])
            pairs.push_back({first + n.patch_a, first + n.patch_b, n.boundary_length, n.concavity});
        first += mesh.patch_counts[s];
    }
    return pairs;
}

std::vector<GlobalPatchOverlap> overlaps_of(const MeshDescription& mesh, int first) {
    std::vector<int> begin = {first};
    for (const int count : mesh.patch_counts) begin.push_back(begin.back() + count);
    std::vector<GlobalPatchOverlap> pairs;
    for (const OverlapsOfPair& of_pair : mesh.overlaps) {
        for (const PatchOverlap& o : of_pair.overlaps)
            pairs.push_back({begin[at(of_pair.oversegmentation_a)] + o.patch_a,
                             begin[at(of_pair.oversegmentation_b)] + o.patch_b, o.intersection_over_union});
    }
    return pairs;
}

std::vector<GlobalPatchNeighbors> local_neighbors(const Collection& collection) {
    std::vector<GlobalPatchNeighbors> relations;
    for (const MeshDescription& mesh : collection.local)
        append(relations, neighbors_of(mesh, collection.numbering.first(mesh.mesh, 0)));
    return relations;
}

std::vector<GlobalPatchOverlap> local_overlaps(const Collection& collection) {
    std::vector<GlobalPatchOverlap> relations;
    for (const MeshDescription& mesh : collection.local)
        append(relations, overlaps_of(mesh, collection.numbering.first(mesh.mesh, 0)));
    return relations;
}

namespace {

/// Whether the cut and its choice look at where patches lie.
bool looks_at_positions(const Eigen::Matrix3Xd& positions, const PartitionOptions& options) {
    return options.choose && options.places && positions.cols() > 0;
}

/// The number of parts that is taken.
int part_number(const CountedParts& counted) {
    if (counted.figures.empty())
        throw AgreedError(ExitCode::input,
                          "--parts auto: there are too few patches to tell how many parts there are; give "
                          "--parts a number");
    return counted.figures.front().parts;
}

}  // namespace

double share_weight(const PatchNumbering& numbering) {
    const double segmentations = static_cast<double>(numbering.mesh_count()) * numbering.oversegmentations();
    return share_weight(numbering.patch_count() / segmentations);
}

double share_weight(double patches) { return std::pow(patches / 50.0, 0.6); }

std::vector<BetweenPartVariance> explained_weights(const std::vector<Descriptor>& descriptors, double share,
                                                   bool positions_count) {
    std::vector<BetweenPartVariance> weights;
    for (const Descriptor& d : descriptors)
        weights.push_back({.pooled = share * d.partition.pooled, .per_mesh = share * d.partition.per_mesh});
    if (positions_count) weights.push_back({.pooled = 7.0, .per_mesh = 0.0});
    return weights;
}

std::vector<ChoiceDescriptor> choice_descriptors(const SinglePrecisionFeatures& features,
                                                 const Eigen::Matrix3Xf& positions,
                                                 std::span<const BetweenPartVariance> weights) {
    std::vector<ChoiceDescriptor> descriptors;
    for (std::size_t h = 0; h < weights.size(); ++h) {
        if (weights[h].pooled > 0.0 || weights[h].per_mesh > 0.0)
            descriptors.push_back({h < features.size() ? features[h] : patch_columns(positions), weights[h]});
    }
    return descriptors;
}

ChoiceWeights weights_of_choice(int oversegmentations) {
    ChoiceWeights weights;
    weights.crease *= 3.0 / oversegmentations;
    return weights;
}

std::vector<ChoiceDescriptor> PartitionInput::choice() const {
    return choice_descriptors(features, rounded_positions, choice_weights);
}

PartitionInput partition_input(const Comm& comm, const Collection& collection, PatchFeatures features,
                               const SparseCoefficients& coefficients, const PartitionOptions& options,
                               const ExampleLabels& examples) {
    std::vector<BetweenPartVariance> weights;
    if (options.choose)
        weights = explained_weights(features.descriptors, share_weight(collection.numbering),
                                    looks_at_positions(features.positions, options));
    SinglePrecisionFeatures looked_at;
    if (options.choose || !examples.empty()) looked_at = {comm, features.histograms};
    FeatureMatrices clustered;
    if (options.method == PartitionMethod::diffusion) clustered = std::move(features.histograms);
    Eigen::Matrix3Xf rounded_positions = features.positions.cast<float>();
    return {.collection = collection,
            .coefficients = coefficients,
            .patch_area = std::move(features.patch_area),
            .positions = std::move(features.positions),
            .choice_weights = std::move(weights),
            .features = std::move(looked_at),
            .rounded_positions = std::move(rounded_positions),
            .clustered = std::move(clustered),
            .examples = examples.empty() ? nullptr : &examples};
}

CutOptions cut_options(const PartitionInput& input, const PartitionOptions& options) {
    CutOptions cut;
    cut.choice = weights_of_choice(input.collection.numbering.oversegmentations());
    cut.parts = options.parts;
    cut.form = options.affinity;
    cut.drop_below = options.drop_below;
    cut.spectral.offset = options.cut_offset;
    cut.spectral.mesh_balance = options.mesh_balance;
    if (options.levels) cut.finest_level = std::max(24, 3 * options.parts);
    if (options.choose) {
        cut.spectral.tolerance = search_tolerance;
        cut.starts = pooled_starts(options.parts);
        if (looks_at_positions(input.positions, options))
            append(cut.starts, pooled_starts(options.parts, true));
    } else {
        cut.starts = single_start(options.parts, options.adjacency);
        const GraphWeights weights{options.adjacency, options.adjacency * options.overlap};
        for (CutStart& start : cut.starts) start.graph = weights;
    }
    return cut;
}

CutResult cut_into_parts(const Comm& comm, const PartitionInput& input, const PartitionOptions& options) {
    const std::vector<int> mesh_of = input.collection.numbering.mesh_of();
    if (options.method == PartitionMethod::diffusion) {
        const DiffusionOptions diffusion{.parts = options.parts, .seed = options.seed};
        return described_partition(diffusion_clusters(comm, input.clustered, diffusion), options.parts,
                                   mesh_of, input.patch_area);
    }
    const std::vector<GlobalPatchNeighbors> neighbors = local_neighbors(input.collection);
    const std::vector<GlobalPatchOverlap> overlaps = local_overlaps(input.collection);
    const std::vector<ChoiceDescriptor> choice = input.choice();
    const CutInput cut{
        input.coefficients,      neighbors,      overlaps,       mesh_of, input.patch_area, choice,
        input.known_positions(), input.examples, &input.features};
    if (options.parts != found_parts && !options.levels)
        return partition_patches(comm, cut, cut_options(input, options));
    PartitionOptions known = options;
    if (options.parts == found_parts) known.parts = least_part_count;
    CountedParts counted = count_parts(comm, cut, cut_options(input, known));
    if (options.parts == found_parts) known.parts = part_number(counted);
    CutOptions guided = cut_options(input, known);
    guided.guides = std::move(counted.partitions);
    CutResult result = partition_patches(comm, cut, guided);
    if (options.parts == found_parts) result.part_counts = std::move(counted.figures);
    return result;
}

}  // namespace coseg
