#include "mpi_drivers/co_segmentation.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "io/mesh_files/mesh_list.hpp"
#include "io/reports/report_page.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/optimise_stage.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/partition_checkpoint.hpp"
#include "mpi_drivers/partition/run_model.hpp"
#include "mpi_drivers/partition/segment_stage.hpp"
#include "mpi_drivers/partition/subset_stage.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "mpi_drivers/results/feature_output.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "mpi_drivers/results/output_stage.hpp"
#include "mpi_drivers/results/picture_stage.hpp"
#include "mpi_drivers/results/profile.hpp"
#include "mpi_drivers/results/report_stage.hpp"
#include "solvers/petsc/petsc_log.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

namespace {

std::string with_unit(std::int64_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// Options that begin with `prefix`: those of the eigensolver ("-eps_") are all known before the run, others
/// only after it.
void refuse_unused_petsc_options(const Comm& comm, const std::string& prefix) {
    agree(comm, [&] {
        std::string list;
        for (const std::string& option : unused_petsc_options()) {
            if (option.starts_with(prefix)) list += (list.empty() ? "" : ", ") + option;
        }
        if (list.empty()) return;
        throw Error(ExitCode::usage, "unused PETSc option: " + list + "; check its spelling or leave it out");
    });
}

void refuse_no_feature(const RunOptions& options) {
    const std::vector<double>& weights = options.feature_weights;
    if (!options.face_features.empty() && options.face_feature_weight > 0.0) return;
    if (std::any_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; })) return;
    throw AgreedError(ExitCode::usage, "--feature-weights: all are zero; give at least one that is positive");
}

/// The paper's code adds an offset to the affinity, which leaves the balance without a meaning.
void refuse_balanced_paper(const RunOptions& options) {
    if (options.preset != "paper" || options.mesh_balance <= 0.0) return;
    throw AgreedError(ExitCode::usage,
                      "--mesh-balance cannot be joined with --preset paper; leave one of them out");
}

void refuse_too_many_parts(const Collection& collection, const RunOptions& options) {
    const int patches = collection.numbering.patch_count();
    if (options.parts <= patches) return;
    throw AgreedError(ExitCode::input,
                      "--parts " + std::to_string(options.parts) + " exceeds the " + std::to_string(patches) +
                          " patches of the collection; ask for fewer parts or more --patches");
}

/// With --force the labels/, patches/ and ply/ of DIR are replaced: no place for the meshes themselves.
void refuse_input_in_results(const std::vector<MeshEntry>& entries, const std::string& out) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path results = fs::weakly_canonical(fs::absolute(out), ignored);
    std::set<fs::path> seen;  // a collection has far fewer folders than meshes
    for (const MeshEntry& entry : entries) {
        const fs::path parent = fs::absolute(entry.path).parent_path();
        if (!seen.insert(parent).second) continue;
        for (const char* own : {"labels", "patches", "ply"}) {
            if (!fs::equivalent(parent, results / own, ignored)) continue;
            throw Error(ExitCode::output, entry.path + ": lies in the folder " + own +
                                              "/ of the results, which the run replaces; name another --out");
        }
    }
}

void warn_of_meshes(const Collection& collection, const StageLog& log) {
    constexpr std::size_t shown = 10;
    std::size_t told = 0;
    std::size_t left = 0;
    const auto tell = [&](const std::string& sentence) {
        ++told <= shown ? log.warn(sentence) : void(++left);
    };
    for (const SetAside& mesh : collection.set_aside) tell("set aside: " + mesh.reason);
    for (const MeshFacts& mesh : collection.meshes) {
        for (const std::string& warning : mesh.warnings) tell(warning);
    }
    if (left > 0)
        log.warn(with_unit(static_cast<std::int64_t>(left), "more warning is", "more warnings are") +
                 " in the report");
    if (collection.meshes.size() == 1)
        log.warn("one mesh alone: it is cut by its own features, with nothing to agree with");
}

Verbosity verbosity_of(const RunOptions& options) {
    if (options.quiet) return Verbosity::quiet;
    return options.verbose ? Verbosity::verbose : Verbosity::normal;
}

std::string reuse_summary(const Collection& collection) {
    const auto reused = std::count_if(collection.meshes.begin(), collection.meshes.end(),
                                      [](const MeshFacts& mesh) { return mesh.reused; });
    return reused > 0 ? ", " + std::to_string(reused) + " from the state folder" : "";
}

