#include "mpi_drivers/describe/mesh_stage.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <utility>

#include "mpi_drivers/describe/face_features.hpp"
#include "mpi_drivers/describe/kept_description.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/shared_counter.hpp"

namespace coseg {

namespace {

struct Attempt {
    std::vector<DescribedMesh> described;  ///< numbered by entry
    std::vector<std::pair<int, Error>> failed;
};

/// Large meshes first, so that no rank is left alone with one at the end.
std::vector<int> schedule(const std::vector<MeshEntry>& entries) {
    std::vector<int> order(entries.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return entries[at(a)].bytes > entries[at(b)].bytes; });
    return order;
}

/// False if the state folder cannot be written: the other meshes would fare alike.
bool attempt_one(Attempt& attempt, int number, const MeshEntry& entry, const DescriptionOptions& options,
                 const StateFolder* folder) {
    try {
        attempt.described.push_back(kept_description(number, entry, options, folder));
    } catch (const Error& error) {
        attempt.failed.emplace_back(number, error);
        return error.code() != ExitCode::output;
    } catch (const std::bad_alloc&) {
        attempt.failed.emplace_back(
            number, Error(ExitCode::internal, entry.path + ": out of memory; use more nodes"));
    } catch (const std::exception& error) {
        attempt.failed.emplace_back(number, Error(ExitCode::internal, entry.path + ": " + error.what()));
    }
    return true;
}

/// The mesh and its steps as spans of the stage; a mesh that failed has no steps.
void trace_mesh(const Attempt& attempt, int number, const MeshEntry& entry, StageLog::Clock::time_point start,
                StageLog& log) {
    if (!attempt.described.empty() && attempt.described.back().mesh.mesh == number) {
        for (const StepSpan& span : attempt.described.back().mesh.step_spans)
            log.span(span.step, "step", span.start, span.end);
    }
    log.span(entry.name, "mesh", start, StageLog::Clock::now());
}

enum class Keep { all, nothing };

/// What is told of a mesh whose description went into the state folder.
DescribedMesh without_content(DescribedMesh&& described) {
    MeshDescription& mesh = described.mesh;
    DescribedMesh bare;
    bare.mesh.mesh = mesh.mesh;
    bare.mesh.reused = mesh.reused;
    bare.mesh.warnings = std::move(mesh.warnings);
    bare.mesh.seconds = mesh.seconds;
    bare.mesh.step_spans = std::move(mesh.step_spans);
    return bare;
}

/// What this rank spent on each step of its meshes.
void log_steps(const Attempt& attempt, const DescriptionOptions& options, StageLog& log) {
    std::map<std::string, double> seconds;
    for (const DescribedMesh& described : attempt.described) {
        for (const StepSpan& span : described.mesh.step_spans)
            seconds[span.step] += std::chrono::duration<double>(span.end - span.start).count();
    }
    for (const std::string& step : describe_steps(options)) log.step(step, seconds[step]);
}

Attempt describe_dealt_meshes(const Comm& comm, const std::vector<MeshEntry>& entries,
                              const RunOptions& options, const RunState* state, Keep keep, StageLog& log) {
    const DescriptionOptions description = description_options(options);
    const StateFolder* folder = state != nullptr ? &state->folder() : nullptr;
    const std::vector<int> order = schedule(entries);
    const auto total = static_cast<std::int64_t>(entries.size());
    Attempt attempt;
    SharedCounter counter(comm);
    for (std::int64_t k = counter.next(); k < total; k = counter.next()) {
        log.progress(k, total);
        const int number = order[at(k)];
        const MeshEntry& entry = entries[at(number)];
        const StageLog::Clock::time_point start = StageLog::Clock::now();
        const bool goes_on = attempt_one(attempt, number, entry, description, folder);
        trace_mesh(attempt, number, entry, start, log);
        if (goes_on && keep == Keep::nothing && !attempt.described.empty())
            attempt.described.back() = without_content(std::move(attempt.described.back()));
        if (!goes_on || (state != nullptr && state->stop_is_raised())) counter.exhaust();
    }
    log.end_of_own_work();
    log_steps(attempt, description, log);
    std::sort(attempt.described.begin(), attempt.described.end(),
              [](const DescribedMesh& a, const DescribedMesh& b) { return a.mesh.mesh < b.mesh.mesh; });
    return attempt;
}

/// Failures of all ranks, by entry, on all ranks.
std::vector<std::pair<int, Error>> gather_failures(const Comm& comm, const Attempt& attempt) {
    std::vector<int> numbers;
    std::vector<std::string> sentences;
    for (const auto& [number, error] : attempt.failed) {
        numbers.push_back(number);
        numbers.push_back(static_cast<int>(error.code()));
        sentences.emplace_back(error.what());
    }
    const std::vector<int> all_numbers = all_gather(comm, std::span<const int>(numbers));
    const std::vector<std::string> all_sentences = all_gather_texts(comm, sentences);
    std::vector<std::pair<int, Error>> failures;
    for (std::size_t k = 0; k < all_sentences.size(); ++k) {
        failures.emplace_back(all_numbers[2 * k],
                              Error(static_cast<ExitCode>(all_numbers[2 * k + 1]), all_sentences[k]));
    }
    std::sort(failures.begin(), failures.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return failures;
}

void refuse_if_unwritable(const std::vector<std::pair<int, Error>>& failures) {
    for (const auto& [number, error] : failures) {
        if (error.code() == ExitCode::output) throw AgreedError(error.code(), error.what());
    }
}

/// Ends the run if a rank has been asked to.
void end_if_asked(const Comm& comm, const RunState& state, const Attempt& attempt, std::size_t entries) {
    const auto described = all_sum(comm, static_cast<std::int64_t>(attempt.described.size()));
    state.end_if_asked(comm, std::to_string(described) + " of " + std::to_string(entries) + " meshes");
}

void refuse_if_unusable(const std::vector<std::pair<int, Error>>& failures, std::size_t entries,
                        bool strict) {
    if (failures.empty()) return;
    const Error& first = failures.front().second;
    if (strict) throw AgreedError(first.code(), first.what());
    if (failures.size() < entries) return;
    const std::string rest =
        entries > 1 ? " (and no other of the " + std::to_string(entries) + " meshes can be used)" : "";
    throw AgreedError(first.code(), first.what() + rest);
}

/// Renumbers the usable meshes of this rank: an entry's number less the unusable entries before it.
void renumber(std::vector<DescribedMesh>& described, const std::vector<std::pair<int, Error>>& failures) {
    auto failure = failures.begin();  // both ascend
    for (DescribedMesh& one : described) {
        while (failure != failures.end() && failure->first < one.mesh.mesh) ++failure;
        one.mesh.mesh -= static_cast<int>(failure - failures.begin());
    }
}

/// Fills `values_global` (rows x meshes) with what each rank knows of its own meshes, zero elsewhere before.
std::vector<int> share_integers(const Comm& comm, std::vector<int> values_local) {
    std::vector<int> values_global(values_local.size());
    MPI_Allreduce(values_local.data(), values_global.data(), static_cast<int>(values_local.size()), MPI_INT,
                  MPI_SUM, comm.raw());
    return values_global;
}

PatchNumbering agree_on_numbering(const Comm& comm, const std::vector<MeshDescription>& local,
                                  std::size_t meshes, int oversegmentations) {
    std::vector<int> counts(meshes * static_cast<std::size_t>(oversegmentations), 0);
    for (const MeshDescription& description : local) {
        for (int s = 0; s < oversegmentations; ++s) {
            counts[at(description.mesh * oversegmentations + s)] = description.patch_counts[at(s)];
        }
    }
    return {oversegmentations, share_integers(comm, std::move(counts))};
}

void share_warnings(const Comm& comm, Collection& collection) {
    std::vector<int> owners;
    std::vector<std::string> sentences;
    for (const MeshDescription& description : collection.local) {
        for (const std::string& warning : description.warnings) {
            owners.push_back(description.mesh);
            sentences.push_back(warning);
        }
    }
    const std::vector<int> all_owners = all_gather(comm, std::span<const int>(owners));
    const std::vector<std::string> all_sentences = all_gather_texts(comm, sentences);
    for (std::size_t k = 0; k < all_sentences.size(); ++k) {
        collection.meshes[at(all_owners[k])].warnings.push_back(all_sentences[k]);
    }
}

void share_facts(const Comm& comm, Collection& collection) {
    constexpr std::size_t rows = 5;
    const std::size_t meshes = collection.meshes.size();
    std::vector<int> facts(rows * meshes, 0);
    std::vector<double> measures(2 * meshes, 0.0);
    for (const MeshDescription& description : collection.local) {
        const auto m = static_cast<std::size_t>(description.mesh);
        facts[rows * m] = comm.rank();
        facts[rows * m + 1] = description.input.face_count();
        facts[rows * m + 2] = description.graph.face_count;
        facts[rows * m + 3] = description.remeshed ? 1 : 0;
        measures[2 * m] = description.seconds;
        measures[2 * m + 1] = description.overlong_area;
        facts[rows * m + 4] = description.reused ? 1 : 0;
    }
    facts = share_integers(comm, std::move(facts));
    MPI_Allreduce(MPI_IN_PLACE, measures.data(), static_cast<int>(measures.size()), MPI_DOUBLE, MPI_SUM,
                  comm.raw());
    for (std::size_t m = 0; m < meshes; ++m) {
        MeshFacts& mesh = collection.meshes[m];
        mesh.owner = facts[rows * m];
        mesh.input_faces = facts[rows * m + 1];
        mesh.working_faces = facts[rows * m + 2];
        mesh.remeshed = facts[rows * m + 3] != 0;
        mesh.seconds = measures[2 * m];
        mesh.overlong_area = measures[2 * m + 1];
        mesh.reused = facts[rows * m + 4] != 0;
    }
    share_warnings(comm, collection);
}

}  // namespace

namespace {

std::vector<Descriptor> weighted_table(const RunOptions& options) {
    std::vector<Descriptor> table = descriptor_table();
    for (std::size_t row = 0; row < table.size(); ++row) table[row].weight = options.feature_weights.at(row);
    return table;
}

}  // namespace

std::vector<MeshEntry> list_meshes(const Comm& comm, const std::vector<std::string>& inputs) {
    std::vector<MeshEntry> entries;
    agree(comm, [&] {
        if (comm.is_root()) entries = expand_mesh_list(inputs);
    });
    std::vector<std::string> names;
    std::vector<std::string> paths;
    std::vector<std::string> sizes;
    for (const MeshEntry& entry : entries) {
        names.push_back(entry.name);
        paths.push_back(entry.path);
        sizes.push_back(std::to_string(entry.bytes));
    }
    broadcast_texts(comm, names);
    broadcast_texts(comm, paths);
    broadcast_texts(comm, sizes);
    entries.resize(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) entries[k] = {names[k], paths[k], std::stoull(sizes[k])};
    return entries;
}

DescribeTotals describe_into_state(const Comm& comm, const std::vector<MeshEntry>& entries,
                                   const RunOptions& options, const RunState& state, StageLog& log) {
    const Attempt attempt = describe_dealt_meshes(comm, entries, options, &state, Keep::nothing, log);
    const std::vector<std::pair<int, Error>> failures = gather_failures(comm, attempt);
    refuse_if_unwritable(failures);
    end_if_asked(comm, state, attempt, entries.size());
    if (!failures.empty()) refuse_if_unusable(failures, entries.size(), options.strict);
    DescribeTotals totals;
    std::vector<std::string> warnings;
    std::int64_t reused = 0;
    for (const DescribedMesh& described : attempt.described) {
        const MeshDescription& mesh = described.mesh;
        warnings.insert(warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
        if (mesh.reused) ++reused;
    }
    totals.reused = all_sum(comm, reused);
    totals.described = all_sum(comm, static_cast<std::int64_t>(attempt.described.size())) - totals.reused;
    totals.warnings = all_gather_texts(comm, warnings);
    for (const auto& [number, error] : failures)
        totals.set_aside.push_back({entries[at(number)].path, error.what()});
    return totals;
}

DescribedCollection describe_collection(const Comm& comm, const std::vector<MeshEntry>& entries,
                                        const RunOptions& options, const RunState* state, StageLog& log) {
    Attempt attempt = describe_dealt_meshes(comm, entries, options, state, Keep::all, log);
    const std::vector<std::pair<int, Error>> failures = gather_failures(comm, attempt);
    refuse_if_unwritable(failures);
    if (state != nullptr) end_if_asked(comm, *state, attempt, entries.size());
    refuse_if_unusable(failures, entries.size(), options.strict);

    DescribedCollection result;
    Collection& collection = result.collection;
    renumber(attempt.described, failures);
    for (DescribedMesh& described : attempt.described) {
        collection.local.push_back(std::move(described.mesh));
        result.descriptors.of_mesh.push_back(std::move(described.descriptors));
    }
    auto failure = failures.begin();
    for (std::size_t k = 0; k < entries.size(); ++k) {
        if (failure != failures.end() && failure->first == static_cast<int>(k)) {
            collection.set_aside.push_back({entries[k].path, failure->second.what()});
            ++failure;
        } else {
            MeshFacts mesh;
            mesh.name = entries[k].name;
            mesh.path = entries[k].path;
            collection.meshes.push_back(std::move(mesh));
        }
    }
    collection.numbering =
        agree_on_numbering(comm, collection.local, collection.meshes.size(), options.oversegmentations);
    share_facts(comm, collection);
    result.descriptors.table = weighted_table(options);
    if (!options.face_features.empty()) add_face_features(comm, result, options);
    return result;
}

}  // namespace coseg
