#pragma once
// Measures of the parts of one shape, in the unit of its file.

#include <Eigen/Core>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "src/measures/oriented_box.hpp"
#include "src/measures/part_borders.hpp"
#include "src/mesh/tri_mesh.hpp"
#include "src/records/fields.hpp"

namespace coseg {

struct PartMeasures {
    int part = 0;
    double area = 0.0;
    double share = 0.0;  ///< of the area of the shape
    int pieces = 0;      ///< connected by edges
    /// What the part encloses once its borders with other parts are closed, each by triangles to the middle
    /// of the border: exact for borders in a plane, else an estimate. Nothing if the surface ends in the
    /// part.
    std::optional<double> volume;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< of the surface
    OrientedBox box;
    std::vector<std::pair<int, double>> borders;  ///< (other part, length of the border with it), ascending
    static constexpr auto fields() {
        return std::tuple(field("part", &PartMeasures::part), field("area", &PartMeasures::area),
                          field("share", &PartMeasures::share), field("pieces", &PartMeasures::pieces),
                          field("volume", &PartMeasures::volume), field("centroid", &PartMeasures::centroid),
                          field("box", &PartMeasures::box), field("borders", &PartMeasures::borders));
    }
};

/// The parts that have faces, ascending. part_of_face: F numbers of at least 0. curves: part_borders of the
/// same. The box is the smallest across the normals of the part's 32 largest planes (oriented_box.hpp).
std::vector<PartMeasures> part_measures(const TriMesh& mesh, const std::vector<int>& part_of_face,
                                        const std::vector<BorderCurve>& curves);

}  // namespace coseg
