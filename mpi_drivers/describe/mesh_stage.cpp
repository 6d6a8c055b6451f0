#include "mpi_drivers/describe/mesh_stage.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mpi_drivers/describe/collection_log.hpp"
#include "mpi_drivers/describe/kept_description.hpp"
#include "mpi_drivers/process/self_launch.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/parallel/shared_counter.hpp"

namespace coseg {

namespace {

/// A mesh that could not be described.
struct Failure {
    int entry = 0;
    ExitCode code = ExitCode::input;
    std::string sentence;
    /// Whether it is for the machine's sake and not for the mesh's: without memory or a state folder that can
    /// be written, the other meshes would fare alike, and which of them do would depend on the ranks.
    bool of_machine = false;
    static constexpr auto fields() {
        return std::tuple(field("entry", &Failure::entry), field("code", &Failure::code),
                          field("sentence", &Failure::sentence), field("of_machine", &Failure::of_machine));
    }
};

struct Attempt {
    std::vector<DescribedMesh> described;  ///< numbered by entry
    std::vector<Failure> failed;
};

/// Large meshes first, so that no rank is left alone with one at the end.
std::vector<int> schedule(const std::vector<MeshEntry>& entries) {
    std::vector<int> order(entries.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return entries[at(a)].bytes > entries[at(b)].bytes; });
    return order;
}

/// False where the other meshes need not be tried.
bool attempt_one(Attempt& attempt, int number, const MeshEntry& entry, const DescriptionOptions& options,
                 const StateFolder* folder) {
    try {
        attempt.described.push_back(kept_description(number, entry, options, folder));
    } catch (const Error& error) {
        attempt.failed.push_back({number, error.code(), error.what(), error.code() == ExitCode::output});
    } catch (const std::bad_alloc&) {
        attempt.failed.push_back(
            {number, ExitCode::internal,
             entry.path + ": out of memory; use more nodes, fewer ranks on each, or a coarser mesh", true});
    } catch (const std::exception& error) {
        attempt.failed.push_back({number, ExitCode::internal, entry.path + ": " + error.what()});
    }
    return attempt.failed.empty() || !attempt.failed.back().of_machine;
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
                              const DescriptionOptions& options, const RunState* state, Keep keep,
                              StageLog& log) {
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
        const bool goes_on = attempt_one(attempt, number, entry, options, folder);
        trace_mesh(attempt, number, entry, start, log);
        if (goes_on && keep == Keep::nothing && !attempt.described.empty())
            attempt.described.back() = without_content(std::move(attempt.described.back()));
        if (!goes_on || (state != nullptr && state->stop_is_raised())) counter.exhaust();
    }
    log.end_of_own_work();
    log_steps(attempt, options, log);
    std::sort(attempt.described.begin(), attempt.described.end(),
              [](const DescribedMesh& a, const DescribedMesh& b) { return a.mesh.mesh < b.mesh.mesh; });
    return attempt;
}

/// Failures of all ranks, by entry, on all ranks.
std::vector<Failure> gather_failures(const Comm& comm, const Attempt& attempt) {
    std::vector<Failure> failures = all_gather_records(comm, attempt.failed);
    std::sort(failures.begin(), failures.end(),
              [](const Failure& a, const Failure& b) { return a.entry < b.entry; });
    return failures;
}

void end_if_of_machine(const std::vector<Failure>& failures) {
    for (const Failure& failure : failures) {
        if (failure.of_machine) throw AgreedError(failure.code, failure.sentence);
    }
}

/// Ends the run if a rank has been asked to.
void end_if_asked(const Comm& comm, const RunState& state, const Attempt& attempt, std::size_t entries) {
    const auto described = all_sum(comm, static_cast<std::int64_t>(attempt.described.size()));
    state.end_if_asked(comm, std::to_string(described) + " of " + std::to_string(entries) + " meshes");
}

void refuse_if_unusable(const std::vector<Failure>& failures, std::size_t entries, bool strict) {
    if (failures.empty()) return;
    const Failure& first = failures.front();
    if (strict) throw AgreedError(first.code, first.sentence);
    if (failures.size() < entries) return;
    const std::string rest =
        entries > 1 ? " (and no other of the " + std::to_string(entries) + " meshes can be used)" : "";
    throw AgreedError(first.code, first.sentence + rest);
}

/// Renumbers the usable meshes of this rank: an entry's number less the unusable entries before it.
void renumber(std::vector<DescribedMesh>& described, const std::vector<Failure>& failures) {
    auto failure = failures.begin();  // both ascend
    for (DescribedMesh& one : described) {
        while (failure != failures.end() && failure->entry < one.mesh.mesh) ++failure;
        one.mesh.mesh -= static_cast<int>(failure - failures.begin());
    }
}

/// What the rank that describes a mesh tells the others.
struct ToldMesh {
    int mesh = 0;
    MeshFacts facts;
    std::vector<int> patch_counts;  ///< per over-segmentation
    static constexpr auto fields() {
        return std::tuple(field("mesh", &ToldMesh::mesh), field("facts", &ToldMesh::facts),
                          field("patch_counts", &ToldMesh::patch_counts));
    }
};

ToldMesh told(const MeshDescription& description, const MeshFacts& named, int rank) {
    ToldMesh mesh{description.mesh, named, description.patch_counts};
    mesh.facts.owner = rank;
    mesh.facts.input_faces = description.input.face_count();
    mesh.facts.working_faces = description.graph.face_count;
    mesh.facts.remeshed = description.remeshed;
    mesh.facts.overlong_area = description.overlong_area;
    mesh.facts.seconds = description.seconds;
    mesh.facts.reused = description.reused;
    mesh.facts.warnings = description.warnings;
    return mesh;
}

