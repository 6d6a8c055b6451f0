#include "io/mesh_files/gltf_format.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "io/gltf/gltf_parts.hpp"
#include "io/gltf/gltf_scene.hpp"
#include "io/mesh_files/corner_welder.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/mesh/face_triangles.hpp"

namespace coseg {

namespace {

/// A scene may draw a mesh many times over.
void check_corner_count(const GltfAsset& asset, const GltfScene& scene) {
    const std::size_t most = std::min(static_cast<std::size_t>(most_corners), most_elements(asset));
    std::size_t corners = 0;
    for (const GltfDraw& draw : scene.draws) {
        corners += 3 * most_triangles(asset, asset.meshes[at(draw.mesh)][at(draw.primitive)]);
        if (corners > most) throw Error(ExitCode::input, asset.path + ": " + too_many_corners);
    }
}

void refuse_scene_without_mesh(const GltfAsset& asset, const GltfScene& scene) {
    if (!scene.draws.empty() || scene.passed_over > 0 || asset.meshes.empty()) return;
    const std::string meshes = with_unit(static_cast<std::int64_t>(asset.meshes.size()), "mesh", "meshes");
    throw Error(ExitCode::input, asset.path + ": the file holds " + meshes +
                                     ", but no node of its scene draws one; export it with a node for each");
}

/// Makes one mesh of all draws of a scene.
class GltfCollector {
  public:
    GltfCollector(const GltfAsset& asset, double negligible) : asset_(asset), welder_(negligible) {
        mesh_.offsets.push_back(0);
    }

    void add(const GltfDraw& draw) {
        const int accessor = asset_.meshes[at(draw.mesh)][at(draw.primitive)].positions;
        const GltfElements& positions = elements_.try_emplace(accessor, asset_, accessor).first->second;
        const bool is_mirrored = draw.to_scene.topLeftCorner<3, 3>().determinant() < 0.0;
        for (GltfTriangle triangle : gltf_triangles(asset_, draw)) {
            if (is_mirrored) std::swap(triangle[1], triangle[2]);
            for (const std::uint32_t vertex : triangle)
                mesh_.corners.push_back(welder_.number_of(position_of(draw, positions, vertex)));
            mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
        }
    }

    PolygonMesh finish() {
        mesh_.vertices = welder_.take_vertices();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] Eigen::Vector3d position_of(const GltfDraw& draw, const GltfElements& positions,
                                              std::uint32_t vertex) const {
        const Eigen::Vector4d place(positions.real(vertex, 0), positions.real(vertex, 1),
                                    positions.real(vertex, 2), 1.0);
        Eigen::Vector3d position = (draw.to_scene * place).head<3>();
        for (const double value : position) {
            if (is_usable_coordinate(value)) continue;
            throw Error(ExitCode::input, asset_.path + ": meshes[" + std::to_string(draw.mesh) +
                                             "].primitives[" + std::to_string(draw.primitive) +
                                             "]: " + bad_coordinate(vertex, value));
        }
        return position;
    }

