#pragma once
// Boundaries between the parts of one mesh moved into the creases nearby.

#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

struct FuzzyCutOptions {
    int strip_width = 10;         ///< triangles to either side of a boundary that may change sides, >= 0
    double convex_weight = 0.15;  ///< eta of convex edges, > 0; concave ones have 1
};

/// Capacity per dual edge: length / mean length / (1 + ang / mean ang), ang = eta (1 - cos a), a the angle
/// between the two normals, eta 1 on concave edges and convex_weight on convex ones; small across creases. A
/// virtual edge has capacity 0: where no surface is shared there is nothing to cut. The means are over the
/// real edges of the mesh.
std::vector<double> fuzzy_cut_capacities(const DualGraph& graph, const FuzzyCutOptions& options);

/// Sum of the capacities between faces of different labels.
double boundary_capacity(const DualGraph& graph, const std::vector<double>& capacity,
                         const std::vector<int>& label);

/// For each pair of labels a < b that share edges, in ascending order, with the labels as the pairs before
/// left them: the faces of a and b within `strip_width` triangles of their common boundary may change between
/// a and b, by the minimum cut that separates the faces of a beyond the strip from those of b beyond it. Only
/// faces within `strip_width` triangles of another label, and in the outer half (by that distance) of their
/// connected region of one label, move at all: a region keeps its core and never vanishes. boundary_capacity
/// never rises. Throws Error(usage) for options out of range.
///
/// Source: Katz and Tal 2003, "Hierarchical mesh decomposition using fuzzy clustering and cuts" (capacities).
///
/// Deviates: the strip is a number of triangles and not the faces of uncertain probability; it ends half way
/// through thin regions; all pairs of labels are cut one after the other. Capacities are times the edge's
/// length: without it the cut counts triangles and runs through the coarse ones. Without holding costs a
/// strip of 10 triangles takes boundaries off their place wherever a shorter one is near (see docs/method.md,
/// section 8).
///
/// `holding` (empty, or per face >= 0, in units of capacity): what it costs a face to leave the label it came
/// with, see holding_costs. The sum of boundary_capacity and these costs never rises.
std::vector<int> fuzzy_cut(const DualGraph& graph, const std::vector<int>& label,
                           const FuzzyCutOptions& options = {}, const std::vector<double>& holding = {});

/// Costs that grow with the distance d of a face to the nearest boundary of its label, over the surface: to
/// carry a boundary of length l over a distance x costs l (x / reach)^2, so that it goes no farther than
/// `reach` even into the deepest crease and stays where no crease is near. Units: those of
/// fuzzy_cut_capacities. reach > 0, in the mesh's unit.
std::vector<double> holding_costs(const DualGraph& graph, const FaceGeometry& geometry,
                                  const std::vector<int>& label, double reach);

}  // namespace coseg
