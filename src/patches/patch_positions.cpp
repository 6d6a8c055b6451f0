#include "src/patches/patch_positions.hpp"

#include <cmath>
#include <cstddef>

#include "src/patches/mesh_patch_pairs.hpp"

namespace coseg {

Eigen::Matrix3Xd patch_positions(const FaceGeometry& geometry, const std::vector<int>& patch_of_face,
                                 int count) {
    const Eigen::Vector3d centre = surface_centroid(geometry);
    Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, count);
    double squares = 0.0;
    for (std::size_t f = 0; f < patch_of_face.size(); ++f) {
        const auto face = static_cast<Eigen::Index>(f);
        const Eigen::Vector3d offset = geometry.centroid.col(face) - centre;
        positions.col(patch_of_face[f]) += geometry.area[face] * offset;
        squares += geometry.area[face] * offset.squaredNorm();
    }
    const Eigen::VectorXd area = patch_areas(geometry, patch_of_face, count);
    const double unit = std::sqrt(squares / (3.0 * geometry.total_area));
    for (int p = 0; p < count; ++p)
        positions.col(p) *= area[p] > 0.0 && unit > 0.0 ? 1.0 / (area[p] * unit) : 0.0;
    return positions;
}

}  // namespace coseg
