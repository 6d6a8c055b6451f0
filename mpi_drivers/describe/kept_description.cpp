#include "mpi_drivers/describe/kept_description.hpp"

#include <chrono>
#include <filesystem>
#include <optional>

#include "io/files/content_hash.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "mpi_drivers/describe/description_file.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

using Clock = std::chrono::steady_clock;

void add_reading_time(MeshDescription& description, Clock::time_point start) {
    const Clock::time_point now = Clock::now();
    description.seconds += std::chrono::duration<double>(now - start).count();
    description.step_spans.push_back({"read", start, now});
}

/// Nothing if there is no file; a damaged one leaves a sentence in `warning`.
std::optional<DescribedMesh> found_description(const std::string& file, int mesh, const MeshEntry& entry,
                                               const StateFolder& folder, std::string& warning) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    try {
        DescribedMesh described = read_description(file, mesh, entry.name, entry.path);
        described.mesh.reused = true;
        mark_as_used(file);
        return described;
    } catch (const Error& error) {
        warning = std::string(error.what()) + "; it is set aside as " + folder.set_aside(file) + " and " +
                  entry.path + " is described anew";
        return std::nullopt;
    }
}

/// What tells the mesh from others: the bytes of its file, or a hash of its arrays.
std::string identity(const MeshEntry& entry) {
    if (entry.polygons == nullptr) return mesh_file_bytes(entry.path);
    ContentHasher hasher;
    hasher.add(entry.polygons->coordinates);
    hasher.add(entry.polygons->corners);
    hasher.add(entry.polygons->offsets);
    return hasher.result().hex();
}

PolygonMesh input_of(const MeshEntry& entry, std::string_view bytes) {
    if (entry.polygons != nullptr) return checked_polygons(*entry.polygons, entry.path).mesh;
    return parse_mesh(bytes, entry.path).mesh;
}

DescribedMesh described_anew(int mesh, const MeshEntry& entry, std::string_view bytes,
                             const DescriptionOptions& options) {
    if (entry.polygons != nullptr)
        return describe_polygons(mesh, entry.name, entry.path, *entry.polygons, options);
    return describe_mesh(mesh, entry.name, entry.path, bytes, options);
}

}  // namespace

DescribedMesh kept_description(int mesh, const MeshEntry& entry, const DescriptionOptions& options,
                               const StateFolder* folder) {
    const Clock::time_point start = Clock::now();
    const std::string bytes = identity(entry);
    if (folder == nullptr) return described_anew(mesh, entry, bytes, options);
    // Arrays have no suffix, so that they are not taken for a file whose bytes are their hash.
    const std::string place = entry.polygons != nullptr ? std::string() : entry.path;
    const std::string file = folder->mesh_file(description_key(bytes, entry.name, place, options));
    std::string warning;
    if (std::optional<DescribedMesh> found = found_description(file, mesh, entry, *folder, warning)) {
        found->mesh.input = input_of(entry, bytes);
        add_reading_time(found->mesh, start);
        return std::move(*found);
    }
    DescribedMesh made = described_anew(mesh, entry, bytes, options);
    make_parent_folders(file);
    write_description(file, made, entry.name, entry.path, options);
    if (!warning.empty()) made.mesh.warnings.push_back(warning);
    return made;
}

}  // namespace coseg