DescribedCollection describe_stage(const Comm& comm, const RunOptions& options, const RunState* state,
                                   StageLog& log) {
    const std::vector<MeshEntry> entries = list_meshes(comm, options.inputs);
    agree(comm, [&] {
        if (comm.is_root()) refuse_input_in_results(entries, options.out);
    });
    log.begin("describe");
    DescribedCollection described = describe_collection(comm, entries, options, state, log);
    const Collection& collection = described.collection;
    std::int64_t faces = 0;
    for (const MeshFacts& mesh : collection.meshes) faces += mesh.input_faces;
    log.end(with_unit(static_cast<std::int64_t>(collection.meshes.size()), "shape", "shapes") + ", " +
            with_unit(faces, "face", "faces") + ", " +
            with_unit(collection.numbering.patch_count(), "patch", "patches") + reuse_summary(collection));
    warn_of_meshes(collection, log);
    refuse_too_many_parts(collection, options);
    return described;
}

/// What finds and keeps the results of the optimiser and the cut in a state folder.
struct Checkpoints {
    Checkpoints(const Comm& comm, const RunState& state,
                const std::vector<std::pair<std::string, std::string>>& resolved,
                const std::vector<std::string>& petsc_arguments)
        : tiles(comm, state), cuts(comm, state, cut_option_text(resolved, petsc_arguments)) {}
    SolverCheckpointFiles tiles;
    PartitionCheckpoint cuts;
};

SolverCheckpoint* tiles_of(Checkpoints* checkpoints) {
    return checkpoints != nullptr ? &checkpoints->tiles : nullptr;
}
PartitionCheckpoint* cuts_of(Checkpoints* checkpoints) {
    return checkpoints != nullptr ? &checkpoints->cuts : nullptr;
}

struct Partitioned {
    Optimisation optimisation;
    CutResult cut;
};

/// In a large collection they are most of the memory, which the cut needs for its graphs.
void release_histograms(PatchFeatures& features, const RunOptions& options) {
    const bool still_wanted = options.partition == "diffusion" || options.segments;
    if (!still_wanted) features.histograms = {};
}

Partitioned partition_whole(const Comm& comm, const Collection& collection, PatchFeatures& features,
                            const RunOptions& options, Checkpoints* checkpoints, StageLog& log) {
    Partitioned done;
    log.begin("optimise");
    done.optimisation = optimise(comm, collection, features, options, tiles_of(checkpoints), &log);
    const SolveResult& solution = done.optimisation.result;
    log.end(describe(done.optimisation));
    if (options.parts > 1) refuse_empty_solution(solution, "the collection");
    const PartitionInput input{collection, features, solution.coefficients, choice_descriptors(features, options)};
    release_histograms(features, options);
    log.begin("cut");
    done.cut = cut_or_found(comm, input, options, cuts_of(checkpoints));
    log.end(with_unit(static_cast<std::int64_t>(done.cut.starts.size()), "start", "starts") + ", " +
            std::to_string(options.parts) + " parts");
    return done;
}

Partitioned partition_in_subsets(const Comm& comm, const Collection& collection,
                                 const PatchFeatures& features, const RunOptions& options,
                                 Checkpoints* checkpoints, StageLog& log) {
    log.begin("subsets");
    SubsetOutcome outcome =
        partition_subsets(comm, collection, features, options, tiles_of(checkpoints), cuts_of(checkpoints));
    log.end(with_unit(outcome.optimisation.subsets, "subset", "subsets") + ", " +
            with_unit(outcome.optimisation.common_meshes, "common shape", "common shapes") + ", " +
            significant(100.0 * outcome.optimisation.subset_agreement) + " % agreement on these");
    return {std::move(outcome.optimisation), std::move(outcome.cut)};
}

Partitioned partition_stage(const Comm& comm, const Collection& collection, PatchFeatures& features,
                            const RunOptions& options, Checkpoints* checkpoints, StageLog& log) {
    const bool whole = options.subsets == 0 || static_cast<int>(collection.meshes.size()) <= options.subsets;
    Partitioned done = whole ? partition_whole(comm, collection, features, options, checkpoints, log)
                             : partition_in_subsets(comm, collection, features, options, checkpoints, log);
    if (options.segments) {
        log.begin("segments");
        done.cut = partition_segments(comm, collection, features, done.cut, options, tiles_of(checkpoints),
                                      cuts_of(checkpoints));
        log.end("second pass");
    }
    return done;
}

