#include "mpi_drivers/describe/mesh_description.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <variant>

#include "io/mesh_files/mesh_reader.hpp"
#include "solvers/oversegmentation/oversegmentation.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/text.hpp"
#include "src/descriptors/descriptor_context.hpp"
#include "src/descriptors/minimum_curvature.hpp"
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

/// Share of the area in overlong triangles above which `--remesh auto` remeshes. The labelled sets have up to
/// 0.56 (a chair) and are cut well as they are; solids of revolution of few rings, which are not, have 0.8
/// and more.
constexpr double most_overlong_area = 0.7;

/// Adds the time since it was made, or since the last step, to a step of the description.
class StepClock {
  public:
    explicit StepClock(MeshDescription& description) : description_(description) {}
    void end_of(const char* step) {
        const Clock::time_point now = Clock::now();
        description_.seconds += std::chrono::duration<double>(now - last_).count();
        description_.step_spans.push_back({step, last_, now});
        last_ = now;
    }

  private:
    using Clock = std::chrono::steady_clock;
    MeshDescription& description_;
    Clock::time_point last_ = Clock::now();
};

int even_faces(const TriMesh& mesh, int patches) {
    return std::clamp(mesh.face_count(), patches * fewest_even_faces, patches * most_even_faces);
}

/// A mesh whose edges doubles cannot halve often enough keeps fewer faces than wanted.
void refine_if_coarse(TriMesh& mesh, MeshDescription& description, const std::string& path, int patches,
                      int faces_a_patch) {
    const int coarse = mesh.face_count();
    const int wanted = patches * faces_a_patch;
    if (coarse >= wanted) return;
    refine_to_face_count(mesh, description.map, wanted);
    if (mesh.face_count() == coarse) return;
    description.warnings.push_back(
        path + ": only " + std::to_string(coarse) + (coarse == 1 ? " triangle for " : " triangles for ") +
        std::to_string(patches) + " patches: refined internally to " + std::to_string(mesh.face_count()));
}

/// False if the mesh cannot be remeshed; it then keeps its triangles.
bool remesh_if_possible(TriMesh& mesh, MeshDescription& description, const std::string& path, int patches) {
    try {
        remesh_evenly(mesh, description.map, even_faces(mesh, patches));
    } catch (const Error& error) {
        description.warnings.push_back(path + ": cannot be remeshed: " + error.what());
        return false;
    }
    description.remeshed = true;
    description.warnings.push_back(
        path + ": " + percent(description.overlong_area, 0) +
        " of the area is in triangles too long for patches: remeshed internally to " +
        std::to_string(mesh.face_count()) + " even triangles");
    return true;
}

TriMesh working_mesh(MeshDescription& description, const std::string& path,
                     const DescriptionOptions& options) {
    RepairedMesh repaired = repair(description.input, path, border_limits(options.weld));
    description.warnings.insert(description.warnings.end(), repaired.warnings.begin(),
                                repaired.warnings.end());
    description.map = std::move(repaired.map);
    description.overlong_area = overlong_area_share(repaired.mesh, options.patches);
    const bool is_unsuitable = description.overlong_area > most_overlong_area;
    int faces_a_patch = faces_per_patch;
    if (options.remesh == RemeshMode::always || (options.remesh == RemeshMode::automatic && is_unsuitable)) {
        const bool is_even = remesh_if_possible(repaired.mesh, description, path, options.patches);
        if (!is_even && is_unsuitable) faces_a_patch = fewest_even_faces;
    }
    refine_if_coarse(repaired.mesh, description, path, options.patches, faces_a_patch);
    scale_to_unit_area(repaired.mesh);
    return std::move(repaired.mesh);
}

