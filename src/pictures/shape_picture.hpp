#pragma once
// The picture of one shape: rays, soft light, no display.

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

/// Draws the shape from `view`, as large as the picture holds, under one soft lamp over the eye's left shoulder
/// and an even sky: 4 rays a pixel for edges, 16 a pixel for the sky's occlusion and the lamp's shadow, smoothed over pixels
/// of one surface. Both sides of a face show. Perspective is mild: the eye stands 8 radii away.
/// Serial, starts no threads; a function of its arguments alone: the same bytes on any rank.
/// Throws Error(internal) if the ray tracer cannot be set up.
/// Source: ambient occlusion, Zhukov, Iones, Kronin 1998; rays by Embree (Wald et al. 2014).
Image shape_picture(const PictureMesh& mesh, const View& view, const PictureOptions& options);

}  // namespace coseg
