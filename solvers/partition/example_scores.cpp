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

/// The examples, one a column.
struct Training {
    Eigen::MatrixXd x;  ///< (2 D + 3) x n: features, those of the neighbourhood, places
    Eigen::MatrixXd y;  ///< K x n: shares of the said area
    Eigen::VectorXd weight;
};

Training training_set(const Features& features, const std::vector<std::vector<WeightedNeighbor>>& neighbors,
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
        for (const WeightedNeighbor& near : neighbors[at(i)])
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
                          const std::vector<std::vector<WeightedNeighbor>>& neighbors,
                          const Eigen::Matrix3Xd& places) {
    const Eigen::Index d = features.rows();
    Eigen::MatrixXd scores = fit.slope.leftCols(d) * features;
    const Eigen::MatrixXd as_neighbor = fit.slope.middleCols(d, d) * features;
    const Eigen::VectorXd constant = fit.mean_y - fit.slope * fit.mean_x;
    for (Eigen::Index i = 0; i < scores.cols(); ++i) {
        for (const WeightedNeighbor& near : neighbors[at(i)])
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

void hold_known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area,
                       Eigen::MatrixXd& scores) {
    const std::vector<int> known = known_labels(examples, patch_area);
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] < 0) continue;
        scores.col(static_cast<Eigen::Index>(i)).setZero();
        scores(known[i], static_cast<Eigen::Index>(i)) = 1.0;
    }
}

Eigen::MatrixXd example_scores(const ScoreInput& input, const ExampleLabels& examples) {
    const Features features(input.features.data(), input.features.dimension(), input.features.columns());
    const auto neighbors = weighted_neighbors(input.neighbors, static_cast<int>(features.cols()));
    const Eigen::Matrix3Xd places = correlated_places(input.frame, input.positions, features.cols());
    const LinearScore fit = fitted(training_set(features, neighbors, places, examples));
    Eigen::MatrixXd scores = predicted(fit, features, neighbors, places);
    const Eigen::Index labels = scores.rows();
    for (Eigen::Index label = 0; label < labels; ++label) {
        if (examples.area.row(label).sum() <= 0.0)
            scores.row(label).setConstant(1.0 / static_cast<double>(labels));
    }
    hold_known_labels(examples, input.patch_area, scores);
    return scores;
}

}  // namespace coseg
