#include "solvers/partition/labelled_parts.hpp"

#include <numeric>

#include "src/base/index.hpp"
#include "src/metrics/assignment.hpp"

namespace coseg {

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

std::vector<int> named_parts(const Eigen::MatrixXd& scores, const std::vector<int>& part_of_patch,
                             const std::vector<double>& weight) {
    Eigen::MatrixXd gain = Eigen::MatrixXd::Zero(scores.rows(), scores.rows());
    for (std::size_t i = 0; i < part_of_patch.size(); ++i)
        gain.row(part_of_patch[i]) += weight[i] * scores.col(static_cast<Eigen::Index>(i)).transpose();
    const std::vector<int> label_of_part = best_assignment(gain);
    std::vector<int> labels;
    for (const int part : part_of_patch) labels.push_back(label_of_part[at(part)]);
    return labels;
}

KnownParts known_parts(const Eigen::MatrixXd& scores, const ExampleLabels& examples,
                       const std::vector<double>& patch_area, const ExampleWeights& weights) {
    KnownParts known{known_labels(examples, patch_area), scores};
    const double total = std::accumulate(patch_area.begin(), patch_area.end(), 0.0);
    for (Eigen::Index i = 0; i < known.gain.cols(); ++i)
        known.gain.col(i) *= weights.scores * patch_area[at(i)] / total;
    return known;
}

double gain_of(const KnownParts& known, const std::vector<int>& labels) {
    double gain = 0.0;
    for (std::size_t i = 0; i < labels.size() && known.gain.size() > 0; ++i)
        gain += known.gain(labels[i], static_cast<Eigen::Index>(i));
    return gain;
}

}  // namespace coseg
