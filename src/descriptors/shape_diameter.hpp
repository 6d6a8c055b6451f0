#pragma once
// The shape diameter: how thick the solid is behind a face.

#include <Eigen/Core>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

inline constexpr int shape_diameter_rays = 30;  ///< a face

/// The rays of a face: unit directions in its frame (3 x 30; the third axis is the inward normal), and each
/// one's angle to that axis, in radians. Ten rings, equal areas of a disc of 60 degrees, each of three rays a
/// third of a turn apart and turned against the one before.
struct RayCone {
    Eigen::Matrix3Xd directions;
    Eigen::VectorXd angles;
};
RayCone shape_diameter_cone();

/// Thickness per face, F values >= 0, in the unit of the mesh: mean of the 30 ray lengths weighted by 1 /
/// angle, without those further than one standard deviation from the median. 0 where no ray meets the surface
/// from inside (open meshes) and for faces without area. A slab of thickness t has about 1.3 t. geometry =
/// face_geometry(mesh). Rays start at the centroid. The frame is turned by the mean direction of the three
/// edges, which is defined up to a third of a turn, as the cone is: values depend neither on the order of
/// corners nor on the orientation in space.
Eigen::VectorXd shape_diameter_raw(const TriMesh& mesh, const FaceGeometry& geometry);

/// Shape diameter per face, in [0, 1]: thickness, three rounds of means over a face and its neighbours across
/// mesh edges, then log(4 x + 1) / log 5 of x = (s - min s) / (max s - min s) over the mesh. Faces without a
/// thickness take the mean of their neighbours', spreading from the known ones (over virtual edges too). All
/// 0 if the thickness is the same everywhere, to 1e-4, or known nowhere. Source: Shapira, Shamir, Cohen-Or
/// 2008, "Consistent mesh partitioning and skeletonisation using the shape diameter function", section 3.
/// Deviates: fixed directions in place of random ones; plain means in place of smoothing that respects
/// features.
Eigen::VectorXd shape_diameter(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph);

}  // namespace coseg
