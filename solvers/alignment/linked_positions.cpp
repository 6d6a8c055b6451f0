#include "solvers/alignment/linked_positions.hpp"

#include <algorithm>
#include <span>

#include "solvers/alignment/shape_alignment.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Of the patches of this rank's columns whose shapes are not found, in ascending order; three coordinates
/// each.
std::vector<double> means_of_links(const SparseCoefficients& coefficients, const std::vector<char>& is_found,
                                   const Eigen::Matrix3Xd& turned) {
    const std::vector<double> norms = pair_norms(coefficients);
    std::vector<double> means;
    for (std::int64_t c = 0; c < coefficients.columns.size(); ++c) {
        if (is_found[at(coefficients.columns.begin + c)] != 0) continue;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double total = 0.0;
        for (auto e = at(coefficients.offsets[at(c)]); e < at(coefficients.offsets[at(c) + 1]); ++e) {
            const int other = coefficients.rows[e];
            if (is_found[at(other)] == 0) continue;
            sum += norms[e] * turned.col(other);
            total += norms[e];
        }
        if (total > 0.0) sum /= total;
        means.insert(means.end(), sum.data(), sum.data() + 3);
    }
    return means;
}

}  // namespace

Eigen::Matrix3Xd linked_positions(const Comm& comm, const ShapeAlignment& alignment,
                                  const SparseCoefficients& coefficients, const Eigen::Matrix3Xd& positions,
                                  const std::vector<int>& mesh_of) {
    Eigen::Matrix3Xd turned = turned_positions(alignment, positions, mesh_of);
    const bool all_found = std::all_of(alignment.shapes.begin(), alignment.shapes.end(),
                                       [](const ShapePose& pose) { return pose.found; });
    if (!alignment.applied() || all_found) return turned;
    std::vector<char> is_found;
    for (const int mesh : mesh_of) is_found.push_back(alignment.shapes[at(mesh)].found ? 1 : 0);
    const std::vector<double> means =
        all_gather(comm, std::span<const double>(means_of_links(coefficients, is_found, turned)));
    auto next = means.begin();
    for (std::size_t p = 0; p < is_found.size(); ++p) {
        if (is_found[p] != 0) continue;
        turned.col(static_cast<Eigen::Index>(p)) = Eigen::Vector3d(next[0], next[1], next[2]);
        next += 3;
    }
    return turned;
}

}  // namespace coseg
