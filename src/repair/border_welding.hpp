#pragma once
// Joins borders that nearly touch, as charts of a texture or pieces of a scan do after a change of precision.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"
#include "src/repair/border_matching.hpp"

namespace coseg {

/// Nothing is welded within a tolerance.
inline constexpr BorderLimits no_border_welding{.of_size = 0.0, .of_edge = 0.0, .must_continue = true};

/// Welding within a share of the diagonal that somebody has asked for. Beyond a quarter of the edges there a
/// gap is geometry at any tolerance.
constexpr BorderLimits border_welding_within(double share_of_size) {
    return {.of_size = share_of_size, .of_edge = 0.25, .must_continue = true};
}

struct BorderWelding {
    std::vector<int> vertex_of;  ///< per vertex the lowest vertex that stands for it
    int welded = 0;              ///< vertices that got another stand-in than before
};

/// Takes vertices of borders together that are near by the limits. Only whole border edges are joined: both
/// ends of an edge must be near the ends of exactly one other border edge. With the standard limits, 1e-5 of
/// the diagonal and 1e-3 of the edges, these must run in opposite directions. A gap between surfaces stays,
/// unless it is narrower than both limits and its sides match edge by edge. vertex_of: the stand-ins found so
/// far (vertex_welding.hpp); borders are those that remain after it.
BorderWelding weld_near_borders(const PolygonMesh& mesh, std::vector<int> vertex_of,
                                const BorderLimits& limits = {});

/// Borders that are apart by a small distance, so that they may be meant to be one.
struct NearBorders {
    int pieces = 0;         ///< that faces joined by edges form, and that have such a border
    double distance = 0.0;  ///< the largest between ends that match, as a share of the diagonal
};

/// Finds what border_welding_within(1e-3) would still join after vertex_of.
NearBorders near_borders(const PolygonMesh& mesh, const std::vector<int>& vertex_of);

}  // namespace coseg
