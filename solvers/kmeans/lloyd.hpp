#pragma once
// Runs Lloyd's rounds of k-means over points that are spread over the ranks mesh by mesh.

#include <Eigen/Core>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

/// The points of one mesh and the word of each.
struct WordedPoints {
    const Eigen::MatrixXf* points = nullptr;  ///< d x n, column major
    std::vector<int> word;                    ///< n; filled by lloyd_rounds
};

/// Assigns every point to its nearest word. Then, up to `rounds` times, moves each word to the mean of its
/// points and assigns again, until no point changes. A word without points stays where it is. words (d x K,
/// K >= 1, the same on every rank) are changed in place. Every mesh is summed on its own, and the meshes are
/// added in fixed point, so that the result has the same bits on any number of ranks. Collective.
void lloyd_rounds(const Comm& comm, std::vector<WordedPoints>& local, int rounds, Eigen::MatrixXf& words);

}  // namespace coseg
