#include "mpi_drivers/describe/mesh_description.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "io/files/file_contents.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "solvers/oversegmentation/oversegmentation.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/text.hpp"
#include "src/descriptors/average_geodesic.hpp"
#include "src/descriptors/conformal_factor.hpp"
#include "src/descriptors/gaussian_curvature.hpp"
#include "src/descriptors/minimum_curvature.hpp"
#include "src/descriptors/shape_context.hpp"
#include "src/descriptors/shape_diameter.hpp"
#include "src/geodesics/geodesic.hpp"
#include "src/remesh/face_suitability.hpp"
#include "src/remesh/mapped_remesh.hpp"
#include "src/remesh/midpoint_refinement.hpp"

namespace coseg {

namespace {

/// Below this many faces a patch a boundary between patches is too ragged to follow a crease.
constexpr int faces_per_patch = 20;

/// A remeshed mesh keeps its number of faces within these limits a patch.
constexpr int fewest_even_faces = 60;
constexpr int most_even_faces = 400;

/// Share of the area in overlong triangles above which `--remesh auto` remeshes. The labelled sets have up to 0.56 (a
/// chair) and are cut well as they are; solids of revolution of few rings, which are not, have 0.8 and more.
constexpr double most_overlong_area = 0.7;

/// Adds the time since it was made, or since the last step, to a step of the description.
class StepClock {
  public:
    explicit StepClock(MeshDescription& description) : description_(description) {}
    void end_of(DescribeStep step) {
        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        description_.step_seconds[at(step)] += seconds;
        description_.seconds += seconds;
        description_.step_spans.push_back({step, last_, now});
        last_ = now;
    }

