#pragma once
// From where a shape is looked at, and which view of several shows most of it.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct View {
    Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  ///< unit, from the shape to the eye
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();  ///< unit, upwards in the picture, normal to `towards`

    [[nodiscard]] Eigen::Vector3d right() const { return up.cross(towards); }
};

enum class UpAxis { x, y, z };

/// The view from `azimuth` degrees to the right of the shape's front and `elevation` degrees above the horizon
/// (-90..90). A shape with y up has its front towards +z, with z up towards -y, with x up towards +z: the customs of
/// modelling programs.
View view_from(UpAxis up, double azimuth, double elevation);

/// A view by name - front, back, left, right, top, bottom, corner - or as "AZIMUTH,ELEVATION" in degrees; nothing if
/// the text is neither.
std::optional<View> named_view(const std::string& text, UpAxis up);

/// The views that a collection's own is chosen from: three quarter views of the front half, for every up axis
/// in `axes`, the ones that people prefer first.
std::vector<View> candidate_views(const std::vector<UpAxis>& axes);

/// Area of the shape's outline seen from each view, in the mesh's unit squared, to about one percent.
std::vector<double> outline_areas(const TriMesh& mesh, const std::vector<View>& views);

/// How well a mesh would stand on the lower end of each axis x, y, z: the area of the bounding rectangle of
/// what touches the ground (the lowest twentieth), as a share of the mesh's whole bounding rectangle seen from above.
Eigen::Vector3d standing_shares(const TriMesh& mesh);

/// How far a mesh is from its mirror image along each axis x, y, z, 0..1: half the difference of how the area lies along
/// the axis, in sixteenths, and back. Most things are alike to the left and the right and at times to the front and the back, seldom above and below.
Eigen::Vector3d mirror_differences(const TriMesh& mesh);

}  // namespace coseg
