// coseg assign: labels new shapes consistently with a finished run, without solving it again.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "io/mesh_files/mesh_format.hpp"
#include "io/reports/report_page.hpp"
#include "mpi_drivers/optimise/solution_output.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/run_option_table.hpp"
#include "mpi_drivers/partition/assign_stage.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "mpi_drivers/results/output_stage.hpp"
#include "mpi_drivers/results/picture_stage.hpp"
#include "mpi_drivers/results/report_stage.hpp"
#include "solvers/petsc/petsc_session.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

struct AssignOptions {
    std::string run;
    RunOptions own;  ///< of the command line: input, output, state, picture
    int ranks = 0;   ///< acted on before MPI starts, see self_launch.hpp
};

/// The run's options with what this command line says of input and output.
RunOptions merged(const RunModel& model, const RunOptions& own) {
    RunOptions options = model.options;
    options.inputs = own.inputs;
    options.out = own.out;
    options.force = own.force;
    options.strict = own.strict;
    options.quiet = own.quiet;
    options.verbose = own.verbose;
    options.json_log = own.json_log;
    options.keep_model = false;
    options.state = own.state;
    options.face_features = own.face_features;
    options.sheet = own.sheet;
    options.html = own.html;
    options.view = own.view;
    options.up = own.up;
    return options;
}

std::vector<std::pair<std::string, std::string>> resolved(const AssignOptions& command, RunOptions options) {
    CLI::App unused;
    std::vector<std::pair<std::string, std::string>> values = RunOptionTable(unused, options).resolved();
    values.emplace_back("to", command.run);
    return values;
}

DescribedCollection describe_new_shapes(const Comm& world, const RunOptions& options, const RunState* state,
                                        StageLog& log) {
    log.begin("describe");
    DescribedCollection result =
        describe_collection(world, list_meshes(world, options.inputs), options, state, log);
    const Collection& collection = result.collection;
    log.end(std::to_string(collection.meshes.size()) + " new shapes, " +
            std::to_string(collection.numbering.patch_count()) + " patches");
    for (const SetAside& mesh : collection.set_aside) log.warn("set aside: " + mesh.reason);
    for (const MeshFacts& mesh : collection.meshes) {
        for (const std::string& warning : mesh.warnings) log.warn(warning);
    }
    return result;
}

std::optional<ReportState> summary(const RunState* state, const Collection& collection) {
    if (state == nullptr) return std::nullopt;
    ReportState reused;
    reused.folder = state->folder().path();
    for (const MeshFacts& mesh : collection.meshes)
        ++(mesh.reused ? reused.meshes_reused : reused.meshes_described);
    return reused;
}

Verbosity verbosity_of(const RunOptions& options) {
    if (options.quiet) return Verbosity::quiet;
    return options.verbose ? Verbosity::verbose : Verbosity::normal;
}

/// Features that users give must be given of the run's shapes and of the new ones, or of neither.
void refuse_other_face_features(const RunModel& model, const AssignOptions& command) {
    const bool is_given = !command.own.face_features.empty();
    if (is_given && model.face_feature_dimensions == 0)
        throw AgreedError(ExitCode::usage, command.run + " was made without --face-features; leave it out");
    if (!is_given && model.face_feature_dimensions > 0)
        throw AgreedError(ExitCode::usage, command.run +
                                               " was made with --face-features; give it with the folder of "
                                               "what the new shapes have");
}

void refuse_other_dimensions(const RunModel& model, const CollectionDescriptors& descriptors,
                             const std::string& run) {
    const int given = descriptors.table.back().given_dimensions;
    if (given == model.face_feature_dimensions) return;
    throw AgreedError(ExitCode::input, "--face-features: there are " + std::to_string(given) +
                                           " numbers a face, but " + run + " was made with " +
                                           std::to_string(model.face_feature_dimensions));
}