  private:
    using Clock = std::chrono::steady_clock;
    MeshDescription& description_;
    Clock::time_point last_ = Clock::now();
};

void refine_if_coarse(TriMesh& mesh, MeshDescription& description, const std::string& path, int patches) {
    const int coarse = mesh.face_count();
    const int wanted = patches * faces_per_patch;
    if (coarse >= wanted) return;
    refine_to_face_count(mesh, description.map, wanted);
    description.warnings.push_back(
        path + ": only " + std::to_string(coarse) + (coarse == 1 ? " triangle for " : " triangles for ") +
        std::to_string(patches) + " patches: refined internally to " + std::to_string(mesh.face_count()));
}

void remesh(TriMesh& mesh, MeshDescription& description, const std::string& path, int patches) {
    const int faces = std::clamp(mesh.face_count(), patches * fewest_even_faces, patches * most_even_faces);
    remesh_evenly(mesh, description.map, faces);
    description.remeshed = true;
    description.warnings.push_back(
        path + ": " + percent(description.overlong_area, 0) +
        " of the area is in triangles too long for patches: remeshed internally to " +
        std::to_string(mesh.face_count()) + " even triangles");
}

/// A mesh that cannot be remeshed is still cut as well as its triangles allow.
void remesh_if_possible(TriMesh& mesh, MeshDescription& description, const std::string& path, int patches) {
    try {
        remesh(mesh, description, path, patches);
    } catch (const Error& error) {
        description.warnings.push_back(path + ": cannot be remeshed, " + error.what());
    }
}

TriMesh working_mesh(MeshDescription& description, const std::string& path,
                     const DescriptionOptions& options) {
    RepairedMesh repaired = repair(description.input, path);
    description.warnings = std::move(repaired.warnings);
    description.map = std::move(repaired.map);
    description.overlong_area = overlong_area_share(repaired.mesh, options.patches);
    const bool unsuitable = description.overlong_area > most_overlong_area;
    if (options.remesh == "always") remesh(repaired.mesh, description, path, options.patches);
    if (options.remesh == "auto" && unsuitable)
        remesh_if_possible(repaired.mesh, description, path, options.patches);
    refine_if_coarse(repaired.mesh, description, path, options.patches);
    scale_to_unit_area(repaired.mesh);
    return std::move(repaired.mesh);
}

Eigen::VectorXd& descriptor(MeshDescription& description, Feature feature) {
    return description.descriptors[at(feature)];
}

void describe_faces(MeshDescription& description, const TriMesh& mesh, const DescriptionOptions& options,
                    StepClock& clock) {
    const FaceGeometry& geometry = description.geometry;
    descriptor(description, Feature::gaussian_curvature) = gaussian_curvature(mesh, geometry);
    clock.end_of(DescribeStep::curvature);
    descriptor(description, Feature::shape_diameter) = shape_diameter(mesh, geometry, description.graph);
    clock.end_of(DescribeStep::shape_diameter);
    descriptor(description, Feature::conformal_factor) = conformal_factor(mesh, geometry);
    clock.end_of(DescribeStep::conformal_factor);
    const GeodesicTable table = geodesic_table(mesh, geometry, description.graph, options.geodesic_samples,
                                               hash_words({options.seed, description.key}));
    clock.end_of(DescribeStep::geodesics);
    descriptor(description, Feature::average_geodesic) = average_geodesic(table);
    description.shape_context = shape_context(table, geometry);
    clock.end_of(DescribeStep::contexts);
}

void cut_into_patches(MeshDescription& description, const TriMesh& mesh, const DescriptionOptions& options,
                      StepClock& clock) {
    const Eigen::VectorXd curvature = minimum_curvature(mesh, description.geometry);
    clock.end_of(DescribeStep::curvature);
    for (int s = 0; s < options.oversegmentations; ++s) {
        const std::uint64_t seed = hash_words({options.seed, description.key, static_cast<std::uint64_t>(s)});
        const OversegmentationOptions choice{.patches = options.patches, .noise = options.cut_noise};
        description.patches.push_back(oversegment(description.geometry, description.graph, choice, seed));
        clock.end_of(DescribeStep::oversegmentation);
        const std::vector<int>& patches = description.patches.back();
        description.patch_counts.push_back(*std::max_element(patches.begin(), patches.end()) + 1);
        description.neighbors.push_back(patch_neighbors(description.graph, patches, curvature));
        clock.end_of(DescribeStep::relations);
    }
    for (int a = 0; a < options.oversegmentations; ++a) {
        for (int b = a + 1; b < options.oversegmentations; ++b) {
            const std::vector<int>& patches_a = description.patches[at(a)];
            const std::vector<int>& patches_b = description.patches[at(b)];
            description.overlaps.push_back(
                {a, b, patch_overlaps(description.geometry, patches_a, patches_b)});
        }
    }
    clock.end_of(DescribeStep::relations);
}

/// All but the patches; returns the working mesh.
TriMesh describe_surface(MeshDescription& description, int mesh, const std::string& name,
                         const std::string& path, std::string_view bytes, const DescriptionOptions& options) {
    StepClock clock(description);
    description.mesh = mesh;
    description.key = hash_text(name);
    description.input = parse_mesh(bytes, path);
    clock.end_of(DescribeStep::read);
    TriMesh working = working_mesh(description, path, options);
    clock.end_of(DescribeStep::repair);
    description.geometry = face_geometry(working);
    description.graph = dual_graph(working, description.geometry);
    clock.end_of(DescribeStep::dual_graph);
    describe_faces(description, working, options, clock);
    return working;
}

}  // namespace

DescriptionOptions description_options(const RunOptions& options) {
    return {.seed = options.seed,
            .remesh = options.remesh,
            .patches = options.patches,
            .oversegmentations = options.oversegmentations,
            .cut_noise = options.cut_noise,
            .geodesic_samples = options.geodesic_samples};
}

MeshDescription describe_mesh(int mesh, const std::string& name, const std::string& path,
                              std::string_view bytes, const DescriptionOptions& options) {
    MeshDescription description;
    const TriMesh working = describe_surface(description, mesh, name, path, bytes, options);
    StepClock clock(description);
    cut_into_patches(description, working, options, clock);
    return description;
}

MeshDescription describe_mesh_faces(int mesh, const std::string& name, const std::string& path,
                                    const DescriptionOptions& options) {
    MeshDescription description;
    describe_surface(description, mesh, name, path, read_file(path), options);
    return description;
}

}  // namespace coseg
