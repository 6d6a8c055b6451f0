#include "solvers/affinity/affinity_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr std::string_view digits = "0123456789abcdefghijklmnopqrstuvwxyz";
constexpr double ticks = 0x1p20;  // of the largest link: whole numbers add up the same in any order

double pair_norm(const SparseCoefficients& coefficients, std::size_t pair) {
    double sum = 0.0;
    for (int h = 0; h < coefficients.features; ++h) {
        const double w = coefficients.values[pair * at(coefficients.features) + at(h)];
        sum += w * w;
    }
    return std::sqrt(sum);
}

/// Per patch its place when sorted by part.
std::vector<int> sorted_places(const std::vector<int>& part_of_patch) {
    std::vector<int> order(part_of_patch.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return part_of_patch[at(a)] < part_of_patch[at(b)]; });
    std::vector<int> places(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) places[at(order[k])] = static_cast<int>(k);
    return places;
}

std::vector<std::int64_t> summed_bins(const Comm& comm, const SparseCoefficients& coefficients,
                                      const std::vector<int>& bin_of_patch, std::size_t bins) {
    std::vector<double> norms;
    double largest = 0.0;
    for (std::size_t pair = 0; pair < coefficients.rows.size(); ++pair) {
        norms.push_back(pair_norm(coefficients, pair));
        largest = std::max(largest, norms.back());
    }
    largest = all_max(comm, largest);
    std::vector<std::int64_t> sums(bins * bins, 0);
    for (std::size_t c = 0; largest > 0.0 && c < at(coefficients.columns.size()); ++c) {
        const auto column = at(bin_of_patch[at(coefficients.columns.begin) + c]);
        for (auto k = at(coefficients.offsets[c]); k < at(coefficients.offsets[c + 1]); ++k) {
            const auto row = at(bin_of_patch[at(coefficients.rows[k])]);
            const std::int64_t link = std::llround(norms[k] / largest * ticks);
            sums[row * bins + column] += link;
            sums[column * bins + row] += link;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_INT64_T, MPI_SUM, comm.raw());
    return sums;
}

}  // namespace

AffinityPicture affinity_picture(const Comm& comm, const SparseCoefficients& coefficients,
                                 const std::vector<int>& part_of_patch, int parts, int most_bins) {
    const auto patches = static_cast<std::int64_t>(part_of_patch.size());
    const auto bins = at(std::min<std::int64_t>(most_bins, patches));
    std::vector<int> bin_of_patch = sorted_places(part_of_patch);
    std::vector<std::int64_t> sizes(bins, 0);
    for (int& place : bin_of_patch) {
        place = static_cast<int>(place * static_cast<std::int64_t>(bins) / patches);
        ++sizes[at(place)];
    }
    const std::vector<std::int64_t> sums = summed_bins(comm, coefficients, bin_of_patch, bins);
    std::vector<double> means(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
        means[i] = static_cast<double>(sums[i]) / static_cast<double>(sizes[i / bins] * sizes[i % bins]);
    const double largest = means.empty() ? 0.0 : *std::max_element(means.begin(), means.end());

    AffinityPicture picture;
    for (std::size_t row = 0; row < bins; ++row) {
        picture.rows.emplace_back();
        for (std::size_t column = 0; column < bins; ++column) {
            const double level = largest > 0.0 ? std::sqrt(means[row * bins + column] / largest) : 0.0;
            picture.rows.back() += digits[at(std::lround(level * 35.0))];
        }
    }
    std::int64_t before = 0;
    for (int part = 0; part < parts; ++part) {
        before += std::count(part_of_patch.begin(), part_of_patch.end(), part);
        picture.part_ends.push_back(static_cast<int>(before * static_cast<std::int64_t>(bins) / patches));
    }
    return picture;
}

}  // namespace coseg
