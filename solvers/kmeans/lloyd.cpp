#include "solvers/kmeans/lloyd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "solvers/kmeans/word_search.hpp"
#include "src/base/index.hpp"
#include "src/base/vector_clones.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

/// How far each word moved in a round, and bounds that follow from it.
struct WordMoves {
    std::vector<float> distance;
    float largest = 0.0F;
    float second_largest = 0.0F;
    int farthest = -1;
};

WordMoves moves_between(const Eigen::MatrixXf& before, const Eigen::MatrixXf& after) {
    WordMoves moves;
    const WordSearch from(before);
    for (int w = 0; w < static_cast<int>(after.cols()); ++w) {
        const float moved = from.distance(after, w, w);
        moves.distance.push_back(moved);
        if (moved > moves.largest || moves.farthest < 0) {
            moves.second_largest = moves.largest;
            moves.largest = moved;
            moves.farthest = w;
        } else {
            moves.second_largest = std::max(moves.second_largest, moved);
        }
    }
    return moves;
}

/// Adds each point (dims x n) and a one to the sums of its word (dims + 1 x K).
COSEG_VECTOR_CLONES void add_points(const float* points, std::span<const int> word, Eigen::Index dims,
                                    double* sums) {
    for (std::size_t i = 0; i < word.size(); ++i) {
        const float* x = points + static_cast<Eigen::Index>(i) * dims;
        double* sum = sums + word[i] * (dims + 1);
        for (Eigen::Index d = 0; d < dims; ++d) sum[d] += static_cast<double>(x[d]);
        sum[dims] += 1.0;
    }
}

/// The words of one mesh's points and a lower bound of each point's distance to all other words.
class MeshAssignment {
  public:
    explicit MeshAssignment(WordedPoints& mesh) : mesh_(mesh), others_(at(mesh.points->cols()), 0.0F) {
        mesh_.word.assign(others_.size(), 0);
    }

    /// Every point to its nearest word.
    void assign_all(const WordSearch& search) {
        active_.resize(others_.size());
        std::iota(active_.begin(), active_.end(), 0);
        search_active(search);
    }

    /// The same after the words moved, searching only where another word may have become nearer. Returns the
    /// number of points that changed their word.
    std::int64_t assign_moved(const WordSearch& search, const WordMoves& moves) {
        active_.clear();
        for (std::size_t i = 0; i < others_.size(); ++i) {
            const int word = mesh_.word[i];
            others_[i] -= word == moves.farthest ? moves.second_largest : moves.largest;
            const float own = search.distance(*mesh_.points, static_cast<int>(i), word);
            if (!(own * (1.0F + 1e-5F) < others_[i])) active_.push_back(static_cast<int>(i));
        }
        return search_active(search);
    }

    /// Adds the sum of the points of each word (d x K) and their numbers (K), each rounded to a multiple of
    /// `unit`, to totals[0 .. (d + 1) K).
    void add_sums(Eigen::Index words, double unit, ExactSum& totals) const {
        const Eigen::Index dims = mesh_.points->rows();
        Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(dims + 1, words);
        add_points(mesh_.points->data(), mesh_.word, dims, sums.data());
        for (Eigen::Index k = 0; k < sums.size(); ++k)
            totals.add_field(at(k), std::round(sums.data()[k] / unit) * unit);
    }

  private:
    std::int64_t search_active(const WordSearch& search) {
        search.search(*mesh_.points, active_, nearest_);
        std::int64_t changed = 0;
        for (std::size_t k = 0; k < active_.size(); ++k) {
            const auto i = at(active_[k]);
            if (mesh_.word[i] != nearest_[k].word) ++changed;
            mesh_.word[i] = nearest_[k].word;
            others_[i] = nearest_[k].second_distance;
        }
        return changed;
    }

    WordedPoints& mesh_;
    std::vector<float> others_;
    std::vector<int> active_;
    std::vector<NearestWord> nearest_;
};

/// Bounds of every entry of the sums over one mesh and over all of them, the same on all ranks.
struct SumBounds {
    double of_a_mesh = 0.0;
    double of_all = 0.0;
};

SumBounds bounds_of_sums(const Comm& comm, const std::vector<WordedPoints>& local) {
    double points = 1.0;
    double largest = 1.0;
    for (const WordedPoints& mesh : local) {
        if (mesh.points->size() == 0) continue;
        points = std::max(points, static_cast<double>(mesh.points->cols()));
        largest = std::max(largest, static_cast<double>(mesh.points->cwiseAbs().maxCoeff()));
    }
    const double of_a_mesh = all_max(comm, points) * all_max(comm, largest);
    return {of_a_mesh, of_a_mesh * static_cast<double>(all_sum(comm, std::ssize(local)))};
}

void move_to_means(const Comm& comm, const std::vector<MeshAssignment>& meshes, const SumBounds& bounds,
                   Eigen::MatrixXf& words) {
    const Eigen::Index dims = words.rows();
    // Rounding each mesh's sums to this unit, a power of two, is far below the single precision of the words,
    // but their last bits rest on it, and with them the labels of every earlier run.
    const double unit = std::ldexp(1.0, std::ilogb(bounds.of_a_mesh) + 1 - 40);
    ExactSum totals(at((dims + 1) * words.cols()), bounds.of_all, 0);
    for (const MeshAssignment& mesh : meshes) mesh.add_sums(words.cols(), unit, totals);
    totals.reduce(comm);
    const std::vector<double>& sums = totals.field();
    for (Eigen::Index w = 0; w < words.cols(); ++w) {
        const double* sum = sums.data() + w * (dims + 1);
        if (!(sum[dims] > 0.0)) continue;
        for (Eigen::Index d = 0; d < dims; ++d) words(d, w) = static_cast<float>(sum[d] / sum[dims]);
    }
}

}  // namespace

void lloyd_rounds(const Comm& comm, std::vector<WordedPoints>& local, int rounds, Eigen::MatrixXf& words) {
    std::vector<MeshAssignment> meshes;
    meshes.reserve(local.size());
    const WordSearch start(words);
    for (WordedPoints& mesh : local) meshes.emplace_back(mesh).assign_all(start);
    const SumBounds bounds = bounds_of_sums(comm, local);
    for (int round = 0; round < rounds; ++round) {
        const Eigen::MatrixXf before = words;
        move_to_means(comm, meshes, bounds, words);
        const WordMoves moves = moves_between(before, words);
        const WordSearch search(words);
        std::int64_t changed = 0;
        for (MeshAssignment& mesh : meshes) changed += mesh.assign_moved(search, moves);
        if (all_sum(comm, changed) == 0) return;
    }
}

}  // namespace coseg
