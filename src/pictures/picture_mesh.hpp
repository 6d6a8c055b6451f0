#pragma once
// A mesh as it is drawn: triangles with a colour each.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/polygon_mesh.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/pictures/image.hpp"

namespace coseg {

struct PictureMesh {
    TriMesh mesh;  ///< scaled into the unit ball about the middle of its bounding box; need not be closed
    std::vector<Color> colors;  ///< per triangle
    std::vector<int> faces;     ///< per triangle the face of the file that it is of
};

/// The polygons as they stand in the file (repeated vertices welded, so that smooth stays smooth), each in its
/// colour: one colour per face of the file. Faces without area draw nothing.
PictureMesh picture_mesh(const PolygonMesh& mesh, const std::vector<Color>& color_of_face);

/// The same for a triangle mesh.
PictureMesh picture_mesh(const TriMesh& mesh, const std::vector<Color>& color_of_face);

/// Per corner of each triangle (3 x 3F, corner k of triangle f in column 3 f + k) a unit normal: the mean over
/// the triangles about the vertex, weighted by area, that turn from this one by less than crease_degrees. So
/// rounded surfaces look round and edges stay sharp. Triangles without area have normal 0.
Eigen::Matrix3Xf corner_normals(const TriMesh& mesh, double crease_degrees);

}  // namespace coseg
