#pragma once
// Areas, centroids and normals of faces, and the normalisation that makes descriptors independent of scale.

#include <Eigen/Core>
#include <tuple>

#include "src/mesh/tri_mesh.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct FaceGeometry {
    Eigen::VectorXd area;       ///< F, >= 0
    Eigen::Matrix3Xd centroid;  ///< 3 x F
    double total_area = 0.0;
    static constexpr auto fields() {
        return std::tuple(field("area", &FaceGeometry::area), field("centroid", &FaceGeometry::centroid),
                          field("total_area", &FaceGeometry::total_area));
    }
};

FaceGeometry face_geometry(const TriMesh& mesh);

/// 3 x F: unit length, outward; zero for a face without area. They are no part of FaceGeometry, because a
/// collection keeps that of every mesh until its labels are written, and nothing after the descriptors looks
/// at normals.
Eigen::Matrix3Xd face_normals(const TriMesh& mesh);

/// The centroid of the surface. Its total area must be positive.
Eigen::Vector3d surface_centroid(const FaceGeometry& geometry);

/// Moves the area-weighted centroid to the origin and scales to total area 1.
/// Throws Error(input) if the mesh has no area.
void scale_to_unit_area(TriMesh& mesh);

}  // namespace coseg
