#pragma once
// Turns a polygon mesh about the origin.

#include <Eigen/Core>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

/// The mesh with its vertices at rotation * x. `rotation` is orthogonal; if it reflects, the corners of every
/// face are in the opposite order, so that its outer side stays outside.
PolygonMesh turned(PolygonMesh mesh, const Eigen::Matrix3d& rotation);

}  // namespace coseg
