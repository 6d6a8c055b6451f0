#include "solvers/partition/corrected_parts.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "solvers/partition/cluster_sums.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/part_confidence.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Principal components of the features that are kept. Their number bounds the time of a correction.
constexpr Eigen::Index components = 96;
/// Shapes of examples that the base counts for.
constexpr double base_shapes = 0.1;
constexpr double base_ridge = 1.0;
/// Rounds of expansions. After the third hardly a patch changes.
constexpr int most_rounds = 4;
/// What a part costs that a mesh may not have: more than all gains and ties together, which are of the order
/// of the score's weights.
constexpr double forbidden = 1e7;
/// Columns that are added up together, so that sums have one order.
constexpr Eigen::Index columns_at_once = 2048;

int part_count(const SaidParts& said) { return static_cast<int>(said.area.rows()); }

/// The part of those that the mesh may have with the best score.
int best_allowed(const SaidParts& said, const Eigen::MatrixXd& scores, Eigen::Index patch, int mesh) {
    int best = -1;
    for (int part = 0; part < part_count(said); ++part) {
        if (said.allowed(part, mesh) == 0) continue;
        if (best < 0 || scores(part, patch) > scores(best, patch)) best = part;
    }
    if (best < 0) throw Error(ExitCode::internal, "a mesh may have none of the parts");
    return best;
}

/// Sums of weighted examples.
struct Moments {
    double weight = 0.0;
    Eigen::VectorXd x;        ///< d
    Eigen::VectorXd y;        ///< K
    Eigen::MatrixXd squares;  ///< d x d, the lower triangle
    Eigen::MatrixXd cross;    ///< K x d
};

}  // namespace

CorrectedParts::CorrectedParts(const Comm& comm, const CutInput& input, const CutOptions& options,
                               std::vector<double> confidence)
    : patch_area_(input.patch_area), mesh_of_(input.mesh_of), weights_(options.examples) {
    const auto patches = static_cast<int>(mesh_of_.size());
    CutGraphs cut = cut_graphs(comm, input, options);
    terms_ = std::move(cut.terms);
    agree(comm, [&] {
        if (input.features == nullptr || input.features->columns() != patches)
            throw Error(ExitCode::internal, "the features of corrected parts are not of all patches");
        for (int i = 0; i < patches; ++i)
            weight_.push_back(patch_area_[at(i)] * (confidence.empty() ? 1.0 : confidence[at(i)]));
        reduce_features(*input.features);
        add_neighborhoods(cut.neighbors);
        x_.bottomRows<3>() = correlated_places(terms_.frame, input.positions, patches).cast<float>();
        sum_base();
        objective_ = partition_objective({cut.neighbors, cut.overlaps, input.descriptors, mesh_of_,
                                          patch_area_, cut.links_count ? &terms_.base : nullptr},
                                         options.choice);
    });
}

/// The first rows of x_.
void CorrectedParts::reduce_features(const FeatureMatrices& features) {
    const Eigen::Map<const Eigen::MatrixXd> all(features.data(), features.dimension(), features.columns());
    const Eigen::Index kept = std::min(components, all.rows());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(all.rows());
    double area = 0.0;
    for (Eigen::Index i = 0; i < all.cols(); ++i) {
        mean += patch_area_[at(i)] * all.col(i);
        area += patch_area_[at(i)];
    }
    if (area > 0.0) mean /= area;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(all.rows(), all.rows());
    for (Eigen::Index first = 0; first < all.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, all.cols() - first);
        Eigen::MatrixXd block = all.middleCols(first, count).colwise() - mean;
        for (Eigen::Index i = 0; i < count; ++i) block.col(i) *= std::sqrt(patch_area_[at(first + i)]);
        covariance.selfadjointView<Eigen::Lower>().rankUpdate(block);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
    const Eigen::MatrixXd axes = eigen.eigenvectors().rightCols(kept);
    x_ = Eigen::MatrixXf::Zero(2 * kept + 3, all.cols());
    for (Eigen::Index first = 0; first < all.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, all.cols() - first);
        const Eigen::MatrixXd block = all.middleCols(first, count).colwise() - mean;
        x_.block(0, first, kept, count) = (axes.transpose() * block).cast<float>();
    }
}

/// The next rows: the mean of the neighbours, weighted by the length of the common boundary.
void CorrectedParts::add_neighborhoods(const std::vector<GlobalPatchNeighbors>& pairs) {
    const Eigen::Index kept = (x_.rows() - 3) / 2;
    const auto neighbors = weighted_neighbors(pairs, static_cast<int>(x_.cols()));
    for (Eigen::Index i = 0; i < x_.cols(); ++i) {
        for (const WeightedNeighbor& near : neighbors[at(i)])
            x_.col(i).segment(kept, kept) += static_cast<float>(near.weight) * x_.col(near.patch).head(kept);
    }
}

void CorrectedParts::sum_base() {
    base_squares_ = Eigen::MatrixXd::Zero(x_.rows(), x_.rows());
    for (Eigen::Index first = 0; first < x_.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, x_.cols() - first);
        Eigen::MatrixXd block = x_.middleCols(first, count).cast<double>();
        for (Eigen::Index i = 0; i < count; ++i) block.col(i) *= std::sqrt(weight_[at(first + i)]);
        base_squares_.selfadjointView<Eigen::Lower>().rankUpdate(block);
    }
}

