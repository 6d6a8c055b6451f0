#pragma once
// Computes everything that depends on one mesh alone: its patches, how they touch and overlap, and the
// descriptors of its faces.

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "io/mesh_files/mesh_list.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/descriptors/descriptor_table.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/patches/mesh_patch_pairs.hpp"
#include "src/records/fields.hpp"
#include "src/repair/mesh_repair.hpp"

namespace coseg {

/// The steps of a description, in the order of the work.
std::vector<std::string> describe_steps(const DescriptionOptions& options);

/// A span of work on one step. A step may have several spans.
struct StepSpan {
    std::string step;
    std::chrono::steady_clock::time_point start;
    std::chrono::steady_clock::time_point end;
};

struct OverlapsOfPair {
    int oversegmentation_a = 0;  ///< a < b
    int oversegmentation_b = 0;
    std::vector<PatchOverlap> overlaps;
    static constexpr auto fields() {
        return std::tuple(field("oversegmentation_a", &OverlapsOfPair::oversegmentation_a),
                          field("oversegmentation_b", &OverlapsOfPair::oversegmentation_b),
                          field("overlaps", &OverlapsOfPair::overlaps));
    }
};

struct MeshDescription {
    int mesh = 0;           ///< number in the collection
    std::uint64_t key = 0;  ///< hash of the name: the mesh's own randomness
    PolygonMesh input;
    FaceMap map;
    double overlong_area = 0.0;  ///< overlong_area_share of the mesh as it was read and repaired
    bool remeshed = false;
    FaceGeometry geometry;  ///< of the working mesh, area 1
    DualGraph graph;        ///< without its incidence once patches are cut, see release_incidence
    std::vector<std::vector<int>> patches;  ///< per over-segmentation: patch of each working face
    std::vector<int> patch_counts;          ///< per over-segmentation
    std::vector<std::vector<PatchNeighbors>> neighbors;  ///< per over-segmentation
    std::vector<OverlapsOfPair> overlaps;
    std::vector<std::string> warnings;
    bool reused = false;  ///< read from a state folder
    double seconds = 0.0;
    std::vector<StepSpan> step_spans;  ///< ascending in time, disjoint
    /// The fields that a state folder keeps; the others belong to a run or are in the mesh's own file.
    static constexpr auto fields() {
        return std::tuple(
            local(&MeshDescription::mesh), local(&MeshDescription::key), local(&MeshDescription::input),
            field("map", &MeshDescription::map), field("overlong_area", &MeshDescription::overlong_area),
            field("remeshed", &MeshDescription::remeshed), field("geometry", &MeshDescription::geometry),
            field("graph", &MeshDescription::graph), field("patches", &MeshDescription::patches),
            field("patch_counts", &MeshDescription::patch_counts),
            field("neighbors", &MeshDescription::neighbors), field("overlaps", &MeshDescription::overlaps),
            local(&MeshDescription::warnings), local(&MeshDescription::reused),
            local(&MeshDescription::seconds), local(&MeshDescription::step_spans));
    }
};

/// The data of a mesh that the later stages need, and the values of which its features are made.
struct DescribedMesh {
    MeshDescription mesh;
    FaceDescriptors descriptors;  ///< of the working faces
};

/// Repairs, over-segments and describes one mesh. `bytes` are the content of the file at `path`. Serial. The
/// result is a function of the bytes, the name, the extension of the path and the options alone, except for
/// the path in warnings. Throws Error(input) if the file cannot be used.
DescribedMesh describe_mesh(int mesh, const std::string& name, const std::string& path,
                            std::string_view bytes, const DescriptionOptions& options);

/// The same of polygons in memory, which messages call `path`.
DescribedMesh describe_polygons(int mesh, const std::string& name, const std::string& path,
                                const PolygonView& polygons, const DescriptionOptions& options);

/// The same of a mesh of a collection, in a file or in memory, without patches, neighbours and overlaps.
DescribedMesh describe_mesh_faces(int mesh, const MeshEntry& entry, const DescriptionOptions& options);

}  // namespace coseg
