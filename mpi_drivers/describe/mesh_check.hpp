#pragma once
// What a run would do with each mesh, found out by reading and repairing it and nothing more.

#include <string>
#include <tuple>
#include <vector>

#include "io/mesh_files/mesh_list.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/fields.hpp"
#include "src/repair/border_welding.hpp"

namespace coseg {

struct CheckedMesh {
    std::string name;
    std::string path;
    int vertices = 0;  ///< of the file, less those that are left out
    int faces = 0;     ///< of the file
    int pieces = 0;    ///< connected by edges, after the repair
    /// What a run would say of the mesh, one sentence each, beginning with the path.
    std::vector<std::string> warnings;
    std::string set_aside;  ///< why a run would set the mesh aside; empty if it would not
    static constexpr auto fields() {
        return std::tuple(field("name", &CheckedMesh::name), field("path", &CheckedMesh::path),
                          field("vertices", &CheckedMesh::vertices), field("faces", &CheckedMesh::faces),
                          field("pieces", &CheckedMesh::pieces), field("warnings", &CheckedMesh::warnings),
                          field("set_aside", &CheckedMesh::set_aside));
    }
};

/// Reads and repairs a mesh as describe_mesh does. Serial; throws nothing for a mesh that cannot be used.
/// Whether it would be remeshed or refined, which depends on the options of a run, is not found out.
CheckedMesh check_mesh(const MeshEntry& entry, const BorderLimits& welding = {});

/// The same for all meshes, in their order, on the root; elsewhere empty. The meshes are shared out among the
/// ranks. Collective.
std::vector<CheckedMesh> check_meshes(const Comm& comm, const std::vector<MeshEntry>& entries,
                                      const BorderLimits& welding = {});

}  // namespace coseg
