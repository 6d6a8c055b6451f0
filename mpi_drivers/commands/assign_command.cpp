// coseg assign: labels new shapes consistently with a finished run, without solving it again.

#include <CLI/CLI.hpp>
#include <memory>

#include "io/mesh_files/mesh_format.hpp"
#include "mpi_drivers/assignment.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/launch_option.hpp"

namespace coseg {

namespace {

struct AssignOptions {
    std::string run;
    RunOptions own;  ///< of the command line: input, output, state, picture
};

}  // namespace

Command add_assign_command(CLI::App& parent) {
    const auto options = std::make_shared<AssignOptions>();
    RunOptions& own = options->own;
    CLI::App* app = parent.add_subcommand("assign", "Label new shapes like those of a finished run");
    app->add_option("--to", options->run, "The folder that coseg run was given with --out")
        ->required()
        ->type_name("RUN");
    app->add_option(
           "input", own.process.inputs,
           "Meshes (" + readable_formats() + "), folders of them, or @LIST: a file with a path a line")
        ->required()
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--out", own.output.folder, "Folder for the results; must be new or empty unless --force")
        ->required();
    app->add_flag("--force", own.output.force, "Replace earlier results in a folder that is not empty");
    app->add_flag("--strict", own.process.strict,
                  "A mesh that cannot be used ends the command instead of being set aside");
    app->add_option("--state", own.process.state, "Folder that keeps descriptions of meshes, as of coseg run")
        ->type_name("DIR");
    app->add_option("--face-features", own.features.face_features,
                    "Folder with the face features of the new shapes, of the same kind as the run's")
        ->type_name("DIR");
    app->add_option(
           "--examples", own.partition.examples,
           "Folder with NAME.seg for some of the new shapes: one part of the run for each face, or -1 where "
           "nothing is said. These faces keep their parts, and new shapes that are like them follow")
        ->type_name("DIR");
    add_ranks_option(*app);
    app->add_flag("--sheet,!--no-sheet", own.output.sheet, "Draw contact_sheet.png (on by default)");
    app->add_flag("--html,!--no-html", own.output.html, "Write report.html (on by default)");
    app->add_option("--view", own.output.view.view, "View of the picture; see coseg render --help")
        ->capture_default_str();
    add_enum_option(*app, "--up", own.output.view.up, "The axis that points up: auto, x, y, z");
    app->add_flag("--quiet", own.process.quiet, "No progress lines; warnings and errors only");
    app->add_flag("--verbose", own.process.verbose, "Also say what the steps of a stage took");
    app->add_flag("--json-log", own.process.json_log, "Progress and warnings as one JSON object a line");
    app->footer(
        "All other options are those of the run.\nExample: coseg assign --to result --out more new_chairs/");
    return {app, [options](const Invocation& invocation) {
                assign(invocation.world, options->run, options->own, invocation.petsc_arguments);
            }};
}

}  // namespace coseg
