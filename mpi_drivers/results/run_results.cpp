#include "mpi_drivers/results/run_results.hpp"

#include <vector>

#include "io/data_files/result_files.hpp"
#include "io/files/atomic_file.hpp"
#include "io/folders/finished_run.hpp"
#include "io/reports/report_page.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/results/alignment_output.hpp"
#include "mpi_drivers/results/level_output.hpp"
#include "mpi_drivers/results/picture_stage.hpp"
#include "mpi_drivers/results/report_stage.hpp"

namespace coseg {

namespace {

/// The coloured meshes in the folder: the files of the meshes may have changed, or be gone, since they were
/// read.
std::vector<std::string> written_meshes(const std::string& folder, const Collection& collection) {
    std::vector<std::string> paths;
    for (const MeshFacts& mesh : collection.meshes)
        paths.push_back(result_files::path_of(result_files::colored_meshes, folder, mesh.name));
    return paths;
}

}  // namespace

std::optional<ReportState> state_summary(const Comm& comm, const RunState* state,
                                         const RunCheckpoints* checkpoints, const Collection& collection) {
    if (state == nullptr) return std::nullopt;
    ReportState summary;
    summary.folder = state->folder().path();
    for (const MeshFacts& mesh : collection.meshes)
        ++(mesh.reused ? summary.meshes_reused : summary.meshes_described);
    if (checkpoints == nullptr) return summary;
    const RunCheckpoints::Counts counts = checkpoints->counts(comm);
    summary.tiles_reused = counts.tiles_found;
    summary.tiles_solved = counts.tiles_solved;
    summary.cuts_reused = counts.cuts_found;
    return summary;
}

std::string write_results(const Comm& comm, const std::string& folder, const RunOutcome& outcome,
                          const OutputOptions& options, StageLog& log) {
    log.begin("write");
    write_meshes(comm, folder, outcome.collection, outcome.labels);
    write_levels(comm, folder, outcome.collection, outcome.cut, outcome.labels);
    if (outcome.alignment != nullptr)
        write_alignment_file(comm, folder, outcome.collection, *outcome.alignment);
    log.end(options.folder);
    if (options.sheet) {
        log.begin("picture");
        write_run_sheet(comm, folder, outcome, options.view);
        write_affinity_picture(comm, folder, outcome);
        log.end(options.folder + "/" + sheet_file(to_string(SheetColoring::parts)));
    }
    std::string report = run_report(comm, outcome, log);
    agree(comm, [&] {
        if (comm.is_root()) write_file(report_path(folder), report);
    });
    if (options.html && can_write_report_page()) {
        log.begin("page");
        write_html_report(comm, {folder, written_meshes(folder, outcome.collection), ""}, folder,
                          options.view);
        log.end(options.folder + "/" + result_files::page);
    }
    return report;
}

}  // namespace coseg
