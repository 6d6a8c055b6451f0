#include "mpi_drivers/partition/cut_stage.hpp"

#include "solvers/spectral/diffusion_clusters.hpp"

namespace coseg {

std::vector<GlobalPatchNeighbors> local_neighbors(const Collection& collection) {
    std::vector<GlobalPatchNeighbors> relations;
    for (const MeshDescription& mesh : collection.local) {
        for (std::size_t s = 0; s < mesh.neighbors.size(); ++s) {
            const int first = collection.numbering.first(mesh.mesh, static_cast<int>(s));
            for (const PatchNeighbors& n : mesh.neighbors[s]) {
                relations.push_back({first + n.patch_a, first + n.patch_b, n.boundary_length, n.concavity});
            }
        }
    }
    return relations;
}

std::vector<GlobalPatchOverlap> local_overlaps(const Collection& collection) {
    std::vector<GlobalPatchOverlap> relations;
    for (const MeshDescription& mesh : collection.local) {
        for (const OverlapsOfPair& pair : mesh.overlaps) {
            const int first_a = collection.numbering.first(mesh.mesh, pair.oversegmentation_a);
            const int first_b = collection.numbering.first(mesh.mesh, pair.oversegmentation_b);
            for (const PatchOverlap& o : pair.overlaps) {
                relations.push_back({first_a + o.patch_a, first_b + o.patch_b, o.intersection_over_union});
            }
        }
    }
    return relations;
}

namespace {

void append(std::vector<CutStart>& starts, const std::vector<CutStart>& more) {
    starts.insert(starts.end(), more.begin(), more.end());
}

/// Whether the cut and its choice look at where patches lie.
bool looks_at_positions(const PatchFeatures& features, const RunOptions& options) {
    return options.choose && options.places && features.positions.cols() > 0;
}

CutOptions cut_options(const PatchFeatures& features, const RunOptions& options) {
    CutOptions cut;
    cut.parts = options.parts;
    cut.form = options.affinity == "formula-8" ? AffinityForm::paper : AffinityForm::links;
    cut.spectral.mesh_balance = options.mesh_balance;
    if (options.preset == "paper") {
        cut.drop_below = 1e-6;
        cut.spectral.offset = 0.5;
    }
    if (options.choose) {
        cut.starts = pooled_starts(options.parts);
        if (options.articulated) append(cut.starts, articulated_starts(options.parts));
        if (looks_at_positions(features, options)) append(cut.starts, pooled_starts(options.parts, true));
    } else {
        cut.starts = single_start(options.parts, options.adjacency);
        const GraphWeights weights{options.adjacency, options.adjacency * options.overlap};
        for (CutStart& start : cut.starts) start.graph = weights;
    }
    return cut;
}

}  // namespace

std::vector<ChoiceDescriptor> choice_descriptors(const PatchFeatures& features, const RunOptions& options) {
    std::vector<ChoiceDescriptor> descriptors;
    if (!options.choose) return descriptors;
    for (std::size_t h = 0; h < features.histograms.size(); ++h) {
        const auto [pooled, per_mesh] = features.descriptors[h].partition;
        if (pooled > 0.0 || per_mesh > 0.0)
            descriptors.push_back(
                {features.histograms[h].cast<float>(), {.pooled = pooled, .per_mesh = per_mesh}});
    }
    if (looks_at_positions(features, options))
        descriptors.push_back({features.positions.cast<float>(), {.pooled = 1.0, .per_mesh = 0.0}});
    return descriptors;
}

CutResult cut_into_parts(const Comm& comm, const PartitionInput& input, const RunOptions& options) {
    const auto& [collection, features, coefficients, choice] = input;
    const std::vector<int> mesh_of = collection.numbering.mesh_of();
    if (options.partition == "diffusion") {
        const DiffusionOptions diffusion{.parts = options.parts, .seed = options.seed};
        return described_partition(diffusion_clusters(comm, features.histograms, diffusion), options.parts,
                                   mesh_of, features.patch_area);
    }
    const std::vector<GlobalPatchNeighbors> neighbors = local_neighbors(collection);
    const std::vector<GlobalPatchOverlap> overlaps = local_overlaps(collection);
    return partition_patches(
        comm, {coefficients, neighbors, overlaps, mesh_of, features.patch_area, choice, &features.positions},
        cut_options(features, options));
}

}  // namespace coseg