/// Collective over the invocation's ranks.
void assign(const AssignOptions& command, const Invocation& invocation) {
    const Comm& world = invocation.world;
    StageLog log(world, verbosity_of(command.own), command.own.json_log ? LogForm::json : LogForm::text);
    const PetscSession session(invocation.petsc_arguments);
    RunModel model;
    agree(world, [&] { model = read_run_model(command.run); });
    refuse_other_face_features(model, command);
    if (!model.same_build) {
        log.warn(command.run +
                 " was made by a coseg that computes features from other sources or settings: where these "
                 "differ in result, labels suffer; run coseg run again to be sure");
    }
    const RunOptions options = merged(model, command.own);
    std::optional<RunState> state;
    if (!options.state.empty())
        state.emplace(world, options.state, LockMode::exclusive, options.checkpoint_seconds);
    ResultFolder folder(world, options.out, options.force);
    DescribedCollection described = describe_new_shapes(world, options, state ? &*state : nullptr, log);
    const Collection& collection = described.collection;
    refuse_other_dimensions(model, described.descriptors, command.run);
    const std::optional<ReportState> reused = summary(state ? &*state : nullptr, collection);
    log.begin("features");
    const PatchFeatures features =
        patch_features(world, collection, std::move(described.descriptors), options, &model.bins);
    log.end("in the bins and words of " + command.run);
    warn_of_copies(features, log);
    log.begin("assign");
    const Assigned assigned = assign_parts(world, collection, features, model, options);
    log.end(describe(assigned.optimisation));
    log.begin("label");
    const std::vector<MeshLabels> labels = label_faces(collection, assigned.cut.part_of_patch, options);
    log.end("one part per face");
    log.begin("write");
    write_meshes(world, folder, collection, labels);
    log.end(options.out);
    if (options.sheet) {
        log.begin("picture");
        write_run_sheet(world, folder, collection, labels, options);
        log.end(options.out + "/contact_sheet.png");
    }
    write_run_report(world, folder,
                     {collection, features, assigned.optimisation, assigned.cut, labels, options,
                      resolved(command, options), reused},
                     log);
    if (options.html && can_write_report_page()) {
        log.begin("page");
        write_html_report(world, {folder.staging(), {}, ""}, folder.staging(), {options.view, options.up});
        log.end(options.out + "/report.html");
    }
    folder.commit(world);
    refuse_unreached_gap(assigned.optimisation.result, options.gap, options.out);
}

}  // namespace

Command add_assign_command(CLI::App& parent) {
    const auto options = std::make_shared<AssignOptions>();
    RunOptions& own = options->own;
    CLI::App* app = parent.add_subcommand("assign", "Label new shapes like those of a finished run");
    app->add_option("--to", options->run, "The folder that coseg run was given with --out")
        ->required()
        ->type_name("RUN");
    app->add_option(
           "input", own.inputs,
           "Meshes (" + readable_formats() + "), folders of them, or @LIST: a file with a path a line")
        ->required()
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--out", own.out, "Folder for the results; must be new or empty unless --force")
        ->required();
    app->add_flag("--force", own.force, "Replace earlier results in a folder that is not empty");
    app->add_flag("--strict", own.strict,
                  "A mesh that cannot be used ends the command instead of being set aside");
    app->add_option("--state", own.state, "Folder that keeps descriptions of meshes, as of coseg run")
        ->type_name("DIR");
    app->add_option("--face-features", own.face_features,
                    "Folder with what the run had of its shapes, of the new ones; see coseg run --help")
        ->type_name("DIR");
    app->add_option("--ranks", options->ranks,
                    "Ranks of a command that is started without mpirun; 0: one for each core")
        ->check(CLI::Range(0, 100000));
    app->add_flag("--sheet,!--no-sheet", own.sheet, "Draw contact_sheet.png (on by default)");
    app->add_flag("--html,!--no-html", own.html, "Write report.html (on by default)");
    app->add_option("--view", own.view, "View of the picture; see coseg render --help")
        ->capture_default_str();
    app->add_option("--up", own.up, "The axis that points up: auto, x, y, z")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "x", "y", "z"}));
    app->add_flag("--quiet", own.quiet, "No progress lines; warnings and errors only");
    app->add_flag("--verbose", own.verbose, "Also say what the steps of a stage took");
    app->add_flag("--json-log", own.json_log, "Progress and warnings as one JSON object a line");
    app->footer(
        "All other options are those of the run.\nExample: coseg assign --to result --out more new_chairs/");
    return {app, [options](const Invocation& invocation) { assign(*options, invocation); }};
}

}  // namespace coseg
