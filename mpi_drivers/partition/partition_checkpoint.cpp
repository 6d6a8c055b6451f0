#include "mpi_drivers/partition/partition_checkpoint.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "io/files/content_hash.hpp"
#include "io/files/hdf5_file.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"

namespace coseg {

namespace {

constexpr const char* cut_format = "coseg cut";
constexpr int cut_version = 4;

/// These change where things are, what is said or what is drawn.
constexpr std::array<const char*, 19> without_effect{
    "profile", "keep-model",  "out",           "state",        "checkpoint-seconds",
    "config",  "force",       "quiet",         "verbose",      "json-log",
    "sheet",   "html",        "view",          "up",           "refine",
    "strict",  "max-seconds", "keep-features", "face-features"};

/// The hashes of this rank's pieces, gathered in the global order of the pieces.
ContentHash hash_of_pieces(const Comm& comm, const std::vector<ContentHash>& pieces_local) {
    std::vector<std::int64_t> words;
    for (const ContentHash& piece : pieces_local) {
        words.push_back(static_cast<std::int64_t>(piece.high));
        words.push_back(static_cast<std::int64_t>(piece.low));
    }
    words = all_gather(comm, std::span<const std::int64_t>(words));
    ContentHasher hasher;
    hasher.add(std::span<const std::int64_t>(words));
    return hasher.result();
}

/// Tile by tile, as columns are owned.
ContentHash hash_of_coefficients(const Comm& comm, const SparseCoefficients& w) {
    std::vector<ContentHash> tiles;
    const auto columns = static_cast<std::int64_t>(w.offsets.size()) - 1;
    for (std::int64_t begin = 0; begin < columns; begin += coefficient_tile) {
        const auto from = static_cast<std::size_t>(begin);
        const auto to = static_cast<std::size_t>(std::min(begin + coefficient_tile, columns));
        ContentHasher hasher;
        for (std::size_t c = from; c < to; ++c) hasher.add(w.offsets[c + 1] - w.offsets[c]);
        const auto first = static_cast<std::size_t>(w.offsets[from]);
        const auto count = static_cast<std::size_t>(w.offsets[to]) - first;
        const auto features = static_cast<std::size_t>(w.features);
        hasher.add(std::span<const int>(w.rows).subspan(first, count));
        hasher.add(std::span<const double>(w.values).subspan(first * features, count * features));
        tiles.push_back(hasher.result());
    }
    return hash_of_pieces(comm, tiles);
}

ContentHash hash_of_relations(const MeshDescription& mesh) {
    ContentHasher hasher;
    for (const std::vector<PatchNeighbors>& neighbors : mesh.neighbors) {
        hasher.add(static_cast<std::uint64_t>(neighbors.size()));
        for (const PatchNeighbors& n : neighbors) {
            hasher.add(n.patch_a);
            hasher.add(n.patch_b);
            hasher.add(n.boundary_length);
            hasher.add(n.concavity);
        }
    }
    for (const OverlapsOfPair& pair : mesh.overlaps) {
        hasher.add(pair.oversegmentation_a);
        hasher.add(pair.oversegmentation_b);
        hasher.add(static_cast<std::uint64_t>(pair.overlaps.size()));
        for (const PatchOverlap& o : pair.overlaps) {
            hasher.add(o.patch_a);
            hasher.add(o.patch_b);
            hasher.add(o.intersection_over_union);
        }
    }
    return hasher.result();
}

/// Mesh by mesh, whoever holds it.
ContentHash hash_of_relations(const Comm& comm, const Collection& collection) {
    std::vector<std::int64_t> words;
    for (const MeshDescription& mesh : collection.local) {
        const ContentHash hash = hash_of_relations(mesh);
        words.insert(words.end(),
                     {mesh.mesh, static_cast<std::int64_t>(hash.high), static_cast<std::int64_t>(hash.low)});
    }
    words = all_gather(comm, std::span<const std::int64_t>(words));
    std::vector<std::array<std::int64_t, 3>> rows;
    for (std::size_t k = 0; k + 2 < words.size(); k += 3)
        rows.push_back({words[k], words[k + 1], words[k + 2]});
    std::sort(rows.begin(), rows.end());
    ContentHasher hasher;
    for (const auto& row : rows) hasher.add(std::span<const std::int64_t>(row));
    return hasher.result();
}

ContentHash cut_key(const Comm& comm, const PartitionInput& input, const std::string& options) {
    const auto& [collection, features, coefficients, choice] = input;
    ContentHasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(std::int64_t{cut_version});
    hasher.add(options);
    hasher.add(hash_of_coefficients(comm, coefficients).hex());
    hasher.add(hash_of_relations(comm, collection).hex());
    const std::vector<int> mesh_of = collection.numbering.mesh_of();
    hasher.add(std::span<const int>(mesh_of));
    hasher.add(std::span<const double>(features.patch_area));
    hasher.add(std::span<const double>(features.positions.data(),
                                       static_cast<std::size_t>(features.positions.size())));
    for (const ChoiceDescriptor& d : choice) {
        const auto entries = static_cast<std::size_t>(d.histograms.size());
        hasher.add(std::span<const float>(d.histograms.data(), entries));
    }
    return hasher.result();
}

constexpr std::size_t start_numbers = 8;
constexpr std::size_t start_counts = 8;

void write_starts(Hdf5Writer& file, const std::vector<StartOutcome>& starts) {
    std::vector<double> numbers;
    std::vector<std::int32_t> counts;
    std::vector<double> eigenvalues;
    std::vector<double> explained;
    for (const StartOutcome& outcome : starts) {
        // One name for each field: a new one does not compile until it has been thought of here.
        const auto& [start, terms, score, parts_found, set_aside, unreached, values] = outcome;
        const auto& [graph, clusters, merging] = start;
        const auto& [crease, overlap, shares, concavity, present, link_consistency] = terms;
        numbers.insert(numbers.end(), {graph.adjacency, graph.overlap, crease, overlap, concavity, present,
                                       link_consistency, score});
        counts.insert(counts.end(), {clusters, static_cast<int>(merging), parts_found, set_aside, unreached,
                                     static_cast<int>(values.size()), static_cast<int>(shares.size()),
                                     static_cast<int>(graph.placed)});
        eigenvalues.insert(eigenvalues.end(), values.begin(), values.end());
        for (const auto& [pooled, per_mesh] : shares) explained.insert(explained.end(), {pooled, per_mesh});
    }
    file.write("starts/numbers", numbers, {starts.size(), start_numbers});
    file.write("starts/counts", counts, {starts.size(), start_counts});
    file.write("starts/explained", explained);
    file.write("starts/eigenvalues", eigenvalues);
}

std::vector<StartOutcome> read_starts(const Hdf5Reader& file) {
    const auto numbers = file.read<double>("starts/numbers");
    const auto counts = file.read<std::int32_t>("starts/counts");
    const auto eigenvalues = file.read<double>("starts/eigenvalues");
    const auto explained = file.read<double>("starts/explained");
    std::vector<StartOutcome> starts(counts.size() / start_counts);
    auto value = eigenvalues.begin();
    auto share = explained.begin();
    for (std::size_t k = 0; k < starts.size(); ++k) {
        const double* n = numbers.data() + start_numbers * k;
        const std::int32_t* c = counts.data() + start_counts * k;
        std::vector<BetweenPartVariance> shares(static_cast<std::size_t>(c[6]));
        for (BetweenPartVariance& spread : shares) {
            spread.pooled = *share++;
            spread.per_mesh = *share++;
        }
        starts[k] = {.start = {{n[0], n[1], c[7] != 0}, c[0], static_cast<MergeRule>(c[1])},
                     .terms = {.crease = n[2],
                               .overlap = n[3],
                               .explained = std::move(shares),
                               .concavity = n[4],
                               .presence = n[5],
                               .link_consistency = n[6]},
                     .score = n[7],
                     .parts_found = c[2],
                     .set_aside = c[3],
                     .unreached = c[4],
                     .eigenvalues = {value, value + c[5]}};
        value += c[5];
    }
    return starts;
}

}  // namespace

std::string cut_option_text(const std::vector<std::pair<std::string, std::string>>& resolved,
                            const std::vector<std::string>& petsc_arguments) {
    std::string text;
    for (const auto& [name, value] : resolved) {
        if (std::find(without_effect.begin(), without_effect.end(), name) == without_effect.end())
            text += name + "=" + value + "\n";
    }
    for (const std::string& argument : petsc_arguments) text += argument + "\n";
    return text;
}

void write_cut(const std::string& path, const CutResult& cut) {
    const auto& [part_of_patch, part_share, meshes_with_part, starts, frame, chosen] = cut;
    Hdf5Writer file(path, cut_format, cut_version);
    file.attribute("source_fingerprint", source_fingerprint());
    file.attribute("chosen", std::int64_t{chosen});
    file.summary("cut, " + std::to_string(part_of_patch.size()) + " patches into " +
                 std::to_string(part_share.size()) + " parts, " + std::to_string(starts.size()) + " starts");
    file.write("part_of_patch", part_of_patch, {}, true);
    file.write("part_share", part_share);
    file.write("meshes_with_part", meshes_with_part);
    write_starts(file, starts);
    file.write_matrix("positions/mean", frame.mean);
    file.write_matrix("positions/directions", frame.directions);
    file.write_matrix("positions/correlation", frame.correlation);
    file.commit();
}

CutResult read_cut(const std::string& path) {
    const Hdf5Reader file(path, cut_format, cut_version);
    return {.part_of_patch = file.read<std::int32_t>("part_of_patch"),
            .part_share = file.read<double>("part_share"),
            .meshes_with_part = file.read<std::int32_t>("meshes_with_part"),
            .starts = read_starts(file),
            .frame = {file.read_matrix("positions/mean"), file.read_matrix("positions/directions"),
                      file.read_matrix("positions/correlation")},
            .chosen = static_cast<int>(file.integer("chosen"))};
}

CutResult PartitionCheckpoint::cut(const PartitionInput& input, const RunOptions& options) {
    // Clusters of descriptors take no longer than looking them up.
    if (options.partition == "diffusion") return cut_into_parts(comm_, input, options);
    const std::string file = state_.folder().cut_file(cut_key(comm_, input, options_));
    std::vector<std::string> damage;
    std::optional<CutResult> found;
    // Every rank reads, so that a file which one of them cannot read is given up by all.
    const bool is_there = every_rank(comm_, std::filesystem::exists(file));
    try {
        if (is_there) found = read_cut(file);
    } catch (const Error& error) {
        damage.emplace_back(error.what());
    }
    damage = all_gather_texts(comm_, damage);
    if (is_there && damage.empty()) {
        if (comm_.is_root()) mark_as_used(file);
        ++found_;
        return *std::move(found);
    }
    std::vector<std::string> aside(1);
    if (comm_.is_root() && !damage.empty()) aside = {state_.folder().set_aside(file)};
    broadcast_texts(comm_, aside);
    if (!damage.empty())
        warnings_.push_back(damage.front() + "; it is set aside as " + aside.front() +
                            " and the cut is made anew");
    state_.end_if_asked(comm_, "all meshes and the optimiser's tiles");
    CutResult cut = cut_into_parts(comm_, input, options);
    agree(comm_, [&] {
        if (!comm_.is_root()) return;
        make_parent_folders(file);
        write_cut(file, cut);
    });
    return cut;
}

CutResult cut_or_found(const Comm& comm, const PartitionInput& input, const RunOptions& options,
                       PartitionCheckpoint* checkpoint) {
    return checkpoint != nullptr ? checkpoint->cut(input, options) : cut_into_parts(comm, input, options);
}

}  // namespace coseg
