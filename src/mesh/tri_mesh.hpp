#pragma once
// The plain triangle mesh on which every geometric stage works.

#include <Eigen/Core>

namespace coseg {

/// A closed or open triangle mesh. Each edge has at most two faces, and all faces are consistently oriented.
/// Readers and generators establish this (see src/repair/mesh_repair.hpp), and the stages after them rely on
/// it.
struct TriMesh {
    Eigen::Matrix3Xd vertices;  ///< 3 x V, any unit; the pipeline scales to area 1 (scale_to_unit_area)
    Eigen::Matrix3Xi faces;     ///< 3 x F, counter-clockwise seen from outside

    [[nodiscard]] int vertex_count() const noexcept { return static_cast<int>(vertices.cols()); }
    [[nodiscard]] int face_count() const noexcept { return static_cast<int>(faces.cols()); }
};

}  // namespace coseg
