#pragma once
// Turns the shapes of a collection into one frame by the links between their patches.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solvers/subspace/coefficients.hpp"
#include "src/parallel/comm.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

struct AlignmentInput {
    const SparseCoefficients& coefficients;  ///< columns owned by this rank
    const Eigen::Matrix3Xd& positions;  ///< 3 x N, see patch_positions; like the rest, the same on all ranks
    const std::vector<int>& mesh_of;    ///< mesh 0 .. M-1 of all patches, ascending
    const std::vector<double>& patch_area;  ///< of all patches
    std::vector<std::uint64_t> mesh_keys;   ///< M, hashes of the names
    std::uint64_t seed = 1;
};

/// How much better links agree, as a ratio, where a shape is mirrored or all are turned.
inline constexpr double clearly_better = 7.0 / 6.0;
/// Likewise where a single shape is turned among others that stand alike.
inline constexpr double outlier_gain = 2.0;
/// Below this share of the agreement that others have, the links of a shape say nothing of how it stands.
inline constexpr double enough_of_others = 0.5;

/// The pose of every shape in a frame in which linked patches lie as near to each other as can be.
///
/// A shape stands like the others where its links agree as well (to .9) as it stands in its file as in the
/// best of 23 turns by right angles and 40 hashed ones. Where half of the shapes do, all stay but the
/// outliers: those whose links agree at least twice as well when they are turned, and then at least half as
/// well as those of the median shape. In three rounds each outlier is fitted against the others from 24
/// hashed starts. There are no poses where there is no outlier, where there are less than two shapes or no
/// links, and where turning all does not make the links agree clearly better (by a sixth).
///
/// Otherwise there are three beginnings: the eigenvectors of the moments of pairs (spectral_rotations.hpp),
/// and twice pairs of shapes that are fitted from 24 hashed starts (rotation_fit.hpp) and chained along a
/// spanning tree (rotation_chain.hpp). The one that leads farthest in two rounds goes on: each shape is
/// fitted again, several times and from other starts too, against all that it has links to. A shape is
/// reflected if its links then agree better by a sixth. A shape of which the links agree little is turned to
/// where its patches lie like those of the others, if they do not yet (place_fit.hpp). Scale and translation
/// are found last.
/// common_frame.hpp chooses the axes. A shape of which the links agree less than half as well as those of the
/// median shape is not found: its pose is a guess.
///
/// A shape is worked on by one rank, which holds its links to ten others; beside these a rank holds the poses
/// of all shapes, and at the beginnings sums over the links of ten pairs a shape. The result has the same
/// bits on any number of ranks. Collective.
///
/// Source: generalised Procrustes analysis, Gower 1975; its rotations, Kabsch 1976; iteratively reweighted
/// least squares with the weights of Dennis and Welsch 1978.
/// Deviates: this is not in the paper, which draws shapes as they stand in their files.
ShapeAlignment align_shapes(const Comm& comm, const AlignmentInput& input);

/// Whether most shapes stand alike in their files, so that only outliers are turned.
bool shapes_stand_alike(const ShapeAlignment& alignment);

/// The positions of the patches of one shape, 3 x n, turned as its pose says; see the next.
Eigen::Matrix3Xd turned_positions(const ShapePose& pose, const Eigen::Matrix3Xd& positions);

/// The positions of all patches, each turned as the pose of its shape says; without scale and translation, so
/// that they keep the centre and the unit of patch_positions. Patches of a shape that is not found are all at
/// the centre: a wrong pose would draw them to the wrong parts. linked_positions does better.
Eigen::Matrix3Xd turned_positions(const ShapeAlignment& alignment, const Eigen::Matrix3Xd& positions,
                                  const std::vector<int>& mesh_of);

}  // namespace coseg
