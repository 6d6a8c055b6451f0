// `coseg report`: report.html of a finished run.

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "io/data_files/result_files.hpp"
#include "io/reports/report_page.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/enum_option.hpp"
#include "mpi_drivers/results/report_stage.hpp"
#include "src/base/error.hpp"

namespace coseg {

Command add_report_command(CLI::App& parent) {
    const auto input = std::make_shared<FinishedInput>();
    const auto choice = std::make_shared<ViewChoice>();
    CLI::App* app = parent.add_subcommand(
        "report", "Write report.html of a finished run: one file to look at and to pass on");
    app->add_option("RESULT", input->folder, "The folder that coseg run was given with --out")->required();
    app->add_option("--truth", input->truth,
                    "Folder of true labels, NAME.seg: accuracy and wrong faces are shown");
    app->add_option("--meshes", input->meshes,
                    "Where the meshes are now, if not where the run found them: files, folders or @LIST")
        ->type_name("MESH|DIRECTORY|@LIST");
    add_enum_option(*app, "--up", choice->up, "The axis that points up: auto, x, y, z");
    app->footer("Example: coseg report result --truth my_labels");
    return {app, [input, choice](const Invocation& invocation) {
                write_html_report(invocation.world, *input, input->folder, *choice);
                if (invocation.world.is_root())
                    std::cout << input->folder << "/" << result_files::page << std::endl;
            }};
}

}  // namespace coseg
