#pragma once
// Lloyd's rounds of k-means over points that are spread over the ranks mesh by mesh.

#include <Eigen/Core>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

/// Points of one mesh and the word of each.
struct WordedPoints {
    const Eigen::MatrixXf* points = nullptr;  ///< d x n, column major
    std::vector<int> word;                    ///< n; filled by lloyd_rounds
};

/// Assigns every point to its nearest word, then up to `rounds` times moves each word to the mean of its
/// points (a word without points stays where it is) and assigns again, until no point changes. words (d x K,
/// K >= 1, the same on every rank) are changed in place. Every mesh is summed on its own and the meshes in
/// fixed point, so the result has the same bits on any number of ranks. Collective.
void lloyd_rounds(const Comm& comm, std::vector<WordedPoints>& local, int rounds, Eigen::MatrixXf& words);

}  // namespace coseg
