#pragma once
// Makes one rotation for each shape of rotations between pairs of shapes.

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// How shape `from` is turned to stand like shape `to`.
struct PairRotation {
    int from = 0;
    int to = 0;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    double agreement = 0.0;  ///< see rotation_fit.hpp
    static constexpr auto fields() {
        return std::tuple(field("from", &PairRotation::from), field("to", &PairRotation::to),
                          field("rotation", &PairRotation::rotation),
                          field("agreement", &PairRotation::agreement));
    }
};

struct ChainedRotations {
    std::vector<Eigen::Matrix3d> rotations;  ///< of each shape into the frame of the root; else the identity
    std::vector<bool> reached;
};

/// Follows the spanning tree of largest agreement from the shape whose pairs agree best. A mean over all
/// pairs, as in spectral synchronisation, will not do: pairs of symmetric shapes, such as two tables, have
/// several rotations that are equally good, and their mean is none of these. Along a tree any of them is as
/// good.
/// Source: Prim 1957.
ChainedRotations chained_rotations(int shapes, const std::vector<PairRotation>& pairs);

}  // namespace coseg
