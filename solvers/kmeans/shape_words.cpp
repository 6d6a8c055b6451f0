#include "solvers/kmeans/shape_words.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>

#include "solvers/kmeans/lloyd.hpp"
#include "solvers/kmeans/word_search.hpp"
#include "solvers/kmeans/word_seeds.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/histograms/hashed_sample.hpp"

namespace coseg {

namespace {

void check_contexts(const std::vector<ShapeWordInput>& local, int words) {
    if (words < 1)
        throw Error(ExitCode::internal, "at least one shape word is needed, not " + std::to_string(words));
    for (const ShapeWordInput& mesh : local) {
        for (Eigen::Index f = 0; f < mesh.context->cols(); ++f) {
            if (mesh.context->col(f).allFinite()) continue;
            throw Error(ExitCode::input, "the shape context of face " + std::to_string(f) +
                                             " is not finite; check the mesh for extreme coordinates");
        }
    }
}

/// The number of entries of a shape context in the whole collection; 0 if there is no mesh.
Eigen::Index agreed_dimension(const Comm& comm, const std::vector<ShapeWordInput>& local) {
    std::int64_t largest = 0;
    for (const ShapeWordInput& mesh : local) largest = std::max<std::int64_t>(largest, mesh.context->rows());
    const Eigen::Index dims = all_max(comm, largest);
    agree(comm, [&] {
        for (const ShapeWordInput& mesh : local) {
            if (mesh.context->rows() == dims) continue;
            throw Error(ExitCode::internal, "shape contexts of one collection have " +
                                                std::to_string(mesh.context->rows()) + " and " +
                                                std::to_string(dims) + " entries");
        }
    });
    return dims;
}

/// Per mesh of this rank the contexts of its faces in the sample, d x n, and their face numbers.
struct LocalSample {
    std::vector<Eigen::MatrixXf> points;
    std::vector<std::vector<int>> faces;
};

LocalSample sample_of(const Comm& comm, const std::vector<ShapeWordInput>& local, std::uint64_t seed) {
    std::int64_t faces = 0;
    for (const ShapeWordInput& mesh : local) faces += mesh.context->cols();
    const double share = sampling_share(word_sample_faces, all_sum(comm, faces));
    LocalSample sample;
    for (const ShapeWordInput& mesh : local) {
        const auto chosen = hashed_sample(seed, mesh.mesh_key, static_cast<int>(mesh.context->cols()), share);
        Eigen::MatrixXf points(mesh.context->rows(), static_cast<Eigen::Index>(chosen.size()));
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            points.col(static_cast<Eigen::Index>(i)) = mesh.context->col(chosen[i]);
        }
        sample.points.push_back(std::move(points));
        sample.faces.push_back(chosen);
    }
    return sample;
}

struct SampledFace {
    std::int64_t mesh_key;
    std::int64_t face;
    const double* context;
};

/// The samples of all ranks as rows (n x d), ordered by mesh key and face.
Eigen::MatrixXf gather_in_canonical_order(const Comm& comm, const std::vector<ShapeWordInput>& local,
                                          const LocalSample& sample, Eigen::Index dims) {
    std::vector<std::int64_t> numbers;
    std::vector<double> entries;
    for (std::size_t m = 0; m < local.size(); ++m) {
        for (const int face : sample.faces[m]) {
            numbers.insert(numbers.end(), {static_cast<std::int64_t>(local[m].mesh_key), face});
        }
        for (const float entry : sample.points[m].reshaped()) entries.push_back(static_cast<double>(entry));
    }
    numbers = all_gather(comm, std::span<const std::int64_t>(numbers));
    entries = all_gather(comm, std::span<const double>(entries));
    std::vector<SampledFace> sampled;
    for (std::size_t i = 0; 2 * i < numbers.size(); ++i) {
        sampled.push_back(
            {numbers[2 * i], numbers[2 * i + 1], entries.data() + static_cast<Eigen::Index>(i) * dims});
    }
    std::sort(sampled.begin(), sampled.end(), [&](const SampledFace& x, const SampledFace& y) {
        if (x.mesh_key != y.mesh_key) return x.mesh_key < y.mesh_key;
        if (x.face != y.face) return x.face < y.face;
        return std::lexicographical_compare(x.context, x.context + dims, y.context, y.context + dims);
    });
    Eigen::MatrixXf rows(static_cast<Eigen::Index>(sampled.size()), dims);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const double* context = sampled[at(i)].context;
        for (Eigen::Index d = 0; d < dims; ++d) rows(i, d) = static_cast<float>(context[d]);
    }
    return rows;
}

/// rank_of[w]: the place of word w among all words in lexicographic order of their centres.
std::vector<int> canonical_numbers(const Eigen::MatrixXf& words) {
    const Eigen::Index dims = words.rows();
    std::vector<int> order(at(words.cols()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        const float* x = words.data() + a * dims;
        const float* y = words.data() + b * dims;
        return std::lexicographical_compare(x, x + dims, y, y + dims);
    });
    std::vector<int> rank_of(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) rank_of[at(order[i])] = static_cast<int>(i);
    return rank_of;
}

}  // namespace

std::vector<std::vector<int>> shape_words(const Comm& comm, const std::vector<ShapeWordInput>& local,
                                          int words, std::uint64_t seed, Eigen::MatrixXf* canonical) {
    agree(comm, [&] { check_contexts(local, words); });
    const Eigen::Index dims = agreed_dimension(comm, local);
    const LocalSample sample = sample_of(comm, local, seed);
    Eigen::MatrixXf centres =
        word_seeds(gather_in_canonical_order(comm, local, sample, dims), words, mix_bits(seed));
    if (canonical != nullptr) *canonical = centres;
    if (centres.cols() == 0) return std::vector<std::vector<int>>(local.size());

    std::vector<WordedPoints> sampled;
    for (const Eigen::MatrixXf& points : sample.points) sampled.push_back({&points, {}});
    lloyd_rounds(comm, sampled, word_sample_rounds, centres);
    std::vector<WordedPoints> all;
    for (const ShapeWordInput& mesh : local) all.push_back({mesh.context, {}});
    lloyd_rounds(comm, all, word_rounds, centres);

    const std::vector<int> number = canonical_numbers(centres);
    std::vector<std::vector<int>> word_of_face;
    for (WordedPoints& mesh : all) {
        for (int& word : mesh.word) word = number[at(word)];
        word_of_face.push_back(std::move(mesh.word));
    }
    for (Eigen::Index w = 0; canonical != nullptr && w < centres.cols(); ++w)
        canonical->col(number[at(w)]) = centres.col(w);
    return word_of_face;
}

std::vector<int> words_of(const Eigen::MatrixXf& context, const Eigen::MatrixXf& centres) {
    check_contexts({{0, &context}}, 1);
    if (context.rows() != centres.rows() || centres.cols() == 0) {
        throw Error(ExitCode::internal, "shape contexts of " + std::to_string(context.rows()) +
                                            " entries, but words of " + std::to_string(centres.rows()));
    }
    std::vector<int> columns(at(context.cols()));
    std::iota(columns.begin(), columns.end(), 0);
    std::vector<NearestWord> nearest(columns.size());
    WordSearch(centres).search(context, columns, nearest);
    std::vector<int> words;
    for (const NearestWord& found : nearest) words.push_back(found.word);
    return words;
}

}  // namespace coseg
