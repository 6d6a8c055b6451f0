#include "mpi_drivers/partition/partition_stage.hpp"

#include <algorithm>
#include <utility>

#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/partition/alignment_stage.hpp"
#include "mpi_drivers/partition/segment_stage.hpp"
#include "mpi_drivers/partition/subset_stage.hpp"
#include "solvers/alignment/linked_positions.hpp"
#include "solvers/choice/part_shares.hpp"
#include "solvers/partition/part_count.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// Says which part is hardly one, and what to do about it.
void warn_of_degenerate_parts(const CutResult& cut, int parts, int meshes, StageLog& log) {
    if (cut.starts.empty()) return;
    const StartOutcome& chosen = cut.starts[at(cut.chosen)];
    if (chosen.parts_found < parts) {
        log.warn(std::to_string(parts) + " parts are asked for, but " + std::to_string(chosen.parts_found) +
                 " were found; ask for fewer parts, or for more patches with --patches");
    }
    if (!chosen.degenerate) return;
    std::string named;
    int kept = 0;
    for (std::size_t p = 0; p < cut.part_share.size(); ++p) {
        const int in_meshes = cut.meshes_with_part[p];
        if (in_meshes == 0) continue;
        if (!is_degenerate_part(cut.part_share[p], in_meshes, meshes)) {
            ++kept;
            continue;
        }
        named += (named.empty() ? "part " : "; part ") + std::to_string(p) + " has " +
                 percent(cut.part_share[p], 2) + " of the area and is in " + std::to_string(in_meshes) +
                 " of " + with_unit(meshes, "shape", "shapes");
    }
    if (named.empty()) return;
    log.warn(std::to_string(parts) + " parts are asked for, but only " + std::to_string(kept) +
             (kept == 1 ? " is" : " are") + " in half of the shapes and " + (kept == 1 ? "has" : "have") +
             " half a percent of the area (" + named + "); no partition without such parts was found" +
             (kept > 1 ? "; try --parts " + std::to_string(kept) : std::string()));
}

std::string describe_starts(const CutResult& cut) {
    const auto starts = static_cast<std::int64_t>(cut.starts.size());
    if (cut.starts_left_out == 0) return with_unit(starts, "start", "starts");
    return std::to_string(starts) + " of " + with_unit(starts + cut.starts_left_out, "start", "starts");
}

Partitioned partition_whole(const Comm& comm, const Collection& collection, PatchFeatures features,
                            const PartitionTask& task, StageLog& log) {
    log.begin("optimise");
    Optimisation optimisation = optimise(comm, collection, features, task.optimise, task.tiles, &log);
    log.end(describe(optimisation));
    if (task.partition.parts != 1) refuse_empty_solution(optimisation.result, "the collection");
    ShapeAlignment alignment =
        alignment_stage(comm, collection, features, optimisation.result.coefficients, task.partition, log);
    features.positions = linked_positions(comm, alignment, optimisation.result.coefficients,
                                          features.positions, collection.numbering.mesh_of());
    Eigen::Matrix3Xd positions = features.positions;
    const PartitionInput input =
        partition_input(comm, collection, std::move(features), optimisation.result.coefficients,
                        task.partition, task.examples);
    log.begin("cut");
    CutResult cut = cut_or_found(comm, input, task.partition, task.cuts);
    const auto parts = static_cast<int>(cut.part_share.size());
    const std::string counted =
        cut.part_counts.empty() ? std::string() : "; auto: " + part_count_sentence(cut.part_counts);
    log.end(describe_starts(cut) + ", " + std::to_string(parts) + " parts" + counted);
    warn_of_degenerate_parts(cut, parts, static_cast<int>(collection.meshes.size()), log);
    return {std::move(optimisation), std::move(cut), std::move(alignment), std::move(positions)};
}

Partitioned partition_in_subsets(const Comm& comm, const Collection& collection,
                                 const PatchFeatures& features, const PartitionTask& task, StageLog& log) {
    log.begin("subsets");
    SubsetOutcome outcome = partition_subsets(comm, collection, features, task);
    log.end(with_unit(outcome.optimisation.subsets, "subset", "subsets") + ", " +
            with_unit(outcome.optimisation.common_meshes, "common shape", "common shapes") + ", " +
            significant(100.0 * outcome.optimisation.subset_agreement) + " % agreement on these");
    ShapeAlignment alignment = alignment_stage(comm, collection, features,
                                               outcome.optimisation.result.coefficients, task.partition, log);
    Eigen::Matrix3Xd positions = linked_positions(comm, alignment, outcome.optimisation.result.coefficients,
                                                  features.positions, collection.numbering.mesh_of());
    return {std::move(outcome.optimisation), std::move(outcome.cut), std::move(alignment),
            std::move(positions)};
}

Partitioned first_pass(const Comm& comm, const Collection& collection, PatchFeatures features,
                       const PartitionTask& task, StageLog& log) {
    const int subset = task.partition.subsets;
    const bool is_whole = subset == 0 || static_cast<int>(collection.meshes.size()) <= subset;
    return is_whole ? partition_whole(comm, collection, std::move(features), task, log)
                    : partition_in_subsets(comm, collection, features, task, log);
}

}  // namespace

void refuse_too_many_parts(const Collection& collection, int parts) {
    const int patches = collection.numbering.patch_count();
    if (parts <= patches) return;
    throw AgreedError(ExitCode::input,
                      "--parts " + std::to_string(parts) + " exceeds the " + std::to_string(patches) +
                          " patches of the collection; ask for fewer parts or more --patches");
}

Partitioned partition_stage(const Comm& comm, const Collection& collection, PatchFeatures features,
                            const PartitionTask& task, StageLog& log) {
    if (collection.meshes.size() == 1)
        log.warn("one mesh alone: it is cut by its own features, with nothing to agree with");
    if (!task.partition.segments) return first_pass(comm, collection, std::move(features), task, log);
    // The second pass asks for them again.
    Partitioned done = first_pass(comm, collection, features, task, log);
    log.begin("segments");
    done.cut = partition_segments(comm, collection, features, done.cut, task);
    log.end("second pass");
    return done;
}

}  // namespace coseg
