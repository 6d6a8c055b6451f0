#pragma once
// Finds the nearest of a few hundred words (centres of clusters) for many points.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace coseg {

struct NearestWord {
    int word = 0;                  ///< the lowest number among words at the same distance
    float distance = 0.0F;         ///< Euclidean, to that word
    float second_distance = 0.0F;  ///< not above the distance to any other word; infinity if there is none
};

/// Searches one set of words in single precision, by inner products (pair_score_kernel.hpp). The result for a
/// point depends on the point and on the words only.
class WordSearch {
  public:
    /// words: d x K, column major, K >= 1.
    explicit WordSearch(const Eigen::MatrixXf& words);

    /// The nearest words of the listed columns of `points` (d x n, column major); nearest[i] belongs to
    /// columns[i].
    void search(const Eigen::MatrixXf& points, std::span<const int> columns,
                std::vector<NearestWord>& nearest) const;

    /// Euclidean distance of one column to one word, by differences (0 for equal vectors).
    [[nodiscard]] float distance(const Eigen::MatrixXf& points, int column, int word) const;

  private:
    void pack_words();

    Eigen::MatrixXf words_;
    std::vector<float> word_groups_;  ///< the words in groups of columns, as the kernel reads them
    Eigen::VectorXf square_norms_;
    float largest_square_norm_ = 0.0F;
};

}  // namespace coseg