ReportState summarised(const Comm& comm, const RunState& state, const Checkpoints& checkpoints,
                       const Collection& collection) {
    ReportState summary;
    summary.folder = state.folder().path();
    for (const MeshFacts& mesh : collection.meshes)
        ++(mesh.reused ? summary.meshes_reused : summary.meshes_described);
    summary.tiles_reused = all_sum(comm, std::int64_t{checkpoints.tiles.found_count()});
    summary.tiles_solved = all_sum(comm, std::int64_t{checkpoints.tiles.kept_count()});
    summary.cuts_reused = checkpoints.cuts.found_count();
    return summary;
}

PatchFeatures feature_stage(const Comm& comm, const Collection& collection,
                            CollectionDescriptors descriptors, const RunOptions& options,
                            StageLog& log) {
    log.begin("features");
    PatchFeatures features = patch_features(comm, collection, std::move(descriptors), options);
    log.end(with_unit(static_cast<std::int64_t>(features.histograms.size()), "feature", "features") + " of " +
            std::to_string(options.bins) + " bins");
    warn_of_copies(features, log);
    return features;
}

void picture_and_page(const Comm& comm, const ResultFolder& folder, const RunOutcome& run, StageLog& log) {
    if (run.options.sheet) {
        log.begin("picture");
        write_run_sheet(comm, folder, run.collection, run.labels, run.options);
        log.end(run.options.out + "/contact_sheet.png");
    }
    write_run_report(comm, folder, run, log);
    if (run.options.html && can_write_report_page()) {
        log.begin("page");
        write_html_report(comm, {folder.staging(), {}, ""}, folder.staging(),
                          {run.options.view, run.options.up});
        log.end(run.options.out + "/report.html");
    }
}

}  // namespace

void co_segment(const Comm& comm, const RunOptions& options,
                const std::vector<std::pair<std::string, std::string>>& resolved,
                const std::vector<std::string>& petsc_arguments) {
    StageLog log(comm, verbosity_of(options), options.json_log ? LogForm::json : LogForm::text);
    const std::string unknown = unknown_petsc_option(petsc_arguments);
    if (!unknown.empty())
        throw AgreedError(ExitCode::usage, "after --: " + unknown + " is not an option of PETSc or SLEPc");
    refuse_no_feature(options);
    refuse_balanced_paper(options);
    const PetscSession session(petsc_arguments);
    refuse_unused_petsc_options(comm, "-eps_");
    if (options.profile) {
        begin_petsc_log();
        log.keep_trace();
    }
    std::optional<RunState> state;
    if (!options.state.empty())
        state.emplace(comm, options.state, LockMode::exclusive, options.checkpoint_seconds);
    ResultFolder folder(comm, options.out, options.force);

    DescribedCollection described = describe_stage(comm, options, state ? &*state : nullptr, log);
    const Collection& collection = described.collection;

    PatchFeatures features = feature_stage(comm, collection, std::move(described.descriptors), options, log);
    if (options.keep_features) write_features(comm, collection, features, folder.staging() + "/features.h5");
    if (state) state->end_if_asked(comm, "all meshes");

    std::optional<Checkpoints> checkpoints;
    if (state) checkpoints.emplace(comm, *state, resolved, petsc_arguments);
    ModelPatches model;
    if (options.keep_model && comm.is_root()) model = model_patches(collection, features, options.seed);
    const Partitioned partitioned =
        partition_stage(comm, collection, features, options, checkpoints ? &*checkpoints : nullptr, log);
    const Optimisation& optimisation = partitioned.optimisation;
    const CutResult& cut = partitioned.cut;
    std::optional<ReportState> state_summary;
    if (checkpoints) {
        state_summary = summarised(comm, *state, *checkpoints, collection);
        for (const std::string& warning : checkpoints->tiles.warnings()) log.warn(warning);
        for (const std::string& warning : checkpoints->cuts.warnings()) log.warn(warning);
        state->end_if_asked(comm, "all meshes, the optimiser's progress and the cut");
    }

    log.begin("label");
    const std::vector<MeshLabels> labels = label_faces(collection, cut.part_of_patch, options);
    log.end("one part per face");

    refuse_unused_petsc_options(comm, "-");
    log.begin("write");
    write_meshes(comm, folder, collection, labels);
    if (options.keep_model)
        write_run_model(comm, folder.staging() + "/" + model_file, collection, features, model,
                        cut.part_of_patch, options);
    log.end(options.out);
    picture_and_page(comm, folder,
                     {collection, features, optimisation, cut, labels, options, resolved, state_summary},
                     log);
    if (options.profile) write_profile(comm, folder.staging(), options, log);
    folder.commit(comm);
    refuse_unreached_gap(optimisation.result, options.gap, options.out);
}

}  // namespace coseg
