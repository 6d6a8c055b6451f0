#include "solvers/subspace/group_shrinkage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "src/base/index.hpp"

namespace coseg {

namespace {

/// v becomes max(v - shift, 0); returns its norm.
double clip_group(std::span<double> v, double shift) noexcept {
    double squares = 0.0;
    for (double& value : v) {
        value = std::max(value - shift, 0.0);
        squares += value * value;
    }
    return std::sqrt(squares);
}

/// v becomes v (1 - shift / norm)_+; returns the new norm.
double shorten_group(std::span<double> v, double norm, double shift) noexcept {
    const double scale = norm > shift ? 1.0 - shift / norm : 0.0;
    for (double& value : v) value *= scale;
    return scale * norm;
}

/// The sum of the norms after shrinkage, s = sum_i (b_i - 2 step lambda s)_+, for b sorted in descending
/// order: the largest k for which b_k still exceeds the shrinkage that k norms cause.
double sum_after_shrinkage(std::span<const double> sorted, double shrink_per_sum) noexcept {
    double total = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        if (sorted[k] <= shrink_per_sum * sum) break;
        total += sorted[k];
        sum = total / (1.0 + shrink_per_sum * static_cast<double>(k + 1));
    }
    return sum;
}

}  // namespace

double shrink_group(std::span<double> v, double step, double alpha, double beta) noexcept {
    const double norm = clip_group(v, step * beta);
    return shorten_group(v, norm, step * alpha);
}

double exclusive_shrink(std::span<double> v, int features, double step, const ColumnPenalties& penalties,
                        ExclusiveShrinkScratch& scratch) {
    const double clipped = step * penalties.beta;
    const double shortened = step * penalties.alpha;
    const auto width = at(features);
    const std::size_t pairs = v.size() / width;
    scratch.norm.resize(pairs);
    scratch.sorted.clear();
    for (std::size_t p = 0; p < pairs; ++p) {
        scratch.norm[p] = clip_group(v.subspan(p * width, width), clipped);
        if (scratch.norm[p] > shortened) scratch.sorted.push_back(scratch.norm[p] - shortened);
    }
    std::sort(scratch.sorted.begin(), scratch.sorted.end(), std::greater<>());
    const double shrink_per_sum = 2.0 * step * penalties.lambda;
    const double shift = shortened + shrink_per_sum * sum_after_shrinkage(scratch.sorted, shrink_per_sum);
    double sum = 0.0;
    for (std::size_t p = 0; p < pairs; ++p) {
        sum += shorten_group(v.subspan(p * width, width), scratch.norm[p], shift);
    }
    return sum;
}

}  // namespace coseg
