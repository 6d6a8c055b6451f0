#include "solvers/choice/partition_terms.hpp"

#include <algorithm>

#include "solvers/choice/part_shares.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Histograms weighted by area and summed over the patches of each part in each mesh.
struct HistogramSums {
    Eigen::MatrixXd histograms;  ///< bins x (parts * meshes): column mesh * parts + part
    Eigen::MatrixXd area;        ///< parts x meshes
    double squares = 0.0;        ///< sum over patches of area |x|^2
};

HistogramSums sums_of_parts(const PatchColumns& histograms, const std::vector<int>& labels, int parts,
                            const std::vector<double>& patch_area, const std::vector<int>& mesh_of) {
    const int meshes = mesh_count(mesh_of);
    HistogramSums sums{Eigen::MatrixXd::Zero(histograms.rows(), Eigen::Index{parts} * meshes),
                       Eigen::MatrixXd::Zero(parts, meshes)};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto x = histograms.col(static_cast<Eigen::Index>(i)).cast<double>();
        sums.histograms.col(Eigen::Index{mesh_of[i]} * parts + labels[i]) += patch_area[i] * x;
        sums.area(labels[i], mesh_of[i]) += patch_area[i];
        sums.squares += patch_area[i] * x.squaredNorm();
    }
    return sums;
}

}  // namespace

double boundary_concavity(const std::vector<GlobalPatchNeighbors>& neighbors,
                          const std::vector<int>& labels) {
    double length = 0.0;
    double concave = 0.0;
    for (const GlobalPatchNeighbors& pair : neighbors) {
        if (labels[at(pair.patch_a)] == labels[at(pair.patch_b)]) continue;
        length += pair.boundary_length;
        concave += pair.boundary_length * pair.concavity;
    }
    return length > 0.0 ? concave / length : 0.0;
}

double crease_cost(const GlobalPatchNeighbors& pair) {
    const double flat = 1.0 - std::clamp(pair.concavity, 0.0, 1.0);
    return pair.boundary_length * flat * flat;
}

std::vector<double> overlap_sums(const std::vector<GlobalPatchOverlap>& overlaps, std::size_t patches) {
    std::vector<double> sums(patches, 0.0);
    for (const GlobalPatchOverlap& pair : overlaps) {
        sums[at(pair.patch_a)] += pair.intersection_over_union;
        sums[at(pair.patch_b)] += pair.intersection_over_union;
    }
    return sums;
}

double boundary_crease(const std::vector<GlobalPatchNeighbors>& neighbors, const std::vector<int>& labels,
                       int meshes) {
    double cost = 0.0;
    for (const GlobalPatchNeighbors& pair : neighbors) {
        if (labels[at(pair.patch_a)] == labels[at(pair.patch_b)]) continue;
        cost += crease_cost(pair);
    }
    return -cost / static_cast<double>(meshes);
}

double overlap_agreement(const std::vector<GlobalPatchOverlap>& overlaps, const std::vector<int>& labels,
                         const std::vector<double>& patch_area) {
    const std::vector<double> all = overlap_sums(overlaps, labels.size());
    std::vector<double> own(labels.size(), 0.0);
    for (const GlobalPatchOverlap& pair : overlaps) {
        const auto a = at(pair.patch_a);
        const auto b = at(pair.patch_b);
        if (labels[a] != labels[b]) continue;
        own[a] += pair.intersection_over_union;
        own[b] += pair.intersection_over_union;
    }
    double agreed = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (all[i] <= 0.0) continue;
        agreed += patch_area[i] * (own[i] / all[i]);
        area += patch_area[i];
    }
    return area > 0.0 ? agreed / area : 1.0;
}

double size_steadiness(const Eigen::MatrixXd& shares) {
    double unsteady = 0.0;
    for (Eigen::Index p = 0; p < shares.rows(); ++p) {
        const double mean = shares.row(p).mean();
        if (mean > 0.0) unsteady += (shares.row(p).array() - mean).square().mean() / mean;
    }
    return -unsteady;
}

double links_inside(const SparseRowsView& links, const std::vector<int>& labels) {
    double all = 0.0;
    double inside = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        for (auto k = at(links.offsets[i]); k < at(links.offsets[i + 1]); ++k) {
            all += links.values[k];
            if (labels[at(links.columns[k])] == labels[i]) inside += links.values[k];
        }
    }
    return all > 0.0 ? inside / all : 0.0;
}

BetweenPartVariance between_part_variance(const PatchColumns& histograms, const std::vector<int>& labels,
                                          int parts, const std::vector<double>& patch_area,
                                          const std::vector<int>& mesh_of) {
    const HistogramSums sums = sums_of_parts(histograms, labels, parts, patch_area, mesh_of);
    const Eigen::Index meshes = sums.area.cols();
    Eigen::MatrixXd deviations = Eigen::MatrixXd::Zero(histograms.rows(), parts);
    double of_means = 0.0;
    double per_mesh = 0.0;
    for (Eigen::Index m = 0; m < meshes; ++m) {
        const double area = sums.area.col(m).sum();
        if (!(area > 0.0)) continue;
        const auto of_mesh = sums.histograms.middleCols(m * parts, parts);
        const Eigen::VectorXd mean = of_mesh.rowwise().sum() / area;
        of_means += area * mean.squaredNorm();
        for (int p = 0; p < parts; ++p) {
            const double a = sums.area(p, m);
            if (!(a > 0.0)) continue;
            const Eigen::VectorXd deviation = of_mesh.col(p) - a * mean;
            per_mesh += deviation.squaredNorm() / a;
            deviations.col(p) += deviation;
        }
    }
    const double spread = sums.squares - of_means;
    if (!(spread > 1e-12 * sums.squares)) return {};
    double pooled = 0.0;
    for (int p = 0; p < parts; ++p) {
        const double a = sums.area.row(p).sum();
        if (a > 0.0) pooled += deviations.col(p).squaredNorm() / a;
    }
    return {.pooled = std::clamp(pooled / spread, 0.0, 1.0),
            .per_mesh = std::clamp(per_mesh / spread, 0.0, 1.0)};
}

PartitionTerms partition_terms(const PartitionEvidence& evidence, const std::vector<int>& labels, int parts) {
    const Eigen::MatrixXd shares = area_shares(labels, parts, evidence.patch_area, evidence.mesh_of);
    PartitionTerms terms;
    for (const ChoiceDescriptor& d : evidence.descriptors)
        terms.explained.push_back(
            between_part_variance(d.histograms, labels, parts, evidence.patch_area, evidence.mesh_of));
    terms.crease = boundary_crease(evidence.neighbors, labels, static_cast<int>(shares.cols()));
    terms.overlap = overlap_agreement(evidence.overlaps, labels, evidence.patch_area);
    terms.concavity = boundary_concavity(evidence.neighbors, labels);
    terms.size = size_steadiness(shares);
    if (evidence.links) terms.links = links_inside(*evidence.links, labels);
    return terms;
}

double partition_score(const PartitionTerms& terms, const ChoiceWeights& weights,
                       std::span<const ChoiceDescriptor> descriptors) {
    double score = weights.crease * terms.crease + weights.overlap * terms.overlap +
                   weights.concavity * terms.concavity + weights.size * terms.size +
                   weights.links * terms.links;
    for (std::size_t h = 0; h < descriptors.size(); ++h) {
        score += descriptors[h].weight.pooled * terms.explained[h].pooled;
        score += descriptors[h].weight.per_mesh * terms.explained[h].per_mesh;
    }
    return score;
}

}  // namespace coseg
