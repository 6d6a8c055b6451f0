#pragma once
// Walks through a glTF scene: what is drawn, in which order, and as which triangles.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "io/gltf/gltf_accessor.hpp"
#include "io/gltf/gltf_asset.hpp"

namespace coseg {

/// One primitive of triangles at one node. A mesh at several nodes is drawn several times.
struct GltfDraw {
    int node = 0;
    int mesh = 0;
    int primitive = 0;  ///< of the mesh
    Eigen::Matrix4d to_scene = Eigen::Matrix4d::Identity();
};

struct GltfScene {
    /// In the order of faces: nodes depth first, each before its children, children and primitives in the
    /// order of the file.
    std::vector<GltfDraw> draws;
    int passed_over = 0;  ///< primitives of points and lines
};

/// Three numbers of elements of the primitive's accessors.
using GltfTriangle = std::array<std::uint32_t, 3>;

/// A node with a skin stands where its vertices stand in the file, as its own place does not count. Throws
/// Error(input) where a node is reached twice, or a primitive's data are compressed or are no positions
/// that lie in the file.
GltfScene gltf_scene(const GltfAsset& asset);

/// An upper bound of the number of triangles of a primitive, which takes no time to find.
std::size_t most_triangles(const GltfAsset& asset, const GltfPrimitive& primitive);

/// The triangles of a draw in their order and direction of the file. Those of strips and fans that repeat a
/// vertex only lead on and are left out. Throws Error(input) for indices that are no whole numbers or no
/// vertices, and a list of triangles whose length is not a multiple of three.
std::vector<GltfTriangle> gltf_triangles(const GltfAsset& asset, const GltfDraw& draw);

}  // namespace coseg
