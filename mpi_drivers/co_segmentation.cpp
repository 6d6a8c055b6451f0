#include "mpi_drivers/co_segmentation.hpp"

#include <utility>

#include "mpi_drivers/describe/face_features.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "mpi_drivers/partition/run_checkpoints.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
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

CoSegmented co_segment(const Comm& comm, const std::vector<MeshEntry>* entries, const RunOptions& given,
                       const std::vector<std::string>& petsc_arguments, StageLog& log) {
    const RunOptions options = with_parts_of_examples(comm, given);
    const auto& [preset, description, feature_options, optimise, partition, output, process] = options;
    refuse_contradictions(options);
    if (output.profile) begin_profile(log);
    RunFolders folders(comm, output, process);

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
        write_features(comm, collection, features, folders.results() + "/features.h5");
    const std::vector<NamedRange> ranges = features.ranges;
    ModelPatches model;
    if (output.keep_model && (comm.is_root() || entries != nullptr))
        model = model_patches(collection, features, optimise.seed);
    folders.end_if_asked(comm, "all meshes");
    const GivenLabels examples = read_examples(comm, collection, partition, log);

    // Equations (6) to (8): the patches' coefficients over each other, their affinity, and its cut into
    // parts.
    const std::vector<OptionValue> values = option_values(options);
    RunCheckpoints checkpoints(comm, folders.state(), cut_option_text(values, petsc_arguments));
    auto [optimisation, cut, alignment] = partition_stage(
        comm, collection, std::move(features),
        {optimise, partition, examples.patches, checkpoints.tiles(), checkpoints.cuts()}, log);
    checkpoints.warn_of_damage(log);
    folders.end_if_asked(comm, "all meshes, the optimiser's progress and the cut");

    // The parts of faces: a vote of the over-segmentations, and boundaries that follow creases.
    const std::vector<int>& part_of_patch = cut.part_of_patch;
    std::vector<MeshLabels> labels =
        label_faces(collection, cut, partition.parts, output.refine, log, examples.faces);
    if (!petsc_arguments.empty()) CheckedPetsc::refuse_unused(comm);

    const RunOutcome outcome{collection,   ranges,
                             optimisation, cut,
                             labels,       partition.parts,
                             values,       state_summary(comm, folders.state(), &checkpoints, collection),
                             &alignment};
    std::string report;
    if (folders.keeps_results()) {
        if (output.keep_model)
            write_run_model(comm, folders.results(), collection, model, part_of_patch, options);
        report = write_results(comm, folders.results(), outcome, output, log);
        if (output.profile) write_profile(comm, folders.results(), process, log);
    } else {
        report = run_report(comm, outcome, log);
    }
    folders.commit(comm);
    return {std::move(collection), std::move(optimisation), std::move(cut),
            std::move(labels),     std::move(model),        std::move(report)};
}

}  // namespace coseg