    const GltfAsset& asset_;
    std::map<int, GltfElements> elements_;  ///< by accessor
    PolygonMesh mesh_;
    CornerWelder welder_;
};

bool stands_where_it_was_made(const GltfScene& scene) {
    return std::all_of(scene.draws.begin(), scene.draws.end(),
                       [](const GltfDraw& draw) { return draw.to_scene == Eigen::Matrix4d::Identity(); });
}

const std::vector<int>* pieces_of(const FaceArrays& arrays) {
    for (const auto& [name, values] : arrays.labels) {
        if (name == "piece") return &values;
    }
    return nullptr;
}

std::string object_name(const FaceArrays& arrays, int part, int piece) {
    return part_name(arrays, part) + (piece < 0 ? "" : " " + std::to_string(piece));
}

/// One object for each part, or for each piece of each part.
GltfObjects objects_of(const FaceArrays& arrays, const std::vector<int>& parts) {
    const std::vector<int>* pieces = pieces_of(arrays);
    const auto key = [&](std::size_t face) {
        return std::pair(parts[face], pieces == nullptr ? -1 : (*pieces)[face]);
    };
    std::map<std::pair<int, int>, int> numbers;
    for (std::size_t f = 0; f < parts.size(); ++f) {
        if (parts[f] >= 0) numbers[key(f)] = 0;
    }
    GltfObjects objects;
    for (auto& [what, number] : numbers) {
        number = static_cast<int>(objects.objects.size());
        objects.objects.push_back({object_name(arrays, what.first, what.second), what.first, what.second});
    }
    for (std::size_t f = 0; f < parts.size(); ++f)
        objects.object_of_face.push_back(parts[f] >= 0 ? numbers[key(f)] : -1);
    objects.part_names = arrays.part_names;
    return objects;
}

/// In numbers of single precision. Where these would lose digits, the vertices are taken from the middle of
/// the mesh, and in its own size where it is too small for such numbers.
GltfSurface surface_of(const PolygonMesh& mesh) {
    constexpr double smallest_extent = 1e-30;
    GltfSurface surface;
    if (lost_digits(mesh)) {
        Eigen::Vector3d low = mesh.vertices.front();
        Eigen::Vector3d high = low;
        for (const Eigen::Vector3d& p : mesh.vertices) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        surface.origin = 0.5 * (low + high);
        const double extent = (high - low).maxCoeff();
        if (extent < smallest_extent) surface.scale = extent;
    }
    for (const Eigen::Vector3d& p : mesh.vertices)
        surface.vertices.emplace_back(((p - surface.origin) / surface.scale).cast<float>());
    return surface;
}

}  // namespace

ParsedMesh read_gltf(std::string_view bytes, const std::string& path) {
    const GltfContainer container = split_gltf(bytes, path);
    const GltfAsset asset = read_gltf_asset(container, path);
    const GltfScene scene = gltf_scene(asset);
    refuse_scene_without_mesh(asset, scene);
    check_corner_count(asset, scene);
    const auto collected = [&](double negligible) {
        GltfCollector collector(asset, negligible);
        for (const GltfDraw& draw : scene.draws) collector.add(draw);
        return collector.finish();
    };
    ParsedMesh parsed{read_welded(collected), container.warnings};
    if (scene.passed_over > 0) {
        parsed.warnings.push_back(path + ": " + with_unit(scene.passed_over, "primitive", "primitives") +
                                  " of points or lines " + (scene.passed_over == 1 ? "is" : "are") +
                                  " passed over");
    }
    if (const std::optional<std::string> lost = lost_digits(parsed.mesh);
        lost && stands_where_it_was_made(scene))
        parsed.warnings.push_back(path + ": " + *lost);
    return parsed;
}

void write_glb(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    const GltfObjects of_faces = objects_of(arrays, parts_of(arrays, mesh.face_count(), path));
    GltfObjects objects{of_faces.objects, of_faces.part_names, {}};
    GltfSurface surface = surface_of(mesh);
    for (const FaceTriangle& triangle : face_triangles(mesh)) {
        const auto vertex = [&](std::size_t k) { return static_cast<std::uint32_t>(triangle.vertices[k]); };
        surface.triangles.push_back({vertex(0), vertex(1), vertex(2)});
        objects.object_of_face.push_back(of_faces.object_of_face[at(triangle.face)]);
    }
    write_file(path, glb_of_surface(surface, objects, path));
}

void write_glb_like(const std::string& path, const MeshSource& source, const FaceArrays& arrays) {
    if (arrays.labels.empty()) throw Error(ExitCode::internal, path + ": no labels for its faces");
    const GltfObjects objects = objects_of(arrays, arrays.labels.front().second);
    write_file(path, glb_of_parts(source.bytes, source.path, objects, path));
}

}  // namespace coseg
