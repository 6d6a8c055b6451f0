#pragma once
// Says from where a shape is looked at, and which view of several shows most of it.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "src/base/enum_names.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct View {
    Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  ///< unit, from the shape to the eye
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();  ///< unit, upwards in the picture, orthogonal to `towards`

    [[nodiscard]] Eigen::Vector3d right() const { return up.cross(towards); }
};

enum class UpAxis { x, y, z };

/// The axis that points up in pictures, as a user asks for it.
enum class UpChoice {
    automatic,  ///< the one on which the shapes stand best
    x,
    y,
    z,
};
constexpr std::array<EnumName<UpChoice>, 4> enum_names(UpChoice /*type*/) {
    return {{{UpChoice::automatic, "auto"}, {UpChoice::x, "x"}, {UpChoice::y, "y"}, {UpChoice::z, "z"}}};
}

/// The name of the view that shows the largest outlines.
inline constexpr const char* widest_view = "auto";

struct ViewChoice {
    std::string view = widest_view;  ///< or a name or AZIMUTH,ELEVATION, see named_view
    UpChoice up = UpChoice::automatic;
};

/// The view from `azimuth` degrees to the right of the shape's front and `elevation` degrees above the
/// horizon (-90..90). A shape with y up has its front towards +z, with z up towards -y, with x up towards +z:
/// the customs of modelling programs.
View view_from(UpAxis up, double azimuth, double elevation);

/// A view by name (front, back, left, right, top, bottom, corner) or as "AZIMUTH,ELEVATION" in degrees. There
/// is no value if the text is neither.
std::optional<View> named_view(const std::string& text, UpAxis up);

/// The views from which that of a collection is chosen: three-quarter views of the front half, for every up
/// axis in `axes`. Those that people prefer come first.
std::vector<View> candidate_views(const std::vector<UpAxis>& axes);

/// The area of the shape's outline seen from each view, in the mesh's unit squared, to about one percent.
std::vector<double> outline_areas(const TriMesh& mesh, const std::vector<View>& views);

/// How well a mesh would stand on the lower end of each axis x, y, z. The measure is the area of the bounding
/// rectangle of what touches the ground (the lowest twentieth), as a share of the bounding rectangle of the
/// whole mesh seen from above.
Eigen::Vector3d standing_shares(const TriMesh& mesh);

/// How far a mesh is from its mirror image along each axis x, y, z, in 0 .. 1. The area is counted in
/// sixteenths along the axis, forwards and backwards, and the value is half the difference of the two. Most
/// things are alike to the left and the right, some to the front and the back, and few above and below.
Eigen::Vector3d mirror_differences(const TriMesh& mesh);

}  // namespace coseg
