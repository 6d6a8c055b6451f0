#pragma once
// Moves boundaries between the parts of one mesh into creases nearby.

#include <Eigen/Core>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

struct FuzzyCutOptions {
    int strip_width = 10;         ///< triangles to either side of a boundary that may change sides, >= 0
    double convex_weight = 0.15;  ///< eta of convex edges, > 0; concave ones have 1
};

/// The capacity of each dual edge: length / mean length / (1 + ang / mean ang), with ang = eta (1 - cos a),
/// where a is the angle between the two normals and eta is 1 on concave edges and convex_weight on convex
/// ones. It is small across creases. A virtual edge has capacity 0, since no surface is cut there. The means
/// are over the real edges of the mesh.
std::vector<double> fuzzy_cut_capacities(const DualGraph& graph, const FuzzyCutOptions& options);

/// The sum of the capacities between faces of different labels.
double boundary_capacity(const DualGraph& graph, const std::vector<double>& capacity,
                         const std::vector<int>& label);

/// Treats every pair of labels a < b that share edges, in ascending order, with the labels that the pairs
/// before have left. The faces of a and b within `strip_width` triangles of their common boundary may change
/// between a and b, by the minimum cut that separates the faces of a beyond the strip from those of b beyond
/// it. Faces that may change must also lie in the outer half of their connected region of one label, measured
/// by their distance to another label; a region thus keeps its core and never vanishes. boundary_capacity
/// never rises. Throws Error(usage) for options out of range.
///
/// `costs` is empty or labels x F, in units of capacity: what each label costs each face (see holding_costs
/// and score_costs). The sum of boundary_capacity and of the costs of the faces' labels never rises.
///
/// Source: Katz and Tal 2003, "Hierarchical mesh decomposition using fuzzy clustering and cuts"
/// (capacities).
///
/// Deviates: the strip is a number of triangles and not the faces of uncertain probability, it ends half
/// way through thin regions, and all pairs of labels are cut one after the other. Capacities are multiplied
/// by the edge's length; without it the cut would count triangles and run through the coarse ones. Without
/// costs a strip of 10 triangles moves boundaries wherever a shorter one is near (see docs/method.md,
/// section 8).
std::vector<int> fuzzy_cut(const DualGraph& graph, const std::vector<int>& label,
                           const FuzzyCutOptions& options = {}, const Eigen::MatrixXd& costs = {});

/// labels x F: for each face the cost of leaving its label for any other, which grows with the distance d of
/// the face to the nearest boundary of its label over the surface. To move a boundary of length l over a
/// distance x costs l (x / reach)^2. A boundary thus goes no farther than `reach` even into the deepest
/// crease, and stays where no crease is near. The unit is that of fuzzy_cut_capacities. reach > 0, in the
/// mesh's unit.
Eigen::MatrixXd holding_costs(const DualGraph& graph, const FaceGeometry& geometry,
                              const std::vector<int>& label, int labels, double reach);

/// labels x F: minus the mean of `scores` (labels x F) over the area, in the unit of fuzzy_cut_capacities: a
/// boundary of length l costs as much as a share of l / sqrt(area of the mesh) of the area that has a label
/// whose score is lower by 1.
Eigen::MatrixXd score_costs(const DualGraph& graph, const FaceGeometry& geometry,
                            const Eigen::MatrixXd& scores);

}  // namespace coseg
