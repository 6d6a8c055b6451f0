#include "mpi_drivers/partition/subset_stage.hpp"

#include <algorithm>
#include <utility>

#include "mpi_drivers/partition/alignment_stage.hpp"
#include "mpi_drivers/partition/sub_collection.hpp"
#include "solvers/alignment/linked_positions.hpp"
#include "solvers/subspace/column_assembly.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/metrics/assignment.hpp"
#include "src/patches/overlapping_subsets.hpp"

namespace coseg {

namespace {

void add(Optimisation& sum, Optimisation&& one, bool first) {
    if (first) {
        sum = std::move(one);
        return;
    }
    SolveResult& s = sum.result;
    const SolveResult& o = one.result;
    add_certificate(s, o);
    s.relative_gap = std::max(s.relative_gap, o.relative_gap);
    s.history = joined({s.history, o.history});
    sum.links = std::max(sum.links, one.links);
    sum.allowed_pairs += one.allowed_pairs;
}

struct Matching {
    std::vector<int> part_of;  ///< per part of the subset
    double agreement = 1.0;
};

/// Patches that have a part already are those of the common meshes.
Matching match_parts(const std::vector<int>& part_of_patch, const std::vector<int>& patch_of,
                     const std::vector<int>& known, const std::vector<double>& patch_area, int parts) {
    Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(parts, parts);
    for (std::size_t i = 0; i < patch_of.size(); ++i) {
        const auto patch = static_cast<std::size_t>(patch_of[i]);
        if (known[patch] >= 0) shared(part_of_patch[i], known[patch]) += patch_area[patch];
    }
    Matching matching{.part_of = best_assignment(shared)};
    double agreed = 0.0;
    for (int p = 0; p < parts; ++p) agreed += shared(p, matching.part_of[at(p)]);
    if (shared.sum() > 0.0) matching.agreement = std::min(agreed / shared.sum(), 1.0);
    return matching;
}

/// Every subset is cut by itself. Whether one has too few patches is known before the first is solved.
void refuse_too_few_patches(const Collection& collection, const OverlappingSubsets& plan, int size,
                            int parts) {
    for (const std::vector<int>& subset : plan.subsets) {
        int patches = 0;
        for (const int mesh : subset) patches += collection.numbering.count(mesh);
        if (patches >= parts) continue;
        throw AgreedError(ExitCode::usage, "--parts " + std::to_string(parts) + " exceeds the " +
                                               std::to_string(patches) +
                                               " patches of a subset of --subsets " + std::to_string(size) +
                                               "; ask for fewer parts, more --patches or larger subsets");
    }
}

}  // namespace

SubsetOutcome partition_subsets(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                                const PartitionTask& task) {
    const PartitionOptions& options = task.partition;
    std::vector<std::string> names;
    for (const MeshFacts& mesh : collection.meshes) names.push_back(mesh.name);
    const OverlappingSubsets plan = overlapping_subsets(names, options.subsets, options.seed);
    refuse_too_few_patches(collection, plan, options.subsets, options.parts);
    const auto patches = static_cast<std::size_t>(collection.numbering.patch_count());
    std::vector<int> known(patches, -1);
    ColumnAssembly columns(comm, collection.numbering.patch_count());
    SubsetOutcome outcome;
    double agreement = 0.0;
    for (std::size_t s = 0; s < plan.subsets.size(); ++s) {
        PartCollection part = part_of_collection(comm, collection, features, plan.subsets[s]);
        Optimisation optimised = optimise(comm, part.collection, part.features, task.optimise, task.tiles);
        const ShapeAlignment alignment =
            aligned(comm, part.collection, part.features, optimised.result.coefficients, options);
        part.features.positions =
            linked_positions(comm, alignment, optimised.result.coefficients, part.features.positions,
                             part.collection.numbering.mesh_of());
        const CutResult cut = cut_or_found(comm,
                                           partition_input(comm, part.collection, std::move(part.features),
                                                           optimised.result.coefficients, options),
                                           options, task.cuts);
        columns.add(optimised.result.coefficients, part.patch_of);
        add(outcome.optimisation, std::move(optimised), s == 0);
        const Matching matching =
            match_parts(cut.part_of_patch, part.patch_of, known, features.patch_area, options.parts);
        if (s > 0) agreement += matching.agreement;
        for (std::size_t i = 0; i < part.patch_of.size(); ++i) {
            int& label = known[at(part.patch_of[i])];
            if (label < 0) label = matching.part_of[at(cut.part_of_patch[i])];
        }
    }
    outcome.optimisation.subsets = static_cast<int>(plan.subsets.size());
    outcome.optimisation.common_meshes = static_cast<int>(plan.common.size());
    if (plan.subsets.size() > 1)
        outcome.optimisation.subset_agreement = agreement / static_cast<double>(plan.subsets.size() - 1);
    outcome.optimisation.result.coefficients = columns.take();
    outcome.cut =
        described_partition(known, options.parts, collection.numbering.mesh_of(), features.patch_area);
    return outcome;
}

}  // namespace coseg