/// Completes the facts of all meshes, whose names are known, and numbers their patches. Collective.
void share_facts(const Comm& comm, Collection& collection, int oversegmentations) {
    std::vector<ToldMesh> local;
    for (const MeshDescription& description : collection.local)
        local.push_back(told(description, collection.meshes[at(description.mesh)], comm.rank()));
    std::vector<int> counts(collection.meshes.size() * at(oversegmentations));
    for (ToldMesh& mesh : all_gather_records(comm, local)) {
        collection.meshes[at(mesh.mesh)] = std::move(mesh.facts);
        std::copy(mesh.patch_counts.begin(), mesh.patch_counts.end(),
                  counts.begin() + std::ptrdiff_t{mesh.mesh} * oversegmentations);
    }
    collection.numbering = {oversegmentations, counts};
}

}  // namespace

std::vector<MeshEntry> list_meshes(const Comm& comm, const std::vector<std::string>& inputs) {
    std::vector<MeshEntry> entries;
    agree(comm, [&] {
        if (!comm.is_root()) return;
        std::vector<std::string> reachable;
        std::transform(inputs.begin(), inputs.end(), std::back_inserter(reachable), reachable_list);
        entries = expand_mesh_list(reachable);
    });
    broadcast(comm, entries);
    return entries;
}

DescribeTotals describe_into_state(const Comm& comm, const std::vector<MeshEntry>& entries,
                                   const DescriptionOptions& options, bool strict, const RunState& state,
                                   StageLog& log) {
    const Attempt attempt = describe_dealt_meshes(comm, entries, options, &state, Keep::nothing, log);
    const std::vector<Failure> failures = gather_failures(comm, attempt);
    end_if_of_machine(failures);
    end_if_asked(comm, state, attempt, entries.size());
    if (!failures.empty()) refuse_if_unusable(failures, entries.size(), strict);
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
    totals.warnings = all_gather_records(comm, warnings);
    for (const Failure& failure : failures)
        totals.set_aside.push_back({entries[at(failure.entry)].path, failure.sentence});
    return totals;
}

namespace {

/// Moves what cannot be used out of `entries`.
void set_aside(std::vector<MeshEntry>& entries, const std::vector<Failure>& failures,
               std::vector<SetAside>& aside) {
    std::vector<MeshEntry> usable;
    auto failure = failures.begin();  // both ascend
    for (std::size_t k = 0; k < entries.size(); ++k) {
        if (failure != failures.end() && failure->entry == static_cast<int>(k)) {
            aside.push_back({entries[k].path, failure->sentence});
            ++failure;
        } else {
            usable.push_back(std::move(entries[k]));
        }
    }
    entries = std::move(usable);
}

struct UsableMeshes {
    std::vector<MeshEntry> entries;
    std::vector<SetAside> set_aside;
    std::vector<DescribedMesh> described;  ///< of this rank, numbered by `entries`
    int oversegmentations = 0;
};

/// Describes the meshes, and again those that can be used where, being fewer, they get more
/// over-segmentations: a collection has the labels that it has without its unusable meshes.
UsableMeshes describe_usable(const Comm& comm, const std::vector<MeshEntry>& entries,
                             const DescriptionOptions& options, bool strict, const RunState* state,
                             StageLog& log) {
    UsableMeshes usable{.entries = entries, .set_aside = {}, .described = {}};
    for (;;) {
        const DescriptionOptions counted = with_oversegmentations(options, usable.entries.size());
        Attempt attempt = describe_dealt_meshes(comm, usable.entries, counted, state, Keep::all, log);
        const std::vector<Failure> failures = gather_failures(comm, attempt);
        end_if_of_machine(failures);
        if (state != nullptr) end_if_asked(comm, *state, attempt, usable.entries.size());
        refuse_if_unusable(failures, usable.entries.size(), strict);
        set_aside(usable.entries, failures, usable.set_aside);
        renumber(attempt.described, failures);
        usable.described = std::move(attempt.described);
        usable.oversegmentations = counted.oversegmentations;
        const auto wanted = with_oversegmentations(options, usable.entries.size()).oversegmentations;
        if (wanted == counted.oversegmentations) return usable;
    }
}

}  // namespace

DescribedCollection describe_collection(const Comm& comm, const std::vector<MeshEntry>& entries,
                                        const DescriptionOptions& options, bool strict, const RunState* state,
                                        StageLog& log) {
    log.begin("describe");
    UsableMeshes usable = describe_usable(comm, entries, options, strict, state, log);
    DescribedCollection result;
    Collection& collection = result.collection;
    for (DescribedMesh& described : usable.described) {
        collection.local.push_back(std::move(described.mesh));
        result.descriptors.of_mesh.push_back(std::move(described.descriptors));
    }
    for (const MeshEntry& entry : usable.entries) {
        MeshFacts mesh;
        mesh.name = entry.name;
        mesh.path = entry.path;
        collection.meshes.push_back(std::move(mesh));
    }
    collection.set_aside = std::move(usable.set_aside);
    share_facts(comm, collection, usable.oversegmentations);
    result.descriptors.table = descriptor_table();
    log.end(described_summary(collection));
    warn_of_meshes(collection, log);
    return result;
}

}  // namespace coseg
