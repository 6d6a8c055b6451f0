#include "mpi_drivers/co_segmentation.hpp"

#include <utility>

#include "io/data_files/result_files.hpp"
#include "mpi_drivers/describe/face_features.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/editing/correction_stage.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "mpi_drivers/partition/run_checkpoints.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
#include "mpi_drivers/results/alignment_output.hpp"
#include "mpi_drivers/results/feature_output.hpp"
#include "mpi_drivers/results/profile.hpp"
#include "mpi_drivers/results/run_folders.hpp"
#include "mpi_drivers/results/run_results.hpp"

namespace coseg {

void co_segment(const Comm& comm, const RunOptions& options,
                const std::vector<std::string>& petsc_arguments) {
    refuse_contradictions(options);
    StageLog log(comm, options.process.verbosity(), options.process.log_form());
    const CheckedPetsc petsc(comm, petsc_arguments);
    const CoSegmented done = co_segment(comm, nullptr, options, petsc_arguments, log);
    refuse_unreached_gap(done.optimisation.result, options.optimise.gap, options.output.folder);
}

namespace {

/// The stages up to the cut, with what is written of them on the way.
struct PartitionedRun {
    BasePartition base;
    std::vector<NamedRange> ranges;
    ModelPatches model;
    ShapeAlignment alignment;
};

/// Where a run keeps what it has found.
struct KeptPlaces {
    const RunFolders& folders;
    RunCheckpoints& checkpoints;
};

PartitionedRun partitioned(const Comm& comm, const std::vector<MeshEntry>* entries, const RunOptions& options,
                           const KeptPlaces& kept_in, bool keeps_features, StageLog& log) {
    const auto& [folders, checkpoints] = kept_in;
    const auto& [preset, description, feature_options, optimise, partition, output, process] = options;
    // Every mesh by itself: patches by over-segmentation, and the descriptors of its faces.
    auto [collection, descriptors] =
        describe_collection(comm, folders.meshes_outside(comm, entries, process.inputs),
                            description_options(options), process.strict, folders.state(), log);
    refuse_too_many_parts(collection, partition.parts);

    // The features of patches: histograms of the descriptors, in bins that all meshes share.
    PatchFeatures features = patch_features(
        comm, collection, weighted_descriptors(comm, collection, std::move(descriptors), feature_options),
        feature_options, nullptr, log);
    if (output.keep_features && folders.keeps_results())
        write_features(comm, collection, features, folders.results() + "/" + result_files::features);
    std::vector<NamedRange> ranges = features.ranges;
    ModelPatches model;
    if (output.keep_model)
        model = model_patches(comm, collection, features, optimise.seed, entries != nullptr);
    folders.end_if_asked(comm, "all meshes");
    GivenLabels examples = read_examples(comm, collection, partition, log);

    // Equations (6) to (8): the patches' coefficients over each other, their affinity, and its cut into
    // parts.
    PatchFeatures kept;
    if (keeps_features) kept = features;
    auto [optimisation, cut, alignment, positions] = partition_stage(
        comm, collection, std::move(features),
        {optimise, partition, examples.patches, checkpoints.tiles(), checkpoints.cuts()}, log);
    if (output.keep_model) model = in_frame(std::move(model), positions, alignment, cut.frame);
    if (keeps_features) kept.positions = std::move(positions);
    checkpoints.warn_of_damage(log);
    folders.end_if_asked(comm, "all meshes, the optimiser's progress and the cut");
    RunOptions counted = options;
    counted.partition.parts = static_cast<int>(cut.part_share.size());  // --parts auto has found it
    counted.description.oversegmentations = collection.numbering.oversegmentations();  // likewise
    return {{std::move(counted), std::move(collection), std::move(kept), std::move(optimisation),
             std::move(cut), std::move(examples)},
            std::move(ranges),
            std::move(model),
            std::move(alignment)};
}

constexpr const char* no_levels_with_corrections =
    "no levels are written: corrections and constraints change the parts of one level alone";

/// The run ends with this sentence; the report keeps it.
void keep_warning_of_gap(const Optimisation& optimisation, const RunOptions& options, StageLog& log) {
    const auto sentence = unreached_gap(optimisation.result, options.optimise.gap, "the optimiser");
    if (sentence) log.keep_warning(*sentence);
}

}  // namespace

BasePartition base_partition(const Comm& comm, const std::vector<MeshEntry>& entries, const RunOptions& given,
                             const std::vector<std::string>& petsc_arguments, StageLog& log) {
    const RunOptions options = with_parts_of_examples(comm, given);
    refuse_contradictions(options);
    const RunFolders folders(comm, options.output, options.process);
    RunCheckpoints checkpoints(comm, folders.state(),
                               cut_option_text(option_values(options), petsc_arguments));
    return partitioned(comm, &entries, options, {folders, checkpoints}, true, log).base;
}

CoSegmented co_segment(const Comm& comm, const std::vector<MeshEntry>* entries, const RunOptions& given,
                       const std::vector<std::string>& petsc_arguments, StageLog& log) {
    const GivenCorrections corrections = read_given_corrections(comm, given.partition);
    RunOptions options = with_levels_for(corrections, with_parts_of_examples(comm, given));
    refuse_contradictions(options);
    if (options.output.profile) begin_profile(log);
    RunFolders folders(comm, options.output, options.process);
    folders.keep_apart(comm, options.partition.examples);
    RunCheckpoints checkpoints(comm, folders.state(),
                               cut_option_text(option_values(options), petsc_arguments));
    auto [base, ranges, model, alignment] =
        partitioned(comm, entries, options, {folders, checkpoints}, corrections.is_given, log);
    auto& [base_options, collection, features, optimisation, cut, examples] = base;
    options = base_options;
    std::vector<OptionValue> values = option_values(options);

    // What a person says of the parts, and how the others follow.
    if (corrections.is_given) {
        FollowedCorrections followed =
            follow_corrections(comm, base.base(), corrections, base.solved(), options.partition, log);
        options.partition.parts = followed.parts;
        values = with_corrected_parts(std::move(values), followed.parts);
        cut = std::move(followed.corrected.cut);
        examples.faces = std::move(followed.corrected.faces);
        examples.names = std::move(followed.names);
        if (given.partition.levels) log.warn(no_levels_with_corrections);
        agree(comm, [&] {
            if (comm.is_root() && folders.keeps_results())
                write_corrections(folders.results() + "/" + result_files::corrections, followed.file);
        });
    }
    features = {};

    // The parts of faces: a vote of the over-segmentations, and boundaries that follow creases.
    const OutputOptions& output = options.output;
    const int parts = options.partition.parts;
    std::vector<MeshLabels> labels =
        label_faces(comm, collection, cut, {parts, output.refine}, log, examples.faces);
    if (!petsc_arguments.empty()) CheckedPetsc::refuse_unused(comm);
    keep_warning_of_gap(optimisation, options, log);

    const RunOutcome outcome{
        collection, ranges, optimisation, cut,
        labels,     parts,  values,       state_summary(comm, folders.state(), &checkpoints, collection),
        &alignment};
    std::string report;
    if (folders.keeps_results()) {
        if (output.keep_model)
            write_run_model(comm, folders.results(), collection, model, cut.part_of_patch, options);
        report = write_results(comm, folders.results(), outcome, output, log);
        write_part_names(comm, folders.results(), examples.names);
        if (output.profile) write_profile(comm, folders.results(), options.process, log);
    } else {
        report = run_report(comm, outcome, log);
    }
    AlignmentFile in_file_units;
    if (entries != nullptr) in_file_units = alignment_in_file_units(comm, collection, alignment);
    folders.commit(comm);
    return {std::move(options), std::move(collection), std::move(optimisation), std::move(cut),
            std::move(labels),  std::move(model),      std::move(report),       std::move(in_file_units)};
}

}  // namespace coseg
