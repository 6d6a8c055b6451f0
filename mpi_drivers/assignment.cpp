#include "mpi_drivers/assignment.hpp"

#include <filesystem>
#include <utility>

#include "io/data_files/name_file.hpp"
#include "mpi_drivers/describe/face_features.hpp"
#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
#include "mpi_drivers/results/alignment_output.hpp"
#include "mpi_drivers/results/run_folders.hpp"
#include "mpi_drivers/results/run_results.hpp"

namespace coseg {

namespace {

/// Results that replace the run's would take its model away, and with it the way to label more shapes.
void refuse_folder_of_run(const std::string& folder, const std::string& run) {
    std::error_code ignored;  // where one of them is not there, they are not the same
    if (!folder.empty() && std::filesystem::equivalent(folder, run, ignored))
        throw Error(ExitCode::usage, folder +
                                         " holds the run that the shapes are labelled like; write the new "
                                         "labels into a folder of their own");
}

/// What the run calls its parts, on rank 0; nothing where its folder says no names.
LabelNames names_of_run(const Comm& comm, const std::string& run) {
    LabelNames names;
    agree(comm, [&] {
        if (comm.is_root()) names = names_in_folder(run);
    });
    return names;
}

}  // namespace

void assign(const Comm& comm, const std::string& run, const RunOptions& own,
            const std::vector<std::string>& petsc_arguments) {
    StageLog log(comm, own.process.verbosity(), own.process.log_form());
    const CheckedPetsc petsc(comm, petsc_arguments);
    // Nothing is cut here: what has not been asked for by now never is.
    if (!petsc_arguments.empty()) CheckedPetsc::refuse_unused(comm);
    const RunModel model = agreed_run_model(comm, run, log);
    const AssignedLabels done = assign(comm, nullptr, model, run, own, log);
    refuse_unreached_gap(done.assigned.optimisation.result, model.options.optimise.gap, own.output.folder);
}

AssignedLabels assign(const Comm& comm, const std::vector<MeshEntry>* entries, const RunModel& model,
                      const std::string& run, const RunOptions& own, StageLog& log) {
    agree(comm, [&] { refuse_folder_of_run(own.output.folder, run); });
    refuse_other_face_features(model, own.features);
    const RunOptions options = options_of_assignment(model.options, own);
    const auto& [preset, description, feature_options, optimise, partition, output, process] = options;
    RunFolders folders(comm, output, process);
    folders.keep_apart(comm, partition.examples);

    // Every new mesh by itself, as the run described its own.
    auto [collection, descriptors] =
        describe_collection(comm, folders.meshes_outside(comm, entries, process.inputs),
                            description_options(options), process.strict, folders.state(), log);

    // The features of its patches, in the bins and words of the run.
    CollectionDescriptors weighted =
        weighted_descriptors(comm, collection, std::move(descriptors), feature_options);
    refuse_other_dimensions(model, weighted);
    const PatchFeatures features =
        patch_features(comm, collection, std::move(weighted), feature_options, &model.bins, log);

    // Its patches' coefficients over the run's patches, and labels that spread from these.
    const GivenLabels examples = read_given_labels(comm, collection, partition, log);
    Assigned assigned = assign_parts(comm, {collection, features, model, examples.patches}, optimise, log);

    // The parts of faces, as in the run.
    std::vector<MeshLabels> labels =
        label_faces(comm, collection, assigned.cut, {partition.parts, output.refine}, log, examples.faces);

    if (const auto sentence = unreached_gap(assigned.optimisation.result, optimise.gap, "the optimiser"))
        log.keep_warning(*sentence);
    std::vector<OptionValue> values = option_values(options);
    values.push_back({"to", run, Affects::cut});
    const RunOutcome outcome{collection,
                             features.ranges,
                             assigned.optimisation,
                             assigned.cut,
                             labels,
                             partition.parts,
                             values,
                             state_summary(comm, folders.state(), nullptr, collection),
                             &assigned.alignment};
    std::string report = folders.keeps_results()
                             ? write_results(comm, folders.results(), outcome, output, log)
                             : run_report(comm, outcome, log);
    if (folders.keeps_results()) write_part_names(comm, folders.results(), names_of_run(comm, run));
    AlignmentFile in_file_units;
    if (entries != nullptr) in_file_units = alignment_in_file_units(comm, collection, assigned.alignment);
    folders.commit(comm);
    return {std::move(collection), std::move(assigned), std::move(labels),
            partition.parts,       std::move(report),   std::move(in_file_units)};
}

}  // namespace coseg
