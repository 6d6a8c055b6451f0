#pragma once
// Computes the shape diameter: how thick the solid is behind a face.

#include <Eigen/Core>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

inline constexpr int shape_diameter_rays = 30;  ///< a face

/// The rays of a face: unit directions in its frame (3 x 30; the third axis is the inward normal), and the
/// angle of each to that axis in radians. They lie on ten rings, of equal areas of a disc of 60 degrees. Each
/// ring has three rays, a third of a turn apart, and is turned against the ring before.
struct RayCone {
    Eigen::Matrix3Xd directions;
    Eigen::VectorXd angles;
};
RayCone shape_diameter_cone();

/// The thickness of every face, F values >= 0, in the unit of the mesh. It is the mean of the 30 ray lengths
/// weighted by 1 / angle, without those that differ from the median by more than one standard deviation. It
/// is 0 where no ray meets the surface from inside (open meshes) and for faces without area. A slab of
/// thickness t has about 1.3 t. geometry = face_geometry(mesh). Rays start at the centroid. The frame is
/// turned by the mean direction of the three edges. This direction is defined up to a third of a turn, and so
/// is the cone; values therefore depend neither on the order of corners nor on the orientation in space. In a
/// tangle, where a line meets the bounding boxes of more than 128 triangles on average, rays are cast from
/// every second, third, ... face only, so that time grows with the number of faces; the others have 0.
Eigen::VectorXd shape_diameter_raw(const TriMesh& mesh, const FaceGeometry& geometry);

/// The shape diameter of every face, in [0, 1]. It is computed in three steps: the thickness; three rounds of
/// means over a face and its neighbours across mesh edges; and log(4 x + 1) / log 5 of x = (s - min s) / (max
/// s - min s) over the mesh. Faces without a thickness take the mean of their neighbours', spreading from the
/// known ones (over virtual edges too). All values are 0 if the thickness is the same everywhere, to 1e-4, or
/// known nowhere.
///
/// Source: Shapira, Shamir, Cohen-Or 2008, "Consistent mesh partitioning and skeletonisation using the shape
/// diameter function", section 3.
///
/// Deviates: directions are fixed instead of random, and plain means replace smoothing that respects
/// features.
Eigen::VectorXd shape_diameter(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph);

}  // namespace coseg
