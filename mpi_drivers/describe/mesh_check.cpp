#include "mpi_drivers/describe/mesh_check.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/parallel/shared_counter.hpp"
#include "src/repair/mesh_repair.hpp"

namespace coseg {

namespace {

int piece_count(TriMesh mesh) {
    scale_to_unit_area(mesh);
    const std::vector<int> piece_of_face = face_components(dual_graph(mesh, face_geometry(mesh)));
    return piece_of_face.empty() ? 0 : *std::max_element(piece_of_face.begin(), piece_of_face.end()) + 1;
}

void read_and_repair(CheckedMesh& checked, const BorderLimits& welding) {
    ParsedMesh parsed = parse_mesh(mesh_file_bytes(checked.path), checked.path);
    checked.vertices = parsed.mesh.vertex_count();
    checked.faces = parsed.mesh.face_count();
    RepairedMesh repaired = repair(parsed.mesh, checked.path, welding);
    checked.warnings = std::move(parsed.warnings);
    checked.warnings.insert(checked.warnings.end(), repaired.warnings.begin(), repaired.warnings.end());
    checked.pieces = piece_count(std::move(repaired.mesh));
}

/// A mesh with its place in the collection.
struct NumberedCheck {
    std::int64_t number = 0;
    CheckedMesh mesh;
    static constexpr auto fields() {
        return std::tuple(field("number", &NumberedCheck::number), field("mesh", &NumberedCheck::mesh));
    }
};

}  // namespace

CheckedMesh check_mesh(const MeshEntry& entry, const BorderLimits& welding) {
    CheckedMesh checked;
    checked.name = entry.name;
    checked.path = entry.path;
    try {
        read_and_repair(checked, welding);
    } catch (const std::bad_alloc&) {
        checked.set_aside = entry.path + ": out of memory; use more nodes";
    } catch (const Error& error) {
        checked.set_aside = error.what();
    } catch (const std::exception& error) {
        checked.set_aside = entry.path + ": " + error.what();
    }
    return checked;
}

std::vector<CheckedMesh> check_meshes(const Comm& comm, const std::vector<MeshEntry>& entries,
                                      const BorderLimits& welding) {
    const auto total = static_cast<std::int64_t>(entries.size());
    std::vector<NumberedCheck> local;
    {
        SharedCounter counter(comm);
        for (std::int64_t k = counter.next(); k < total; k = counter.next())
            local.push_back({k, check_mesh(entries[at(k)], welding)});
    }
    std::vector<NumberedCheck> all = gather_records(comm, local);
    std::sort(all.begin(), all.end(),
              [](const NumberedCheck& a, const NumberedCheck& b) { return a.number < b.number; });
    std::vector<CheckedMesh> checked;
    for (NumberedCheck& one : all) checked.push_back(std::move(one.mesh));
    return checked;
}

}  // namespace coseg
