#include "solvers/kmeans/word_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solvers/numeric/pair_score_kernel.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"

namespace coseg {

namespace {

float square_norm(const float* x, Eigen::Index size) {
    float sum = 0.0F;
    for (Eigen::Index d = 0; d < size; ++d) sum += x[d] * x[d];
    return sum;
}

/// Per point of a panel: the smallest and second smallest of ||c||^2 - 2 x.c, and where the smallest is.
struct PanelMinima {
    std::array<float, panel_rows> smallest;
    std::array<float, panel_rows> second;
    std::array<int, panel_rows> word;
};

/// inner_products: panel_rows x K, column major.
COSEG_VECTOR_CLONES void find_minima(const float* inner_products, const Eigen::VectorXf& square_norms,
                                     PanelMinima& minima) {
    minima.smallest.fill(std::numeric_limits<float>::infinity());
    minima.second.fill(std::numeric_limits<float>::infinity());
    minima.word.fill(0);
    for (int w = 0; w < square_norms.size(); ++w) {
        const float* inner = inner_products + static_cast<std::ptrdiff_t>(w) * panel_rows;
        const float norm = square_norms[w];
        for (std::size_t i = 0; i < panel_rows; ++i) {
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
    pack_words();
}

void WordSearch::pack_words() {
    const Eigen::Index dims = words_.rows();
    const Eigen::Index groups = (words_.cols() + group_columns - 1) / group_columns;
    word_groups_.assign(at(groups * group_columns * dims), 0.0F);
    for (Eigen::Index w = 0; w < words_.cols(); ++w) {
        float* to =
            column_in_groups(word_groups_.data(), static_cast<int>(w), static_cast<int>(words_.rows()));
        for (Eigen::Index d = 0; d < dims; ++d) to[d * group_columns] = words_(d, w);
    }
}

void WordSearch::search(const Eigen::MatrixXf& points, std::span<const int> columns,
                        std::vector<NearestWord>& nearest) const {
    nearest.resize(columns.size());
    const auto dims = static_cast<int>(words_.rows());
    const auto groups = static_cast<int>(word_groups_.size()) / (group_columns * std::max(dims, 1));
    std::vector<float> panel(at(dims * panel_rows), 0.0F);
    std::vector<float> inner_products(at(groups * group_columns * panel_rows));
    std::vector<float> excess(inner_products.size());
    const std::vector<float> no_prices(panel_rows, std::numeric_limits<float>::max());
    const std::vector<float> no_errors(at(groups * group_columns), 0.0F);
    PanelMinima minima{};
    for (std::size_t begin = 0; begin < columns.size(); begin += panel_rows) {
        const std::size_t count = std::min(columns.size() - begin, std::size_t{panel_rows});
        for (std::size_t i = 0; i < count; ++i) {
            const float* x = points.data() + static_cast<std::ptrdiff_t>(columns[begin + i]) * dims;
            for (int d = 0; d < dims; ++d) panel[at(d * panel_rows) + i] = x[d];
        }
        score_pairs({panel.data(), no_prices.data(), static_cast<int>(count)},
                    {word_groups_.data(), no_errors.data(), groups}, dims,
                    {inner_products.data(), excess.data()});
        find_minima(inner_products.data(), square_norms_, minima);
        for (std::size_t i = 0; i < count; ++i) {
            const float* x = points.data() + static_cast<std::ptrdiff_t>(columns[begin + i]) * dims;
            const float norm = square_norm(x, dims);
            // What rounding of the three terms may hide, so that second_distance stays a bound.
            const float rounding = 4e-6F * (norm + largest_square_norm_);
            nearest[begin + i] = {minima.word[i], std::sqrt(std::max(0.0F, norm + minima.smallest[i])),
                                  std::sqrt(std::max(0.0F, norm + minima.second[i] - rounding))};
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