void cut_into_patches(MeshDescription& description, const TriMesh& mesh, const DescriptionOptions& options,
                      StepClock& clock) {
    const Eigen::VectorXd curvature = minimum_curvature(mesh, description.geometry);
    clock.end_of("curvature");
    for (int s = 0; s < options.oversegmentations; ++s) {
        const std::uint64_t seed = hash_words({options.seed, description.key, static_cast<std::uint64_t>(s)});
        const OversegmentationOptions choice{.patches = options.patches, .noise = options.cut_noise};
        description.patches.push_back(oversegment(description.geometry, description.graph, choice, seed));
        clock.end_of("oversegmentation");
        const std::vector<int>& patches = description.patches.back();
        description.patch_counts.push_back(*std::max_element(patches.begin(), patches.end()) + 1);
        description.neighbors.push_back(patch_neighbors(description.graph, patches, curvature));
        clock.end_of("relations");
    }
    for (int a = 0; a < options.oversegmentations; ++a) {
        for (int b = a + 1; b < options.oversegmentations; ++b) {
            const std::vector<int>& patches_a = description.patches[at(a)];
            const std::vector<int>& patches_b = description.patches[at(b)];
            description.overlaps.push_back(
                {a, b, patch_overlaps(description.geometry, patches_a, patches_b)});
        }
    }
    clock.end_of("relations");
}

/// One mesh whose lengths leave the range of numbers must not end the run of all others.
void refuse_if_not_finite(const FaceDescriptors& descriptors, const std::string& path) {
    for (const FaceDescriptor& descriptor : descriptors) {
        const auto is_finite = [](const auto& values) { return values.allFinite(); };
        if (std::visit(is_finite, descriptor.values)) continue;
        throw Error(ExitCode::input, path +
                                         ": a descriptor is not a finite number; the ratio of the mesh's "
                                         "lengths is beyond what numbers hold");
    }
}

using MeshReading = std::function<ParsedMesh()>;

/// All but the patches; returns the working mesh.
TriMesh describe_surface(DescribedMesh& described, int number, const std::string& name,
                         const std::string& path, const MeshReading& read,
                         const DescriptionOptions& options) {
    MeshDescription& mesh = described.mesh;
    StepClock clock(mesh);
    mesh.mesh = number;
    mesh.key = hash_text(name);
    ParsedMesh parsed = read();
    mesh.input = std::move(parsed.mesh);
    mesh.warnings = std::move(parsed.warnings);
    clock.end_of("read");
    TriMesh working = working_mesh(mesh, path, options);
    clock.end_of("repair");
    mesh.geometry = face_geometry(working);
    mesh.graph = dual_graph(working, mesh.geometry);
    clock.end_of("dual_graph");
    DescriptorContext context(working, mesh.geometry, mesh.graph, options.geodesic_samples,
                              hash_words({options.seed, mesh.key}),
                              [&clock](const char* step) { clock.end_of(step); });
    described.descriptors = face_descriptors(context, options.descriptors);
    refuse_if_not_finite(described.descriptors, path);
    return working;
}

DescribedMesh describe_whole(int mesh, const std::string& name, const std::string& path,
                             const MeshReading& read, const DescriptionOptions& options) {
    DescribedMesh described;
    const TriMesh working = describe_surface(described, mesh, name, path, read, options);
    StepClock clock(described.mesh);
    cut_into_patches(described.mesh, working, options, clock);
    release_incidence(described.mesh.graph);
    return described;
}

}  // namespace

std::vector<std::string> describe_steps(const DescriptionOptions& options) {
    std::vector<std::string> steps = {"read", "repair", "dual_graph"};
    const std::vector<std::string> of_descriptors = descriptor_steps(options.descriptors);
    steps.insert(steps.end(), of_descriptors.begin(), of_descriptors.end());
    for (const char* step : {"curvature", "oversegmentation", "relations"}) {
        if (std::find(steps.begin(), steps.end(), step) == steps.end()) steps.emplace_back(step);
    }
    return steps;
}

DescribedMesh describe_mesh(int mesh, const std::string& name, const std::string& path,
                            std::string_view bytes, const DescriptionOptions& options) {
    return describe_whole(
        mesh, name, path, [&] { return parse_mesh(bytes, path); }, options);
}

DescribedMesh describe_polygons(int mesh, const std::string& name, const std::string& path,
                                const PolygonView& polygons, const DescriptionOptions& options) {
    return describe_whole(
        mesh, name, path, [&] { return checked_polygons(polygons, path); }, options);
}

DescribedMesh describe_mesh_faces(int mesh, const MeshEntry& entry, const DescriptionOptions& options) {
    const MeshReading read = [&] {
        if (entry.polygons != nullptr) return checked_polygons(*entry.polygons, entry.path);
        return parse_mesh(mesh_file_bytes(entry.path), entry.path);
    };
    DescribedMesh described;
    describe_surface(described, mesh, entry.name, entry.path, read, options);
    return described;
}

}  // namespace coseg
