#pragma once
// Joins borders that nearly touch, as charts of a texture or pieces of a scan do after a change of precision.

#include <vector>

#include "src/mesh/polygon_mesh.hpp"

namespace coseg {

struct BorderWelding {
    std::vector<int> vertex_of;  ///< per vertex the lowest vertex that stands for it
    int welded = 0;              ///< vertices that got another stand-in than before
};

/// Takes vertices together whose distance is at most 1e-5 of the diagonal of the mesh's bounding box and at
/// most 1e-3 of the shortest border edge at either. Only whole border edges are joined: both ends of an edge
/// must be that near to the ends of exactly one other border edge, which runs the other way. A gap between
/// surfaces stays, unless it is narrower than both limits and its sides match edge by edge. vertex_of: the
/// stand-ins found so far (vertex_welding.hpp); borders are those that remain after it. Where more than 16
/// border vertices lie within the limit, they are left alone. Time: O(n log n).
BorderWelding weld_near_borders(const PolygonMesh& mesh, std::vector<int> vertex_of);

}  // namespace coseg
