// `coseg render`: contact sheets from a finished run.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/data_files/name_file.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/sheet_kinds.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

struct RenderOptions {
    FinishedInput input;
    std::vector<std::string> kinds = {"parts"};
    std::string names;
    std::string out;
    ViewChoice view;
};

bool needs_truth(const std::vector<std::string>& kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [](const std::string& kind) {
        const std::optional<SheetColoring> coloring = named<SheetColoring>(kind);
        return coloring == SheetColoring::truth || coloring == SheetColoring::errors;
    });
}

std::string comma_separated(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// --names, else what lies beside the true labels, else none. Collective; throws AgreedError(input).
LabelNames chosen_names(const Comm& world, const FinishedRun& run, const RenderOptions& options) {
    LabelNames names;
    agree(world, [&] {
        names = options.names.empty() ? names_beside_truth(options.input.truth) : read_names(options.names);
        if (options.input.truth.empty()) refuse_names_beyond(names, run.parts, options.names);
    });
    return names;
}

/// Collective over the invocation's ranks.
void render(const RenderOptions& options, const Comm& world) {
    if (needs_truth(options.kinds) && options.input.truth.empty())
        throw AgreedError(ExitCode::usage,
                          "truth and errors need the folder of the true labels: --truth DIR");
    const FinishedRun run = read_run(world, options.input.folder);
    const std::string out = options.out.empty() ? options.input.folder : options.out;
    agree(world, [&] {
        if (world.is_root()) check_output_folder(out);
    });
    const std::vector<LabelledMesh> shapes = read_shapes(world, run, options.input);
    PartKey key{{}, chosen_names(world, run, options)};
    if (!options.input.truth.empty()) key.label_of_part = agree_on_truth(world, shapes, run.parts);
    agree(world, [&] {
        std::error_code cause;
        if (world.is_root()) std::filesystem::create_directories(out, cause);
        if (cause) throw Error(ExitCode::output, out + ": cannot be made (" + cause.message() + ")");
    });
    for (const std::string& kind : options.kinds) {
        const DrawnKind drawn = drawn_kind(world, run, shapes, kind, key);
        const View view = agree_on_view(world, drawn.shapes, options.view);
        const std::vector<std::string> files = write_sheets(
            world, out, {kind, drawn.heading, view}, drawn.shapes, static_cast<int>(run.shapes.size()));
        for (const std::string& file : files) std::cout << out << "/" << file << "\n";
    }
    std::cout.flush();
}

}  // namespace

Command add_render_command(CLI::App& parent) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* app = parent.add_subcommand("render", "Draw contact sheets of a finished run");
    app->add_option("RESULT", options->input.folder, "The folder that coseg run was given with --out")
        ->required();
    app->add_option("--what", options->kinds,
                    "What colours the faces, one or several with commas: " + comma_separated(sheet_kinds()))
        ->delimiter(',')
        ->capture_default_str()
        ->check(CLI::IsMember(sheet_kinds()))
        ->type_name("KIND,...");
    app->add_option("--truth", options->input.truth,
                    "Folder of true labels, NAME.seg: for truth and errors, and to name the parts");
    app->add_option("--names", options->names,
                    "Names for the legend, one a line or `NUMBER NAME`: of the true labels, or of the parts "
                    "without --truth; labels.txt in the folder of --truth if not given")
        ->type_name("FILE");
    app->add_option("--meshes", options->input.meshes,
                    "Where the meshes are now, if not where the run found them: files, folders or @LIST")
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--view", options->view.view,
                    "auto (the largest outlines), front, back, left, right, top, bottom, corner, or "
                    "AZIMUTH,ELEVATION in degrees")
        ->capture_default_str();
    add_enum_option(*app, "--up", options->view.up, "The axis that points up: auto, x, y, z");
    app->add_option("--out", options->out, "Folder for the pictures; RESULT itself if not given");
    app->footer("Example: mpirun -n 2 coseg render result --what parts,errors --truth my_labels");
    return {app, [options](const Invocation& invocation) { render(*options, invocation.world); }};
}

}  // namespace coseg
