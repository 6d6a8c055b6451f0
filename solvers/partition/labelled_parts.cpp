#include "solvers/partition/labelled_parts.hpp"

#include <numeric>
#include <utility>

#include "solvers/choice/cluster_sums.hpp"
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

std::vector<int> labels_of_best_scores(const Eigen::MatrixXd& scores) {
    std::vector<int> labels;
    for (Eigen::Index i = 0; i < scores.cols(); ++i) {
        Eigen::Index best = 0;
        scores.col(i).maxCoeff(&best);
        labels.push_back(static_cast<int>(best));
    }
    return labels;
}

BaseChoice::BaseChoice(const PartitionObjective& objective, const ExampleLabels& examples,
                       Eigen::MatrixXd scores, double gain)
    : objective_(objective),
      known_(known_labels(examples, objective.area)),
      scores_(std::move(scores)),
      gain_(gain) {
    double all = 0.0;
    double known = 0.0;
    for (std::size_t i = 0; i < known_.size(); ++i) {
        all += objective.area[i];
        known += known_[i] >= 0 ? objective.area[i] : 0.0;
    }
    for (std::size_t i = 0; i < known_.size(); ++i)
        weight_.push_back(objective.area[i] * (1.0 / all + (known_[i] >= 0 ? 1.0 / known : 0.0)));
}

bool BaseChoice::offer_parts(const std::vector<int>& part_of_patch) {
    return offer(named_parts(scores_, part_of_patch, weight_));
}

bool BaseChoice::offer(std::vector<int> labels) {
    double value = value_of_parts(cluster_sums(objective_, labels, static_cast<int>(scores_.rows())));
    for (std::size_t i = 0; i < labels.size(); ++i)
        value += gain_ * weight_[i] * scores_(labels[i], static_cast<Eigen::Index>(i));
    if (!(value > best_)) return false;
    best_ = value;
    labels_ = std::move(labels);
    return true;
}

std::vector<int> BaseChoice::labels() const {
    std::vector<int> labels = labels_;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (known_[i] >= 0) labels[i] = known_[i];
    }
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
