#include "solvers/partition/part_regression.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solvers/affinity/position_correlation.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "src/base/decomposition.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Principal components of the features that are kept. Their number bounds the time of a prediction.
constexpr Eigen::Index components = 96;
/// Shapes of examples that the base counts for.
constexpr double base_shapes = 0.1;
constexpr double regression_ridge = 1.0;
/// Columns that are added up together, so that sums have one order.
constexpr Eigen::Index columns_at_once = 2048;

/// Sums of weighted examples.
struct Moments {
    double weight = 0.0;
    Eigen::VectorXd x;        ///< d
    Eigen::VectorXd y;        ///< K
    Eigen::MatrixXd squares;  ///< d x d, the lower triangle
    Eigen::MatrixXd cross;    ///< K x d
};

void add_base(const Eigen::MatrixXf& features, const std::vector<int>& base,
              const std::vector<double>& weight, double of_base, Moments& m) {
    for (std::size_t i = 0; i < base.size(); ++i) {
        const Eigen::VectorXd x = features.col(static_cast<Eigen::Index>(i)).cast<double>();
        const double w = of_base * weight[i];
        m.weight += w;
        m.x += w * x;
        m.y(base[i]) += w;
        m.cross.row(base[i]) += w * x.transpose();
    }
}

void add_said(const Eigen::MatrixXf& features, const Eigen::MatrixXd& said, Moments& m) {
    std::vector<Eigen::Index> spoken;
    for (Eigen::Index i = 0; i < said.cols(); ++i) {
        const double area = said.col(i).sum();
        if (area <= 0.0) continue;
        const Eigen::VectorXd x = features.col(i).cast<double>();
        spoken.push_back(i);
        m.weight += area;
        m.x += area * x;
        m.y += said.col(i);
        m.cross += said.col(i) * x.transpose();
    }
    if (spoken.empty()) return;
    Eigen::MatrixXd examples(features.rows(), static_cast<Eigen::Index>(spoken.size()));
    for (std::size_t j = 0; j < spoken.size(); ++j)
        examples.col(static_cast<Eigen::Index>(j)) =
            std::sqrt(said.col(spoken[j]).sum()) * features.col(spoken[j]).cast<double>();
    m.squares.selfadjointView<Eigen::Lower>().rankUpdate(examples);
}

LinearScore fitted(Moments m, double ridge) {
    const Eigen::VectorXd mean_x = m.x / m.weight;
    const Eigen::VectorXd mean_y = m.y / m.weight;
    m.squares.selfadjointView<Eigen::Lower>().rankUpdate(mean_x, -m.weight);
    m.squares.diagonal().array() += ridge;
    m.cross -= m.weight * mean_y * mean_x.transpose();
    const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(m.squares);
    LinearScore fit;
    fit.slope =
        succeeded(factor, "the moments of what is said of patches").solve(m.cross.transpose()).transpose();
    fit.constant = mean_y - fit.slope * mean_x;
    return fit;
}

}  // namespace

PatchReduction::PatchReduction(const PatchLooks& looks) : frame_(looks.frame) {
    const SinglePrecisionFeatures::ConstBlock all = looks.features.all();
    mean_ = Eigen::VectorXd::Zero(all.rows());
    double area = 0.0;
    for (Eigen::Index i = 0; i < all.cols(); ++i) {
        mean_ += looks.area[at(i)] * all.col(i).cast<double>();
        area += looks.area[at(i)];
    }
    if (area > 0.0) mean_ /= area;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(all.rows(), all.rows());
    for (Eigen::Index first = 0; first < all.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, all.cols() - first);
        Eigen::MatrixXd block = all.middleCols(first, count).cast<double>().colwise() - mean_;
        for (Eigen::Index i = 0; i < count; ++i) block.col(i) *= std::sqrt(looks.area[at(first + i)]);
        covariance.selfadjointView<Eigen::Lower>().rankUpdate(block);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
    axes_ = succeeded(eigen, "the covariance of the features")
                .eigenvectors()
                .rightCols(std::min(components, all.rows()));
}

