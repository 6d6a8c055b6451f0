#pragma once
// Draws the picture of one shape by tracing rays, with soft light. No display is needed.

#include "src/pictures/image.hpp"
#include "src/pictures/picture_mesh.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

inline constexpr Color picture_background = {0xF7, 0xF7, 0xF5};

struct PictureOptions {
    int size = 320;        ///< pixels, width and height
    double margin = 0.06;  ///< of the size, free on every side
    Color background = picture_background;
};

/// Draws the shape from `view`, as large as the picture allows. The light is one soft lamp over the eye's
/// left shoulder and an even sky. There are 4 rays a pixel for edges and 16 rays a pixel for the occlusion of
/// the sky and the lamp's shadow, smoothed over pixels of one surface. Both sides of a face are visible.
/// Perspective is mild: the eye stands 8 radii away. Serial: it starts no threads. The picture is a function
/// of the arguments alone and has the same bytes on any rank. Throws Error(internal) if the ray tracer cannot
/// be set up. Source: ambient occlusion, Zhukov, Iones, Kronin 1998; rays by Embree (Wald et al. 2014).
Image shape_picture(const PictureMesh& mesh, const View& view, const PictureOptions& options);

}  // namespace coseg