Eigen::MatrixXd CorrectedParts::scores(const SaidParts& said) const {
    const Eigen::Index d = x_.rows();
    const Eigen::Index k = said.area.rows();
    const auto meshes = static_cast<double>(said.allowed.cols());
    const double of_base = base_shapes / meshes;
    Moments m{0.0, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Zero(k), of_base * base_squares_,
              Eigen::MatrixXd::Zero(k, d)};
    std::vector<Eigen::Index> spoken;
    for (Eigen::Index i = 0; i < x_.cols(); ++i) {
        const Eigen::VectorXd x = x_.col(i).cast<double>();
        const double w = of_base * weight_[at(i)];
        m.weight += w;
        m.x += w * x;
        m.y(said.base[at(i)]) += w;
        m.cross.row(said.base[at(i)]) += w * x.transpose();
        const double area = said.area.col(i).sum();
        if (area <= 0.0) continue;
        spoken.push_back(i);
        m.weight += area;
        m.x += area * x;
        m.y += said.area.col(i);
        m.cross += said.area.col(i) * x.transpose();
    }
    Eigen::MatrixXd examples(d, static_cast<Eigen::Index>(spoken.size()));
    for (std::size_t j = 0; j < spoken.size(); ++j)
        examples.col(static_cast<Eigen::Index>(j)) =
            std::sqrt(said.area.col(spoken[j]).sum()) * x_.col(spoken[j]).cast<double>();
    if (!spoken.empty()) m.squares.selfadjointView<Eigen::Lower>().rankUpdate(examples);
    // Weights are areas; the ridge is 1 where weights sum to the number of patches that they are of.
    const double patches =
        static_cast<double>(x_.cols()) / std::accumulate(patch_area_.begin(), patch_area_.end(), 0.0);
    const Eigen::VectorXd mean_x = m.x / m.weight;
    const Eigen::VectorXd mean_y = m.y / m.weight;
    m.squares.selfadjointView<Eigen::Lower>().rankUpdate(mean_x, -m.weight);
    m.squares.diagonal().array() += base_ridge / patches;
    m.cross -= m.weight * mean_y * mean_x.transpose();
    const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(m.squares);
    const Eigen::MatrixXd slope = factor.solve(m.cross.transpose()).transpose();
    const Eigen::VectorXd constant = mean_y - slope * mean_x;
    Eigen::MatrixXd scores =
        ((slope.cast<float>() * x_).colwise() + constant.cast<float>().eval()).cast<double>();
    hold_known_labels({said.area}, patch_area_, scores);
    return scores;
}

namespace {

/// The value of all parts together, and what is known gains in them.
double value_of(const PartitionObjective& objective, const KnownParts& known, const std::vector<int>& labels,
                int parts) {
    const ClusterSums sums = cluster_sums(objective, labels, parts);
    double value = gain_of(known, labels);
    for (int part = 0; part < parts; ++part) value += value_of_part(sums, std::array{part});
    return value;
}

/// Known parts where there are some; else those of `wanted` where its mesh may have them, and the best of the
/// others elsewhere. Without `wanted`, the best everywhere.
std::vector<int> start_of(const SaidParts& said, const Eigen::MatrixXd& scores, const KnownParts& known,
                          const std::vector<int>& mesh_of, const std::vector<int>* wanted) {
    std::vector<int> labels(mesh_of.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const bool fits = wanted != nullptr && said.allowed((*wanted)[i], mesh_of[i]) != 0;
        if (known.fixed[i] >= 0)
            labels[i] = known.fixed[i];
        else
            labels[i] =
                fits ? (*wanted)[i] : best_allowed(said, scores, static_cast<Eigen::Index>(i), mesh_of[i]);
    }
    return labels;
}

}  // namespace

CorrectedPartition CorrectedParts::corrected(const Comm& comm, const SaidParts& said,
                                             const Eigen::MatrixXd& scores) const {
    const int parts = part_count(said);
    KnownParts known = known_parts(scores, {said.area}, patch_area_, weights_);
    std::vector<std::vector<int>> starts;
    agree(comm, [&] {
        for (std::size_t i = 0; i < mesh_of_.size(); ++i) {
            for (int part = 0; part < parts; ++part) {
                if (said.allowed(part, mesh_of_[i]) == 0)
                    known.gain(part, static_cast<Eigen::Index>(i)) = -forbidden;
            }
            int& fixed = known.fixed[i];
            if (fixed >= 0 && said.allowed(fixed, mesh_of_[i]) == 0) fixed = -1;
        }
        starts.push_back(start_of(said, scores, known, mesh_of_, &said.base));
        starts.push_back(start_of(said, scores, known, mesh_of_, nullptr));
    });
    CorrectedPartition result;
    double best = -std::numeric_limits<double>::infinity();
    for (std::vector<int>& labels : starts) {
        for (int round = 0; round < most_rounds; ++round) {
            std::vector<int> next = expand_parts(comm, objective_, known, labels, parts);
            const bool is_same = next == labels;
            labels = std::move(next);
            if (is_same) break;
        }
        const double value = value_of(objective_, known, labels, parts);
        if (!(value > best)) continue;
        best = value;
        result.parts = std::move(labels);
    }
    result.confidence = part_confidence(objective_, known, result.parts, parts);
    return result;
}

}  // namespace coseg
