#pragma once
// Randomness that is a function of what it is for, and never of the rank or of the order of calls.

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <string_view>

namespace coseg {

/// splitmix64's mixing step (Steele, Lea, Flood 2014): a bijection of 64-bit words whose outputs pass
/// statistical tests.
constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

/// A hash of several words, e.g. hash_words({seed, mesh, patch}); the order of words matters.
constexpr std::uint64_t hash_words(std::initializer_list<std::uint64_t> words) noexcept {
    std::uint64_t h = 0x243f6a8885a308d3ULL;
    for (const std::uint64_t w : words) h = mix_bits(h ^ w);
    return h;
}

/// A hash of text, for example of a mesh's name. A mesh thus keeps its randomness in every collection.
constexpr std::uint64_t hash_text(std::string_view text) noexcept {
    std::uint64_t h = 0x13198a2e03707344ULL;
    for (const char c : text) h = mix_bits(h ^ static_cast<unsigned char>(c));
    return h;
}

/// Uniform in [0, 1).
constexpr double uniform_of(std::uint64_t hash) noexcept {
    return static_cast<double>(hash >> 11U) * 0x1.0p-53;
}

/// Standard normal (Box and Muller 1958).
inline double normal_of(std::uint64_t hash) noexcept {
    const double u = 1.0 - uniform_of(mix_bits(hash));
    const double v = uniform_of(mix_bits(hash ^ 0xa4093822299f31d0ULL));
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

/// A stream of such numbers, a UniformRandomBitGenerator for the standard library. Distributions of the
/// standard library differ between implementations; prefer uniform() and normal() where bytes must agree.
class SeededStream {
  public:
    using result_type = std::uint64_t;
    explicit SeededStream(std::uint64_t seed) noexcept : state_(seed) {}
    static constexpr result_type min() noexcept { return 0; }
    static constexpr result_type max() noexcept { return ~std::uint64_t{0}; }
    result_type operator()() noexcept { return mix_bits(state_++ * 0x2545f4914f6cdd1dULL); }
    double uniform() noexcept { return uniform_of((*this)()); }
    double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }
    double normal() noexcept { return normal_of((*this)()); }

  private:
    std::uint64_t state_;
};

}  // namespace coseg
