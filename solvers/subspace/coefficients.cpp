#include "solvers/subspace/coefficients.hpp"

#include <cmath>
#include <iterator>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

std::vector<std::int64_t> column_lengths(const SparseCoefficients& w) {
    std::vector<std::int64_t> lengths;
    for (std::size_t c = 0; c + 1 < w.offsets.size(); ++c) lengths.push_back(w.offsets[c + 1] - w.offsets[c]);
    return lengths;
}

/// `gather` joins the values of ranks.
template <class Gather>
SparseCoefficients joined(const SparseCoefficients& local, Gather&& gather) {
    SparseCoefficients all;
    all.size = local.size;
    all.features = local.features;
    all.offsets = {0};
    for (const std::int64_t length : gather(column_lengths(local)))
        all.offsets.push_back(all.offsets.back() + length);
    all.columns.end = std::ssize(all.offsets) - 1;
    all.rows = gather(local.rows);
    all.values = gather(local.values);
    return all;
}

}  // namespace

SparseCoefficients all_gathered(const Comm& comm, const SparseCoefficients& local) {
    return joined(local, [&]<class T>(const std::vector<T>& values) {
        return all_gather(comm, std::span<const T>(values));
    });
}

SparseCoefficients gathered(const Comm& comm, const SparseCoefficients& local) {
    return joined(local, [&]<class T>(const std::vector<T>& values) {
        return gather(comm, std::span<const T>(values));
    });
}

std::vector<double> pair_norms(const SparseCoefficients& coefficients) {
    const auto features = at(coefficients.features);
    std::vector<double> norms(coefficients.rows.size());
    for (std::size_t k = 0; k < norms.size(); ++k) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features; ++h) {
            const double w = coefficients.values[k * features + h];
            squares += w * w;
        }
        norms[k] = std::sqrt(squares);
    }
    return norms;
}

}  // namespace coseg
