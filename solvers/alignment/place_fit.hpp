#pragma once
// Finds how a shape is turned from where its patches lie, without links.

#include <Eigen/Core>
#include <vector>

namespace coseg {

/// Patches of one shape or of several.
struct WeighedPlaces {
    Eigen::Matrix3Xd positions;  ///< in the units of patch_positions
    Eigen::VectorXd weight;      ///< > 0, with sum 1
};

struct FittedPlaces {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    /// Mean over the own places, by weight, of log(density of the others + 0.02). The density is a sum of
    /// normal ones of width 0.3 whose peaks are the weights.
    double likelihood = 0.0;
};

/// Rotations that bring the own places to where the others lie densely, the likeliest first. Each of the
/// starts, at least one, is moved in three steps of soft correspondences, of widths from 0.8 to 0.45, and the
/// best quarter goes on for four more, down to 0.3. The own places may move as a whole too, as a stool with
/// long legs has its middle lower than chairs. They are not scaled: any shape would shrink into the densest
/// place. It need not be the other way round: a stool has nothing where others have backs. Serial.
/// Source: the rigid case of Myronenko and Song 2010, coherent point drift.
/// Deviates: the width shrinks in given steps instead of being estimated, so that it never collapses.
std::vector<FittedPlaces> fitted_places(const WeighedPlaces& own, const WeighedPlaces& others,
                                        const std::vector<Eigen::Matrix3d>& starts);

}  // namespace coseg
