#pragma once
// Prepares a mesh for drawing: triangles, each with a colour.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/pictures/image.hpp"

namespace coseg {

struct PictureMesh {
    TriMesh mesh;  ///< scaled into the unit ball about the middle of its bounding box; need not be closed
    std::vector<Color> colors;  ///< per triangle
    std::vector<int> faces;     ///< per triangle: the face of the file that it belongs to
};

/// The polygons as they stand in the file, each in its colour: one colour per face of the file. Repeated
/// vertices are welded, so that smooth surfaces look smooth. Faces without area are not drawn.
PictureMesh picture_mesh(const PolygonMesh& mesh, const std::vector<Color>& color_of_face);

/// The same for a triangle mesh.
PictureMesh picture_mesh(const TriMesh& mesh, const std::vector<Color>& color_of_face);

/// A unit normal for each corner of each triangle (3 x 3F; corner k of triangle f is column 3 f + k). It is
/// the mean, weighted by area, of the normals of those triangles about the vertex that turn from this one by
/// less than crease_degrees. Rounded surfaces thus look round, and edges stay sharp. Triangles without area
/// have the normal 0.
Eigen::Matrix3Xf corner_normals(const TriMesh& mesh, double crease_degrees);

}  // namespace coseg
