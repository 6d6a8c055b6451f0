#include "mpi_drivers/mesh_stage.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "src/error.hpp"
#include "src/shared_counter.hpp"

namespace coseg {

namespace {

struct Attempt {
    std::vector<MeshDescription> described;  ///< numbered by entry
    std::vector<std::pair<int, Error>> failed;
};

/// Large meshes first, so that no rank is left alone with one at the end.
std::vector<int> schedule(const std::vector<MeshEntry>& entries) {
    std::vector<int> order(entries.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return entries[static_cast<std::size_t>(a)].bytes > entries[static_cast<std::size_t>(b)].bytes;
    });
    return order;
}

void attempt_one(Attempt& attempt, int number, const MeshEntry& entry, const RunOptions& options) {
    try {
        attempt.described.push_back(describe_mesh(number, entry.name, entry.path, options));
    } catch (const Error& error) {
        attempt.failed.emplace_back(number, error);
    } catch (const std::bad_alloc&) {
        attempt.failed.emplace_back(
            number, Error(ExitCode::internal, entry.path + ": out of memory; use more nodes"));
    } catch (const std::exception& error) {
        attempt.failed.emplace_back(number, Error(ExitCode::internal, entry.path + ": " + error.what()));
    }
}

Attempt describe_dealt_meshes(const Comm& comm, const std::vector<MeshEntry>& entries,
                              const RunOptions& options, StageLog& log) {
    const std::vector<int> order = schedule(entries);
    const auto total = static_cast<std::int64_t>(entries.size());
    Attempt attempt;
    SharedCounter counter(comm);
    for (std::int64_t k = counter.next(); k < total; k = counter.next()) {
        log.progress(k, total);
        const int number = order[static_cast<std::size_t>(k)];
        attempt_one(attempt, number, entries[static_cast<std::size_t>(number)], options);
    }
    log.end_of_own_work();
    for (std::size_t s = 0; s < describe_step_names.size(); ++s) {
        double seconds = 0.0;
        for (const MeshDescription& mesh : attempt.described) seconds += mesh.step_seconds[s];
        log.step(describe_step_names[s], seconds);
    }
    std::sort(attempt.described.begin(), attempt.described.end(),
              [](const MeshDescription& a, const MeshDescription& b) { return a.mesh < b.mesh; });
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
void renumber(std::vector<MeshDescription>& described, const std::vector<std::pair<int, Error>>& failures) {
    for (MeshDescription& description : described) {
        const auto before = std::count_if(failures.begin(), failures.end(), [&](const auto& failure) {
            return failure.first < description.mesh;
        });
        description.mesh -= static_cast<int>(before);
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
            counts[static_cast<std::size_t>(description.mesh * oversegmentations + s)] =
                description.patch_counts[static_cast<std::size_t>(s)];
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
        collection.meshes[static_cast<std::size_t>(all_owners[k])].warnings.push_back(all_sentences[k]);
    }
}

void share_facts(const Comm& comm, Collection& collection) {
    constexpr std::size_t rows = 4;
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
    }
    share_warnings(comm, collection);
}

}  // namespace

Collection describe_collection(const Comm& comm, const std::vector<MeshEntry>& entries,
                               const RunOptions& options, StageLog& log) {
    Attempt attempt = describe_dealt_meshes(comm, entries, options, log);
    const std::vector<std::pair<int, Error>> failures = gather_failures(comm, attempt);
    refuse_if_unusable(failures, entries.size(), options.strict);

    Collection collection;
    renumber(attempt.described, failures);
    collection.local = std::move(attempt.described);
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
    return collection;
}

}  // namespace coseg
