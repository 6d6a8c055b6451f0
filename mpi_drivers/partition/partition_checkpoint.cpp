#include "mpi_drivers/partition/partition_checkpoint.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "io/files/record_file.hpp"
#include "io/files/record_hash.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

constexpr const char* cut_format = "coseg cut";
constexpr int cut_version = 12;

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
    ContentHasher hasher;  // ranks own the tiles in their global order
    add_value(hasher, all_gather_records(comm, tiles));
    return hasher.result();
}

struct HashOfMesh {
    int mesh = 0;
    ContentHash hash;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &HashOfMesh::mesh), field("hash", &HashOfMesh::hash));
    }
};

/// Mesh by mesh, whoever holds it.
ContentHash hash_of_relations(const Comm& comm, const Collection& collection) {
    std::vector<HashOfMesh> meshes;
    for (const MeshDescription& mesh : collection.local) {
        ContentHasher hasher;
        add_value(hasher, mesh.neighbors);
        add_value(hasher, mesh.overlaps);
        meshes.push_back({mesh.mesh, hasher.result()});
    }
    meshes = all_gather_records(comm, meshes);
    std::sort(meshes.begin(), meshes.end(),
              [](const HashOfMesh& a, const HashOfMesh& b) { return a.mesh < b.mesh; });
    ContentHasher hasher;
    add_value(hasher, meshes);
    return hasher.result();
}

ContentHash cut_key(const Comm& comm, const PartitionInput& input, const std::string& options) {
    ContentHasher hasher;
    hasher.add(source_fingerprint(KeptPiece::cuts));
    hasher.add(std::int64_t{cut_version});
    hasher.add(options);
    hasher.add(hash_of_coefficients(comm, input.coefficients).hex());
    hasher.add(hash_of_relations(comm, input.collection).hex());
    const std::vector<int> mesh_of = input.collection.numbering.mesh_of();
    hasher.add(std::span<const int>(mesh_of));
    add_value(hasher, input.patch_area);
    add_value(hasher, input.positions);
    for (const ChoiceDescriptor& d : input.choice()) {
        for (Eigen::Index i = 0; i < d.histograms.cols(); ++i)
            hasher.add(std::span<const float>(d.histograms.col(i).data(), at(d.histograms.rows())));
    }
    if (input.examples != nullptr) add_value(hasher, input.examples->area);
    return hasher.result();
}

/// The text of options as it would be if the number of parts had been given.
std::string with_given_parts(std::string options, int parts) {
    const std::string counted = "parts=auto\n";
    const std::size_t place = options.find(counted);
    if (place != std::string::npos)
        options.replace(place, counted.size(), "parts=" + std::to_string(parts) + "\n");
    return options;
}

}  // namespace

std::string cut_option_text(const std::vector<OptionValue>& options,
                            const std::vector<std::string>& petsc_arguments) {
    std::string text = option_text(options, Affects::cut);
    for (const std::string& argument : petsc_arguments) text += argument + "\n";
    return text;
}

void write_cut(const std::string& path, const CutResult& cut) {
    Hdf5Writer file(path, cut_format, cut_version);
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::cuts));
    file.summary("cut, " + std::to_string(cut.part_of_patch.size()) + " patches into " +
                 std::to_string(cut.part_share.size()) + " parts, " + std::to_string(cut.starts.size()) +
                 " starts");
    write_record(file, "", cut);
    file.commit();
}

CutResult read_cut(const std::string& path) {
    CutResult cut;
    read_record(Hdf5Reader(path, cut_format, cut_version), "", cut);
    return cut;
}

CutResult PartitionCheckpoint::cut(const PartitionInput& input, const PartitionOptions& options) {
    // Clusters of descriptors take no longer than looking them up.
    if (options.method == PartitionMethod::diffusion) return cut_into_parts(comm_, input, options);
    const std::string file = state_.folder().cut_file(cut_key(comm_, input, options_));
    std::vector<std::string> damage;
    std::optional<CutResult> found;
    // Every rank reads, so that a file which one of them cannot read is given up by all.
    std::error_code ignored;  // what cannot be looked at cannot be read either
    const bool is_there = every_rank(comm_, std::filesystem::exists(file, ignored));
    try {
        if (is_there) found = read_cut(file);
    } catch (const Error& error) {
        damage.emplace_back(error.what());
    }
    damage = all_gather_records(comm_, damage);
    if (is_there && damage.empty()) {
        if (comm_.is_root()) mark_as_used(file);
        ++found_;
        return *std::move(found);
    }
    std::string aside;
    if (comm_.is_root() && !damage.empty()) aside = state_.folder().set_aside(file);
    broadcast(comm_, aside);
    if (!damage.empty())
        warnings_.push_back(damage.front() + "; it is set aside as " + aside + " and the cut is made anew");
    state_.end_if_asked(comm_, "all meshes and the optimiser's tiles");
    CutResult cut = cut_into_parts(comm_, input, options);
    keep(file, cut);
    if (!cut.part_counts.empty()) {
        CutResult given = cut;
        given.part_counts.clear();
        const std::string with_number = with_given_parts(options_, static_cast<int>(cut.part_share.size()));
        keep(state_.folder().cut_file(cut_key(comm_, input, with_number)), given);
    }
    return cut;
}

void PartitionCheckpoint::keep(const std::string& file, const CutResult& cut) const {
    agree(comm_, [&] {
        if (!comm_.is_root()) return;
        make_parent_folders(file);
        write_cut(file, cut);
    });
}

CutResult cut_or_found(const Comm& comm, const PartitionInput& input, const PartitionOptions& options,
                       PartitionCheckpoint* checkpoint) {
    return checkpoint != nullptr ? checkpoint->cut(input, options) : cut_into_parts(comm, input, options);
}

}  // namespace coseg
