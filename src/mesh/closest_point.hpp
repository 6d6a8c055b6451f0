#pragma once
// Finds the nearest point of a triangle mesh by a tree of boxes.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct ClosestPoint {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    int face = -1;
    double distance = 0.0;
};

/// The tree is built once and then searched often. It holds a copy of the mesh. Faces may be degenerate, that
/// is, segments or points.
class ClosestPointTree {
  public:
    /// Throws Error(input) for a mesh without faces.
    explicit ClosestPointTree(const TriMesh& mesh);

    /// The nearest point over all faces. Where several faces hold it, the one with the lowest number is
    /// given.
    [[nodiscard]] ClosestPoint nearest(const Eigen::Vector3d& point) const;

    /// The same over the faces whose normal n satisfies n . normal > 0, so that the other side of a thin wall
    /// is left out. If there is no such face, all faces are searched.
    [[nodiscard]] ClosestPoint nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  private:
    struct Node {
        Eigen::Vector3d low, high;
        /// A leaf: its first entry of order_. An inner node: its left child; the right child follows it.
        int first = 0;
        int count = 0;  ///< faces of a leaf; 0 for an inner node
    };
    void build(int node, int begin, int end);
    [[nodiscard]] ClosestPoint search(const Eigen::Vector3d& point, const Eigen::Vector3d* normal) const;

    TriMesh mesh_;
    Eigen::Matrix3Xd normals_;
    Eigen::Matrix3Xd centroids_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

/// For every face of `of`: the face of `on` that is nearest to its centroid and faces the same way. By this,
/// labels travel between two meshes of one surface.
std::vector<int> nearest_faces(const TriMesh& of, const TriMesh& on);

}  // namespace coseg
