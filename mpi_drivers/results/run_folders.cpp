#include "mpi_drivers/results/run_folders.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "io/data_files/result_files.hpp"
#include "io/folders/absolute_folder.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/base/error.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// One folder cannot be both, and one that may hold nothing cannot hold the state either.
void refuse_state_in_results(const OutputOptions& output, const ProcessOptions& process) {
    namespace fs = std::filesystem;
    if (output.folder.empty()) return;
    std::error_code ignored;
    const fs::path results = absolute_folder(output.folder, ignored);
    const fs::path state = absolute_folder(process.state, ignored);
    if (results == state)
        throw Error(ExitCode::usage, "--out and --state name the same folder '" + output.folder +
                                         "'; name a folder elsewhere for one of them");
    if (output.force) return;
    if (std::mismatch(results.begin(), results.end(), state.begin(), state.end()).first == results.end())
        throw Error(ExitCode::usage, "--state " + process.state + " lies in the output folder " +
                                         output.folder + ", which must be empty; name a folder elsewhere");
}

std::optional<RunState> opened_state(const Comm& comm, const OutputOptions& output,
                                     const ProcessOptions& process) {
    if (process.state.empty()) return std::nullopt;
    agree(comm, [&] { refuse_state_in_results(output, process); });
    return std::optional<RunState>(std::in_place, comm, process.state, LockMode::exclusive,
                                   process.checkpoint_seconds);
}

std::vector<std::string> folders_of_meshes() {
    std::vector<std::string> folders{result_files::levels};
    for (const MeshResult& result : result_files::of_meshes) folders.emplace_back(result.folder);
    return folders;
}

/// Throws Error(output) where the folder, in which `what` lies, is one whose files the results replace.
void refuse_replaced_folder(const std::filesystem::path& folder, const std::string& what,
                            const std::string& out) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path results = fs::weakly_canonical(fs::absolute(out), ignored);
    for (const std::string& own : folders_of_meshes()) {
        if (!fs::equivalent(folder, results / own, ignored)) continue;
        throw Error(ExitCode::output, what + ": lies in the folder " + own +
                                          "/ of the results, which the run replaces; name another --out");
    }
}

void refuse_input_in_results(const std::vector<MeshEntry>& entries, const std::string& out) {
    std::set<std::filesystem::path> seen;  // a collection has far fewer folders than meshes
    for (const MeshEntry& entry : entries) {
        if (entry.polygons != nullptr) continue;
        const std::filesystem::path parent = std::filesystem::absolute(entry.path).parent_path();
        if (seen.insert(parent).second) refuse_replaced_folder(parent, entry.path, out);
    }
}

}  // namespace

ResultFolder::ResultFolder(const Comm& comm, const std::string& path, bool force, bool watched) {
    agree(comm, [&] {
        if (!comm.is_root()) return;
        const TerminationPause pause;
        on_root_.emplace(path, force);
        if (watched) watch_.emplace([this] { on_root_->abandon(); });
    });
    if (comm.is_root()) staging_ = on_root_->staging();
    broadcast(comm, staging_);
}

void ResultFolder::try_results_of(const Comm& comm, const std::vector<MeshEntry>& entries) const {
    agree(comm, [&] {
        if (!comm.is_root()) return;
        std::vector<std::string> names;
        std::uintmax_t bytes = 0;
        for (const MeshEntry& entry : entries) {
            names.push_back(entry.name);
            bytes += entry.bytes;
        }
        on_root_->try_names(names, bytes);
    });
}

void ResultFolder::commit(const Comm& comm) {
    agree(comm, [&] {
        if (comm.is_root()) on_root_->commit();
    });
}

RunFolders::RunFolders(const Comm& comm, const OutputOptions& output, const ProcessOptions& process)
    : state_(opened_state(comm, output, process)), results_path_(output.folder) {
    if (!output.folder.empty()) results_.emplace(comm, output.folder, output.force, process.watches_signals);
}

void RunFolders::end_if_asked(const Comm& comm, const std::string& kept) const {
    if (state_) state_->end_if_asked(comm, kept);
}

std::vector<MeshEntry> RunFolders::meshes_outside(const Comm& comm, const std::vector<MeshEntry>* given,
                                                  const std::vector<std::string>& inputs) const {
    std::vector<MeshEntry> entries = given != nullptr ? *given : list_meshes(comm, inputs);
    if (!results_) return entries;
    agree(comm, [&] {
        if (comm.is_root()) refuse_input_in_results(entries, results_path_);
    });
    results_->try_results_of(comm, entries);
    return entries;
}

void RunFolders::keep_apart(const Comm& comm, const std::string& examples) const {
    agree(comm, [&] {
        if (comm.is_root() && results_ && !examples.empty())
            refuse_replaced_folder(examples, "--examples " + examples, results_path_);
    });
}

void RunFolders::commit(const Comm& comm) {
    if (results_) results_->commit(comm);
}

}  // namespace coseg
