#include "io/gltf/gltf_scene.hpp"

#include <set>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

[[noreturn]] void refuse_scene(const GltfAsset& asset, const std::string& what) {
    throw Error(ExitCode::input, asset.path + ": the file is damaged: " + what + "; export the mesh again");
}

std::string name_of_primitive(int mesh, int primitive) {
    return "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(primitive) + "]";
}

bool is_drawn(const GltfPrimitive& primitive) { return primitive.mode >= GltfMode::triangles; }

void check_primitive(const GltfAsset& asset, int mesh, int number) {
    const GltfPrimitive& primitive = asset.meshes[at(mesh)][at(number)];
    const std::string name = name_of_primitive(mesh, number);
    const bool has_data = primitive.positions >= 0 && has_elements(asset.accessors[at(primitive.positions)]);
    if (!has_data && !primitive.compression.empty()) {
        throw Error(ExitCode::input, asset.path + ": the mesh is compressed with " + primitive.compression +
                                         ", which is not read; save it without compression");
    }
    if (primitive.positions < 0) refuse_scene(asset, name + " has no attribute POSITION");
    if (asset.accessors[at(primitive.positions)].components != 3)
        refuse_scene(asset, name + " has positions of other than three coordinates");
    const GltfElements positions(asset, primitive.positions);  // sees to it that they are there
    if (primitive.indices < 0) return;
    const GltfAccessor& indices = asset.accessors[at(primitive.indices)];
    const bool are_whole =
        indices.component_type == 5121 || indices.component_type == 5123 || indices.component_type == 5125;
    if (indices.components != 1 || !are_whole)
        refuse_scene(asset, name + " has indices that are no whole numbers");
    const GltfElements corners(asset, primitive.indices);
}

void check_primitives(const GltfAsset& asset, const GltfScene& scene) {
    std::set<std::pair<int, int>> checked;
    for (const GltfDraw& draw : scene.draws) {
        if (checked.insert({draw.mesh, draw.primitive}).second)
            check_primitive(asset, draw.mesh, draw.primitive);
    }
}

void add_draws(const GltfAsset& asset, int node, const Eigen::Matrix4d& to_scene, GltfScene& scene) {
    constexpr std::size_t most_draws = 1'000'000;
    const int mesh = asset.nodes[at(node)].mesh;
    if (mesh < 0) return;
    const bool has_skin = asset.nodes[at(node)].skin >= 0;
    for (int k = 0; k < std::ssize(asset.meshes[at(mesh)]); ++k) {
        if (!is_drawn(asset.meshes[at(mesh)][at(k)])) {
            ++scene.passed_over;
            continue;
        }
        if (scene.draws.size() >= most_draws)
            throw Error(ExitCode::input,
                        asset.path + ": the scene has more than 1,000,000 primitives; split it");
        scene.draws.push_back(
            {node, mesh, k, has_skin ? Eigen::Matrix4d(Eigen::Matrix4d::Identity()) : to_scene});
    }
}

GltfTriangle strip_triangle(const std::vector<std::uint32_t>& vertices, std::size_t k) {
    return k % 2 == 0 ? GltfTriangle{vertices[k], vertices[k + 1], vertices[k + 2]}
                      : GltfTriangle{vertices[k], vertices[k + 2], vertices[k + 1]};
}

std::vector<std::uint32_t> vertex_list(const GltfAsset& asset, const GltfDraw& draw) {
    const GltfPrimitive& primitive = asset.meshes[at(draw.mesh)][at(draw.primitive)];
    const std::size_t positions = asset.accessors[at(primitive.positions)].count;
    std::vector<std::uint32_t> list;
    if (primitive.indices < 0) {
        list.resize(positions);
        for (std::size_t k = 0; k < positions; ++k) list[k] = static_cast<std::uint32_t>(k);
        return list;
    }
    const GltfElements indices(asset, primitive.indices);
    list.resize(indices.count());
    for (std::size_t k = 0; k < list.size(); ++k) {
        list[k] = indices.index(k);
        if (list[k] >= positions) {
            refuse_scene(asset, name_of_primitive(draw.mesh, draw.primitive) + " refers to vertex " +
                                    std::to_string(list[k]) + " with its index " + std::to_string(k) +
                                    ", but there are " + std::to_string(positions) +
                                    " vertices (counted from 0)");
        }
    }
    return list;
}

}  // namespace

GltfScene gltf_scene(const GltfAsset& asset) {
    struct Waiting {
        int node;
        Eigen::Matrix4d to_scene;
    };
    GltfScene scene;
    std::vector<char> is_reached(asset.nodes.size(), 0);
    std::vector<Waiting> waiting;
    for (auto root = asset.roots.rbegin(); root != asset.roots.rend(); ++root)
        waiting.push_back({*root, asset.nodes[at(*root)].to_parent});
    while (!waiting.empty()) {
        const Waiting now = waiting.back();
        waiting.pop_back();
        if (is_reached[at(now.node)]++ != 0)
            refuse_scene(asset,
                         "nodes[" + std::to_string(now.node) + "] is the child of two nodes, or of itself");
        add_draws(asset, now.node, now.to_scene, scene);
        const std::vector<int>& children = asset.nodes[at(now.node)].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            waiting.push_back({*child, now.to_scene * asset.nodes[at(*child)].to_parent});
    }
    check_primitives(asset, scene);
    return scene;
}

std::size_t most_triangles(const GltfAsset& asset, const GltfPrimitive& primitive) {
    const int list = primitive.indices >= 0 ? primitive.indices : primitive.positions;
    const GltfAccessor& accessor = asset.accessors[at(list)];
    // What replaces indices costs time at every draw, and is counted for that reason.
    const std::size_t count = accessor.count + (accessor.sparse ? accessor.sparse->count : 0);
    if (primitive.mode == GltfMode::triangles) return count / 3;
    return count < 3 ? 0 : count - 2;
}

std::vector<GltfTriangle> gltf_triangles(const GltfAsset& asset, const GltfDraw& draw) {
    const GltfMode mode = asset.meshes[at(draw.mesh)][at(draw.primitive)].mode;
    const std::vector<std::uint32_t> vertices = vertex_list(asset, draw);
    std::vector<GltfTriangle> triangles;
    if (mode == GltfMode::triangles) {
        if (vertices.size() % 3 != 0) {
            refuse_scene(asset, name_of_primitive(draw.mesh, draw.primitive) + " has triangles of " +
                                    std::to_string(vertices.size()) +
                                    " corners, which is no multiple of three");
        }
        triangles.reserve(vertices.size() / 3);
        for (std::size_t k = 0; k < vertices.size(); k += 3)
            triangles.push_back({vertices[k], vertices[k + 1], vertices[k + 2]});
        return triangles;
    }
    for (std::size_t k = 0; k + 2 < vertices.size(); ++k) {
        const GltfTriangle triangle = mode == GltfMode::triangle_strip
                                          ? strip_triangle(vertices, k)
                                          : GltfTriangle{vertices[k + 1], vertices[k + 2], vertices[0]};
        const auto [a, b, c] = triangle;
        if (a != b && b != c && c != a) triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace coseg
