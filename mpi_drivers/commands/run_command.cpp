#include <CLI/CLI.hpp>
#include <memory>

#include "mpi_drivers/co_segmentation.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/help_pages.hpp"
#include "mpi_drivers/options/run_option_table.hpp"
#include "mpi_drivers/options/run_options.hpp"

namespace coseg {

Command add_run_command(CLI::App& parent) {
    CLI::App* app = parent.add_subcommand("run", "Cut a collection of shapes into the same parts");
    const auto options = std::make_shared<RunOptions>();
    const auto table = std::make_shared<RunOptionTable>(*app, *options);
    fold_help(*app, {"Options", "Input and output", "Picture"});
    app->footer(
        "More options, of patches, features, optimisation and partition: coseg run --help-all.\nWhat follows "
        "-- goes to PETSc and SLEPc.\nExample: coseg run --parts 4 --out result "
        "chairs/");
    return {app, [options, table](const Invocation& invocation) {
                co_segment(invocation.world, *options, invocation.petsc_arguments);
            }};
}

}  // namespace coseg
