// coseg edit: serves a page on this machine in which a person corrects a finished run.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <tuple>

#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/folders/finished_run.hpp"
#include "io/folders/output_directory.hpp"
#include "io/folders/state_lock.hpp"
#include "io/reports/edit_page.hpp"
#include "mpi_drivers/co_segmentation.hpp"
#include "mpi_drivers/editing/correction_stage.hpp"
#include "mpi_drivers/editing/edit_desk.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/launch_option.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

struct EditOptions {
    std::string run;
    std::string state;
    std::vector<std::string> meshes;
    int port = 0;
    bool quiet = false;
};

bool is_corrected(const FinishedRun& run) {
    return std::any_of(run.options.begin(), run.options.end(),
                       [](const auto& option) { return option.first == base_parts_key; });
}

int number_of_parts(const std::string& text) {
    const std::optional<int> parts = whole_number(text);
    if (parts && *parts >= 1 && *parts <= most_parts) return *parts;
    throw Error(ExitCode::input, std::string(result_files::report) + ": '" + text +
                                     "' is no number of parts; run coseg run again");
}

/// As the run was made, before corrections, with nothing written.
RunOptions options_of(const FinishedRun& run, const EditOptions& given) {
    const std::vector<std::string> names = named_option_names();
    std::vector<NamedOption> options;
    std::string parts;
    std::string base_parts;
    for (const auto& [key, value] : run.options) {
        if (key == "parts") parts = value;
        if (key == base_parts_key) base_parts = value;
        const bool is_known = std::find(names.begin(), names.end(), key) != names.end();
        if (is_known && !value.empty() && key != "corrections" && key != "constraints" && key != "profile")
            options.emplace_back(key, value);
    }
    RunOptions result = options_by_name(options);
    result.partition.parts = number_of_parts(base_parts.empty() ? parts : base_parts);
    result.process.state = given.state.empty() ? run.state : given.state;
    result.process.quiet = given.quiet;
    result.output.keep_model = false;
    result.output.keep_features = false;
    return result;
}

/// Nobody should correct for an hour what no run would follow.
void refuse_uncorrectable(const FinishedRun& run, const RunOptions& options) {
    for (const auto& [key, value] : run.options) {
        if (key == "to")
            throw Error(ExitCode::input, "'" + run.folder + "' was made by coseg assign; correct the run '" +
                                             value +
                                             "', or give coseg assign the right parts with --examples");
    }
    if (!can_be_corrected(options.partition))
        throw Error(ExitCode::input, "'" + run.folder +
                                         "' was made with --parts 1, --subsets, --segments or --partition "
                                         "diffusion, which corrections do not follow; run it again without");
}

/// The meshes of the run: where it found them, or of the same names among `meshes`.
std::vector<MeshEntry> entries_of(const FinishedRun& run, const std::vector<std::string>& meshes) {
    std::vector<MeshEntry> entries;
    std::vector<MeshEntry> found;
    if (!meshes.empty()) found = expand_mesh_list(meshes);
    for (const FinishedShape& shape : run.shapes) {
        MeshEntry entry{shape.name, shape.path, 0, nullptr};
        if (!meshes.empty()) {
            const auto other = std::find_if(found.begin(), found.end(),
                                            [&](const MeshEntry& e) { return e.name == shape.name; });
            if (other == found.end())
                throw Error(ExitCode::input, "--meshes: there is no mesh '" + shape.name + "'");
            entry = *other;
        } else if (!std::filesystem::exists(shape.path)) {
            throw Error(ExitCode::input, shape.path +
                                             ": the mesh is no longer there; say with --meshes where the "
                                             "run's meshes are now");
        }
        entries.push_back(entry);
    }
    return entries;
}

struct MeshOfRun {
    std::string path;
    static constexpr auto fields() { return std::tuple(field("path", &MeshOfRun::path)); }
};

/// The patches of a shape depend on its own mesh alone, its labels on all meshes: what has other patches than
/// the run wrote is what has changed. If all have, something else has. Collective; throws AgreedError(input).
void refuse_other_meshes(const Comm& comm, const BasePartition& run, const std::string& folder,
                         const std::vector<MeshLabels>& labels) {
    std::vector<MeshOfRun> changed;
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshFacts& mesh = run.collection.meshes[at(run.collection.local[k].mesh)];
            if (read_labels(result_files::path_of(result_files::patches, folder, mesh.name)) !=
                labels[k].patch)
                changed.push_back({mesh.path});
        }
    });
    changed = all_gather_records(comm, changed);
    if (changed.empty() || changed.size() == run.collection.meshes.size()) return;
    const std::string others =
        changed.size() > 1 ? ", like " + std::to_string(changed.size() - 1) + " more" : "";
    throw AgreedError(ExitCode::input, changed.front().path + ": is not the mesh that the run was made of" +
                                           others + "; put it back, or run coseg run again");
}

