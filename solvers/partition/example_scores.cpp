#include "solvers/partition/example_scores.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "solvers/affinity/position_correlation.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double ridge = 1.0;

using Features = Eigen::Map<const Eigen::MatrixXd>;

struct Neighbor {
    int patch = 0;
    double weight = 0.0;  ///< the weights of a patch sum to 1
};

std::vector<std::vector<Neighbor>> weighted_neighbors(const std::vector<GlobalPatchNeighbors>& pairs,
                                                      Eigen::Index patches) {
    std::vector<std::vector<Neighbor>> of(at(patches));
    for (const GlobalPatchNeighbors& pair : pairs) {
        of[at(pair.patch_a)].push_back({pair.patch_b, pair.boundary_length});
        of[at(pair.patch_b)].push_back({pair.patch_a, pair.boundary_length});
    }
    for (std::vector<Neighbor>& neighbors : of) {
        double sum = 0.0;
        for (const Neighbor& n : neighbors) sum += n.weight;
        for (Neighbor& n : neighbors) n.weight = sum > 0.0 ? n.weight / sum : 0.0;
    }
    return of;
}

Eigen::Matrix3Xd places_of(const ScoreInput& input) {
    if (input.positions == nullptr) return Eigen::Matrix3Xd::Zero(3, input.features.columns());
    return correlated_places(input.frame, *input.positions);
}

/// The examples, one a column.
struct Training {
    Eigen::MatrixXd x;  ///< (2 D + 3) x n: features, those of the neighbourhood, places
    Eigen::MatrixXd y;  ///< K x n: shares of the said area
    Eigen::VectorXd weight;
};

Training training_set(const Features& features, const std::vector<std::vector<Neighbor>>& neighbors,
                      const Eigen::Matrix3Xd& places, const ExampleLabels& examples) {
    std::vector<Eigen::Index> said;
    for (Eigen::Index i = 0; i < examples.area.cols(); ++i) {
        if (examples.area.col(i).sum() > 0.0) said.push_back(i);
    }
    if (said.empty()) throw Error(ExitCode::input, "the examples say nothing of any patch");
    const Eigen::Index d = features.rows();
    const auto n = static_cast<Eigen::Index>(said.size());
    Training set{Eigen::MatrixXd::Zero(2 * d + 3, n), Eigen::MatrixXd(examples.area.rows(), n),
                 Eigen::VectorXd(n)};
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index i = said[at(k)];
        set.x.col(k).head(d) = features.col(i);
        for (const Neighbor& near : neighbors[at(i)])
            set.x.col(k).segment(d, d) += near.weight * features.col(near.patch);
        set.x.col(k).tail<3>() = places.col(i);
        set.weight(k) = examples.area.col(i).sum();
        set.y.col(k) = examples.area.col(i) / set.weight(k);
    }
    set.weight *= static_cast<double>(n) / set.weight.sum();
    return set;
}

/// score = slope (x - mean_x) + mean_y.
struct LinearScore {
    Eigen::MatrixXd slope;  ///< K x (2 D + 3)
    Eigen::VectorXd mean_x;
    Eigen::VectorXd mean_y;
};

/// Solved in the space of the examples or of the features, whichever is smaller.
LinearScore fitted(const Training& set) {
    LinearScore fit;
    const double sum = set.weight.sum();
    fit.mean_x = set.x * set.weight / sum;
    fit.mean_y = set.y * set.weight / sum;
    const Eigen::RowVectorXd root = set.weight.cwiseSqrt().transpose();
    const Eigen::MatrixXd x = (set.x.colwise() - fit.mean_x).array().rowwise() * root.array();
    const Eigen::MatrixXd y = (set.y.colwise() - fit.mean_y).array().rowwise() * root.array();
    const bool by_example = x.cols() < x.rows();
    Eigen::MatrixXd gram =
        by_example ? Eigen::MatrixXd(x.transpose() * x) : Eigen::MatrixXd(x * x.transpose());
    gram.diagonal().array() += ridge;
    const Eigen::LLT<Eigen::MatrixXd> factor(gram);
    fit.slope = by_example ? Eigen::MatrixXd(factor.solve(y.transpose()).transpose() * x.transpose())
                           : Eigen::MatrixXd(factor.solve(x * y.transpose()).transpose());
    return fit;
}

/// K x N, from the scores of the features alone and of the neighbourhoods alone, so that no rank holds the
/// features of the neighbourhoods of all patches.
Eigen::MatrixXd predicted(const LinearScore& fit, const Features& features,
                          const std::vector<std::vector<Neighbor>>& neighbors,
                          const Eigen::Matrix3Xd& places) {
    const Eigen::Index d = features.rows();
    Eigen::MatrixXd scores = fit.slope.leftCols(d) * features;
    const Eigen::MatrixXd as_neighbor = fit.slope.middleCols(d, d) * features;
    const Eigen::VectorXd constant = fit.mean_y - fit.slope * fit.mean_x;
    for (Eigen::Index i = 0; i < scores.cols(); ++i) {
        for (const Neighbor& near : neighbors[at(i)])
            scores.col(i) += near.weight * as_neighbor.col(near.patch);
        scores.col(i) += fit.slope.rightCols<3>() * places.col(i) + constant;
    }
    return scores;
}

}  // namespace

std::vector<int> known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area) {
    std::vector<int> labels(patch_area.size(), -1);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto said = examples.area.col(static_cast<Eigen::Index>(i));
        if (said.sum() <= 0.0 || 2.0 * said.sum() < patch_area[i]) continue;
        Eigen::Index label = 0;
        said.maxCoeff(&label);
        labels[i] = static_cast<int>(label);
    }
    return labels;
}

Eigen::MatrixXd example_scores(const ScoreInput& input, const ExampleLabels& examples) {
    const Features features(input.features.data(), input.features.dimension(), input.features.columns());
    const auto neighbors = weighted_neighbors(input.neighbors, features.cols());
    const Eigen::Matrix3Xd places = places_of(input);
    const LinearScore fit = fitted(training_set(features, neighbors, places, examples));
    Eigen::MatrixXd scores = predicted(fit, features, neighbors, places);
    const std::vector<int> known = known_labels(examples, input.patch_area);
    const Eigen::Index labels = scores.rows();
    for (Eigen::Index label = 0; label < labels; ++label) {
        if (examples.area.row(label).sum() <= 0.0)
            scores.row(label).setConstant(1.0 / static_cast<double>(labels));
    }
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] < 0) continue;
        scores.col(static_cast<Eigen::Index>(i)).setZero();
        scores(known[i], static_cast<Eigen::Index>(i)) = 1.0;
    }
    return scores;
}

}  // namespace coseg
