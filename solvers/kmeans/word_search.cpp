#include "solvers/kmeans/word_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solvers/numeric/blas.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

constexpr Eigen::Index block_points = 128;

float square_norm(const float* x, Eigen::Index size) {
    float sum = 0.0F;
    for (Eigen::Index d = 0; d < size; ++d) sum += x[d] * x[d];
    return sum;
}

/// Per point of a block: the smallest and second smallest of ||c||^2 - 2 x.c, and where the smallest is.
struct BlockMinima {
    std::array<float, block_points> smallest;
    std::array<float, block_points> second;
    std::array<int, block_points> word;
};

/// inner_products: block_points x K, column major.
COSEG_VECTOR_CLONES void find_minima(const Eigen::MatrixXf& inner_products,
                                     const Eigen::VectorXf& square_norms, BlockMinima& minima) {
    minima.smallest.fill(std::numeric_limits<float>::infinity());
    minima.second.fill(std::numeric_limits<float>::infinity());
    minima.word.fill(0);
    for (int w = 0; w < square_norms.size(); ++w) {
        const float* inner = inner_products.data() + w * block_points;
        const float norm = square_norms[w];
        for (std::size_t i = 0; i < block_points; ++i) {
            const float value = norm - 2.0F * inner[i];
            const float smallest = minima.smallest[i];
            const float loser = value < smallest ? smallest : value;
            minima.second[i] = loser < minima.second[i] ? loser : minima.second[i];
            minima.word[i] = value < smallest ? w : minima.word[i];
            minima.smallest[i] = value < smallest ? value : smallest;
        }
    }
}

}  // namespace

WordSearch::WordSearch(const Eigen::MatrixXf& words) : words_(words), square_norms_(words.cols()) {
    for (Eigen::Index w = 0; w < words_.cols(); ++w) {
        square_norms_[w] = square_norm(words_.data() + w * words_.rows(), words_.rows());
        largest_square_norm_ = std::max(largest_square_norm_, square_norms_[w]);
    }
}

void WordSearch::search(const Eigen::MatrixXf& points, std::span<const int> columns,
                        std::vector<NearestWord>& nearest) const {
    nearest.resize(columns.size());
    const Eigen::Index dims = words_.rows();
    Eigen::MatrixXf block = Eigen::MatrixXf::Zero(dims, block_points);
    Eigen::MatrixXf inner_products(block_points, words_.cols());
    BlockMinima minima{};
    const auto total = static_cast<Eigen::Index>(columns.size());
    for (Eigen::Index begin = 0; begin < total; begin += block_points) {
        const Eigen::Index count = std::min(block_points, total - begin);
        for (Eigen::Index i = 0; i < count; ++i) block.col(i) = points.col(columns[at(begin + i)]);
        multiply_transposed(whole(std::as_const(block)), whole(words_), 0.0F, whole(inner_products));
        find_minima(inner_products, square_norms_, minima);
        for (Eigen::Index i = 0; i < count; ++i) {
            const auto k = at(i);
            const float norm = square_norm(block.data() + i * dims, dims);
            // What rounding of the three terms may hide, so that second_distance stays a bound.
            const float rounding = 4e-6F * (norm + largest_square_norm_);
            nearest[at(begin + i)] = {minima.word[k], std::sqrt(std::max(0.0F, norm + minima.smallest[k])),
                                      std::sqrt(std::max(0.0F, norm + minima.second[k] - rounding))};
        }
    }
}

float WordSearch::distance(const Eigen::MatrixXf& points, int column, int word) const {
    const float* x = points.data() + column * points.rows();
    const float* c = words_.data() + word * words_.rows();
    std::array<float, 4> sums{};
    const Eigen::Index size = words_.rows();
    const Eigen::Index whole = size - size % 4;
    for (Eigen::Index d = 0; d < whole; d += 4) {
        for (std::size_t l = 0; l < 4; ++l) {
            const float difference =
                x[d + static_cast<Eigen::Index>(l)] - c[d + static_cast<Eigen::Index>(l)];
            sums[l] += difference * difference;
        }
    }
    for (Eigen::Index d = whole; d < size; ++d) sums[0] += (x[d] - c[d]) * (x[d] - c[d]);
    return std::sqrt((sums[0] + sums[1]) + (sums[2] + sums[3]));
}

}  // namespace coseg
