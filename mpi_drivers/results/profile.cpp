#include "mpi_drivers/results/profile.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "io/data_files/result_files.hpp"
#include "io/files/atomic_file.hpp"
#include "io/reports/trace_file.hpp"
#include "solvers/petsc/petsc_log.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

std::string table_row(const std::string& name, double least, double mean, double most,
                      const std::string& wall) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, " %10.3f %10.3f %10.3f ", least, mean, most);
    std::string padded = name;
    padded.resize(std::max<std::size_t>(name.size(), 24), ' ');
    return padded + numbers + wall + "\n";
}

std::string wall_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%10.3f", seconds);
    return text;
}

std::string stage_table(const Comm& comm, const StageLog& log) {
    std::string table = "Seconds of a rank's own work over " + std::to_string(comm.size()) +
                        (comm.size() == 1 ? " rank" : " ranks") +
                        "; wall: with waiting\n\nstage, step                     least       mean       most "
                        "      wall\n";
    for (const StageTimes& stage : log.stages()) {
        table += table_row(stage.stage, stage.seconds_min, stage.seconds_mean, stage.seconds_max,
                           wall_text(stage.seconds_wall));
        for (const StepTime& step : stage.steps)
            table += table_row("  " + step.step, step.seconds_min, step.seconds / comm.size(),
                               step.seconds_max, "");
    }
    return table;
}

}  // namespace

void begin_profile(StageLog& log) {
    begin_petsc_log();
    log.keep_trace();
}

void write_profile(const Comm& comm, const std::string& folder, const ProcessOptions& options,
                   const StageLog& log) {
    const std::vector<RankTrace> traces = gather_records(comm, std::vector<RankTrace>{log.trace()});
    const std::string text = stage_table(comm, log) + "\n" + petsc_log_text(comm);
    agree(comm, [&] {
        if (!comm.is_root()) return;
        write_trace(folder + "/" + result_files::trace, traces);
        write_file(folder + "/" + result_files::profile, text);
    });
    if (comm.is_root() && !options.quiet && !options.json_log) std::fputs(text.c_str(), stderr);
}

}  // namespace coseg