/// Corrections of a partition that the run does not have would come to nothing.
void refuse_other_labels(const Comm& comm, const BasePartition& run, const std::string& folder,
                         const std::vector<MeshLabels>& labels) {
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const std::string path = result_files::path_of(
                result_files::parts, folder, run.collection.meshes[at(run.collection.local[k].mesh)].name);
            if (read_labels(path) != labels[k].part)
                throw Error(
                    ExitCode::input,
                    path +
                        ": is not what this coseg makes of the mesh and the options of the run; one of "
                        "them has changed since, so run coseg run again");
        }
    });
}

View view_of(const Comm& comm, const BasePartition& run) {
    std::vector<DrawnShape> drawn;
    agree(comm, [&] {
        for (const MeshDescription& mesh : run.collection.local)
            drawn.push_back(
                {mesh.mesh, "", picture_mesh(mesh.input, std::vector<Color>(at(mesh.input.face_count())))});
    });
    return agree_on_view(comm, drawn, run.options.output.view);
}

/// What one session at a time holds. Throws Error(output) where another one has it, or nothing can be
/// written.
std::unique_ptr<StateLock> session_lock(const std::string& run) {
    try {
        return std::make_unique<StateLock>(run + "/" + session_lock_name, LockMode::exclusive);
    } catch (const LockHeld& held) {
        throw Error(held.code(), "another coseg edit works on '" + run + "'" +
                                     (held.holder.empty() ? std::string() : " (" + held.holder + ")") +
                                     "; use its page, or end it first");
    } catch (const LockUnwritable& refused) {
        throw Error(refused.code(),
                    "'" + run + "' cannot be written (" + refused.cause +
                        "), so nothing that you say could be kept; make it writable or copy it");
    }
}

void serve(const Comm& comm, EditSession& session, const BasePartition& run, const EditOptions& options,
           const View& view) {
    EditPage page{"", options.run};
    std::optional<LocalServer> server;
    agree(comm, [&] {
        if (!comm.is_root()) return;
        page.html = edit_page("coseg edit: " + std::filesystem::path(options.run).filename().string(), view);
        server.emplace(options.port);
    });
    if (comm.is_root()) {
        std::cout << server->address() << std::endl;
        if (!options.quiet)
            std::cerr << "coseg: open this address in a browser on this machine; what you say is kept in "
                      << options.run << "/" << result_files::corrections << std::endl;
    }
    EditDesk(comm, run.base(), session, std::move(page)).serve(comm.is_root() ? &*server : nullptr);
}

void edit(const Invocation& invocation, const EditOptions& options) {
    const Comm& comm = invocation.world;
    const FinishedRun finished = read_run(comm, options.run);
    RunOptions run_options;
    std::vector<MeshEntry> entries;
    std::unique_ptr<StateLock> lock;
    agree(comm, [&] {
        run_options = options_of(finished, options);
        refuse_uncorrectable(finished, run_options);
        if (comm.is_root()) entries = entries_of(finished, options.meshes);
        if (comm.is_root()) lock = session_lock(options.run);
    });
    broadcast(comm, entries);
    StageLog log(comm, run_options.process.verbosity(), run_options.process.log_form());
    const CheckedPetsc petsc(comm, invocation.petsc_arguments);
    const BasePartition run = base_partition(comm, entries, run_options, invocation.petsc_arguments, log);
    if (!invocation.petsc_arguments.empty()) CheckedPetsc::refuse_unused(comm);
    const std::vector<MeshLabels> labels =
        label_faces(comm, run.collection, run.cut, {run.options.partition.parts, run.options.output.refine},
                    log, run.examples.faces);
    refuse_other_meshes(comm, run, options.run, labels);
    if (!is_corrected(finished)) refuse_other_labels(comm, run, options.run, labels);
    std::unique_ptr<CorrectedParts> parts =
        corrected_parts_of(comm, run.base(), run.solved(), run.options.partition);
    EditSession session(comm, run.base(), std::move(parts), run.options.output.refine,
                        options.run + "/" + result_files::corrections);
    serve(comm, session, run, options, view_of(comm, run));
}

}  // namespace

Command add_edit_command(CLI::App& parent) {
    const auto options = std::make_shared<EditOptions>();
    CLI::App* app = parent.add_subcommand("edit", "Correct a finished run in a page, on this machine");
    app->add_option("RUN", options->run, "The folder that coseg run was given with --out")->required();
    app->add_option("--state", options->state,
                    "Folder that keeps what the run has computed, if not the one that the run was given")
        ->type_name("DIR");
    app->add_option("--meshes", options->meshes,
                    "Where the meshes are now, if not where the run found them: files, folders or @LIST")
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--port", options->port, "Port of 127.0.0.1 to serve on; 0: any that is free")
        ->check(CLI::Range(0, 65535))
        ->transform(decimal_digits)
        ->capture_default_str();
    add_ranks_option(*app);
    app->add_flag("--quiet", options->quiet, "No progress lines; the address, warnings and errors only");
    app->footer(
        "It serves 127.0.0.1 alone. A run with --state opens in seconds; one without is computed again. "
        "Levels "
        "and splits need a run with --levels.\nExample: coseg run --parts 4 --levels --state kept --out "
        "result "
        "chairs/; coseg edit result");
    return {app, [options](const Invocation& invocation) { edit(invocation, *options); }};
}

}  // namespace coseg
