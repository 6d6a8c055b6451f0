#pragma once
// Makes one rotation for each shape of moments between pairs of shapes, all at once.

#include <Eigen/Core>
#include <cstdint>
#include <tuple>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// Of the links of shape `from` to shape `to`: the sum of weight * x * y^T, where x is a patch of `from` and
/// y one of `to`.
struct PairMoment {
    int from = 0;
    int to = 0;
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    static constexpr auto fields() {
        return std::tuple(field("from", &PairMoment::from), field("to", &PairMoment::to),
                          field("moment", &PairMoment::moment));
    }
};

/// Rotations R that make the sum over the pairs of trace(R_from moment R_to^T) large: the three largest
/// eigenvectors of the block matrix of the moments have a block of 3 x 3 for each shape, and its rotation is
/// the nearest one. An axis that all links know, such as the vertical one of tables, comes out well even
/// where nothing is known of the others. Serial. `seed` begins the iteration.
/// Source: Singer 2011, angular synchronisation by eigenvectors.
std::vector<Eigen::Matrix3d> spectral_rotations(int shapes, const std::vector<PairMoment>& moments,
                                                std::uint64_t seed);

}  // namespace coseg