Eigen::MatrixXf PatchReduction::operator()(const SinglePrecisionFeatures::ConstBlock& features,
                                           const Eigen::Matrix3Xd* positions,
                                           const std::vector<GlobalPatchNeighbors>& pairs) const {
    const Eigen::Index kept = axes_.cols();
    Eigen::MatrixXf x = Eigen::MatrixXf::Zero(2 * kept + 3, features.cols());
    for (Eigen::Index first = 0; first < features.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, features.cols() - first);
        const Eigen::MatrixXd block = features.middleCols(first, count).cast<double>().colwise() - mean_;
        x.block(0, first, kept, count) = (axes_.transpose() * block).cast<float>();
    }
    const auto neighbors = weighted_neighbors(pairs, static_cast<int>(x.cols()));
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        for (const WeightedNeighbor& near : neighbors[at(i)])
            x.col(i).segment(kept, kept) += static_cast<float>(near.weight) * x.col(near.patch).head(kept);
    }
    x.bottomRows<3>() = correlated_places(frame_, positions, x.cols()).cast<float>();
    return x;
}

Eigen::MatrixXd LinearScore::operator()(const Eigen::MatrixXf& x) const {
    return ((slope.cast<float>() * x).colwise() + constant.cast<float>().eval()).cast<double>();
}

PartRegression::PartRegression(const PatchLooks& looks, const std::vector<GlobalPatchNeighbors>& neighbors,
                               const std::vector<double>& confidence)
    : reduction_(looks),
      patch_area_(looks.area),
      meshes_(looks.mesh_of.empty() ? 0 : 1 + looks.mesh_of.back()),
      x_(reduction_(looks.features.all(), looks.positions, neighbors)) {
    if (x_.cols() != std::ssize(patch_area_))
        throw Error(ExitCode::internal, "the features of a regression of parts are not of all patches");
    for (std::size_t i = 0; i < patch_area_.size(); ++i)
        weight_.push_back(patch_area_[i] * (confidence.empty() ? 1.0 : confidence[i]));
    sum_base();
}

void PartRegression::sum_base() {
    base_squares_ = Eigen::MatrixXd::Zero(x_.rows(), x_.rows());
    for (Eigen::Index first = 0; first < x_.cols(); first += columns_at_once) {
        const Eigen::Index count = std::min(columns_at_once, x_.cols() - first);
        Eigen::MatrixXd block = x_.middleCols(first, count).cast<double>();
        for (Eigen::Index i = 0; i < count; ++i) block.col(i) *= std::sqrt(weight_[at(first + i)]);
        base_squares_.selfadjointView<Eigen::Lower>().rankUpdate(block);
    }
}

LinearScore PartRegression::learnt(const SaidParts& said) const {
    const Eigen::Index d = x_.rows();
    const Eigen::Index k = said.area.rows();
    const double of_base = said.base.empty() ? 0.0 : base_shapes / meshes_;
    Moments moments{0.0, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Zero(k), of_base * base_squares_,
                    Eigen::MatrixXd::Zero(k, d)};
    add_base(x_, said.base, weight_, of_base, moments);
    add_said(x_, said.area, moments);
    if (moments.weight <= 0.0) throw Error(ExitCode::input, "the examples say nothing of any patch");
    // Weights are areas.
    const double patches =
        static_cast<double>(x_.cols()) / std::accumulate(patch_area_.begin(), patch_area_.end(), 0.0);
    return fitted(std::move(moments), regression_ridge / patches);
}

Eigen::MatrixXd PartRegression::scores(const SaidParts& said) const {
    const Eigen::Index k = said.area.rows();
    Eigen::MatrixXd scores = learnt(said)(x_);
    const Eigen::VectorXd of_part = said.area.rowwise().sum();
    const bool has_contrast = (of_part.array() > 0.0).count() > 1;
    for (Eigen::Index part = 0; part < k && said.base.empty(); ++part) {
        if (of_part(part) <= 0.0 || !has_contrast) scores.row(part).setConstant(1.0 / static_cast<double>(k));
    }
    hold_known_labels({said.area}, patch_area_, scores);
    return scores;
}

}  // namespace coseg
