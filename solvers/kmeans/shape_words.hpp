#pragma once
// Finds the shape words: groups the shape contexts of all faces of all meshes into a common vocabulary.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

/// The shape contexts of one mesh of this rank.
struct ShapeWordInput {
    std::uint64_t mesh_key = 0;                ///< hash_text(name), different for each mesh of the collection
    const Eigen::MatrixXf* context = nullptr;  ///< d x F, column major, the same d for all meshes; finite
};

/// The number of faces of the whole collection on which the first rounds run.
inline constexpr std::int64_t word_sample_faces = 30'000;
inline constexpr int word_sample_rounds = 30;  ///< at most, on that sample
inline constexpr int word_rounds = 10;         ///< at most, on all faces

/// For every face of every mesh of this rank its word, 0 .. words-1. K-means runs over all faces of the
/// collection: k-means++ seeds and first rounds on a hashed sample, then rounds over all faces until no face
/// changes its word or word_rounds have passed. Words are numbered by their centres in lexicographic order.
/// With fewer distinct contexts than words, each context has a word of its own and the other words stay
/// unused; a word that loses its faces may stay unused too. Ranks without meshes take part. The words depend
/// on the meshes, their keys and the seed, not on the number of ranks or on which rank holds which mesh.
/// canonical (may be null) receives the centres, d x words in the order of the numbers, for words_of. Throws
/// AgreedError(internal) if words < 1 or the d differ, AgreedError(input) if a context is not finite.
/// Collective.
///
/// Source: Hu, Fan, Liu 2012 after Kalogerakis, Hertzmann, Singh 2010; rounds: Lloyd 1982 with the bounds
/// of Hamerly 2010, which save searches but change no answer.
std::vector<std::vector<int>> shape_words(const Comm& comm, const std::vector<ShapeWordInput>& local,
                                          int words, std::uint64_t seed,
                                          Eigen::MatrixXf* canonical = nullptr);

/// For every face of `context` (d x F) the nearest of given words. Throws Error(input) if a context is not
/// finite, Error(internal) if the d differ. Serial.
std::vector<int> words_of(const Eigen::MatrixXf& context, const Eigen::MatrixXf& centres);

}  // namespace coseg
