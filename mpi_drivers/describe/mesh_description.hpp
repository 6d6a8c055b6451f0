#pragma once
// All that is computed from one mesh alone: its patches, the descriptors of its faces, how patches touch and overlap.

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "mpi_drivers/options/run_options.hpp"
#include "src/descriptors/feature.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/polygon_mesh.hpp"
#include "src/patches/mesh_patch_pairs.hpp"
#include "src/records/fields.hpp"
#include "src/repair/mesh_repair.hpp"

namespace coseg {

/// What the time of a description is spent on, in the order of the work.
enum class DescribeStep : int {
    read,
    repair,
    dual_graph,
    curvature,
    shape_diameter,
    conformal_factor,
    geodesics,
    contexts,
    oversegmentation,
    relations
};
inline constexpr int describe_step_total = 10;
inline constexpr std::array<const char*, describe_step_total> describe_step_names = {
    "read",      "repair",   "dual_graph",       "curvature", "shape_diameter", "conformal_factor",
    "geodesics", "contexts", "oversegmentation", "relations"};

/// The options that a description depends on, and no others: what describe_mesh uses must stand here, because the
/// descriptions in a state folder are found by it (description_file.hpp).
struct DescriptionOptions {
    std::uint64_t seed = 1;
    std::string remesh = "auto";
    int patches = 50;
    int oversegmentations = 3;
    double cut_noise = 0.3;
    int geodesic_samples = 300;
    static constexpr auto fields() {
        return std::tuple(field("seed", &DescriptionOptions::seed),
                          field("remesh", &DescriptionOptions::remesh),
                          field("patches", &DescriptionOptions::patches),
                          field("oversegmentations", &DescriptionOptions::oversegmentations),
                          field("cut-noise", &DescriptionOptions::cut_noise),
                          field("geodesic-samples", &DescriptionOptions::geodesic_samples));
    }
};

DescriptionOptions description_options(const RunOptions& options);

/// A stretch of work on one step; a step may have several.
struct StepSpan {
    DescribeStep step = DescribeStep::read;
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
    DualGraph graph;
    std::array<Eigen::VectorXd, feature_total>
        descriptors;                        ///< F each; the shape context's entry stays empty
    Eigen::MatrixXf shape_context;          ///< bins x F
    std::vector<std::vector<int>> patches;  ///< per over-segmentation: patch of each working face
    std::vector<int> patch_counts;          ///< per over-segmentation
    std::vector<std::vector<PatchNeighbors>> neighbors;  ///< per over-segmentation
    std::vector<OverlapsOfPair> overlaps;
    std::vector<std::string> warnings;
    bool reused = false;  ///< read from a state folder
    double seconds = 0.0;
    std::array<double, describe_step_total> step_seconds{};
    std::vector<StepSpan> step_spans;  ///< ascending in time, disjoint
    /// What a state folder keeps; the rest belongs to a run or stands in the mesh's own file.
    static constexpr auto fields() {
        return std::tuple(
            local(&MeshDescription::mesh), local(&MeshDescription::key), local(&MeshDescription::input),
            field("map", &MeshDescription::map), field("overlong_area", &MeshDescription::overlong_area),
            field("remeshed", &MeshDescription::remeshed), field("geometry", &MeshDescription::geometry),
            field("graph", &MeshDescription::graph), local(&MeshDescription::descriptors),
            local(&MeshDescription::shape_context), field("patches", &MeshDescription::patches),
            field("patch_counts", &MeshDescription::patch_counts),
            field("neighbors", &MeshDescription::neighbors), field("overlaps", &MeshDescription::overlaps),
            local(&MeshDescription::warnings), local(&MeshDescription::reused),
            local(&MeshDescription::seconds), local(&MeshDescription::step_seconds),
            local(&MeshDescription::step_spans));
    }
};

/// Repairs, over-segments and describes one mesh. bytes: the content of the file at `path`. Serial; a function of the
/// bytes, the name, the extension of the path and the options alone, but for the path in warnings.
/// Throws Error(input) if the file cannot be used.
MeshDescription describe_mesh(int mesh, const std::string& name, const std::string& path,
                              std::string_view bytes, const DescriptionOptions& options);

/// The same from the file itself, without patches, neighbours and overlaps.
MeshDescription describe_mesh_faces(int mesh, const std::string& name, const std::string& path,
                                    const DescriptionOptions& options);

}  // namespace coseg
