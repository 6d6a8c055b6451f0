#pragma once
// Labels that are given for some patches, and parts without names that become these labels.

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "solvers/choice/part_expansion.hpp"

namespace coseg {

/// What is known of the labels of patches, the same on all ranks.
struct ExampleLabels {
    /// K x N: the area of each patch that is said to have the label; columns of zeros where nothing is said.
    /// K is the number of parts. A row of zeros is a label without an example: a free part.
    Eigen::MatrixXd area;
    [[nodiscard]] bool empty() const noexcept { return area.size() == 0; }
};

/// Weights of what examples say, in the unit of the score.
struct ExampleWeights {
    /// Of the mean over the area of the score that a patch has for its own label; and, where one of several
    /// partitions is chosen, of the share of the known area of which it has the label right.
    double scores = 75.0;
    /// Of the share of the scores' spread that a partition explains, both common and per mesh, while parts
    /// have no names yet.
    double explained = 40.0;
};

/// The label of each patch of which at least half of the area is said: the one with the largest area, of
/// equal ones the lowest. -1 for the others.
std::vector<int> known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area);

/// Gives the patches of known_labels the score 1 for their label and 0 for the others. scores: K x N.
void hold_known_labels(const ExampleLabels& examples, const std::vector<double>& patch_area,
                       Eigen::MatrixXd& scores);

/// The labels of the parts such that the sum over patches of weight times score is largest, each part
/// another label. scores: K x N; part_of_patch: 0 .. K-1.
std::vector<int> named_parts(const Eigen::MatrixXd& scores, const std::vector<int>& part_of_patch,
                             const std::vector<double>& weight);

/// The label with the best score of each patch, of equal ones the lowest. scores: K x N.
std::vector<int> labels_of_best_scores(const Eigen::MatrixXd& scores);

/// Labels of which one set becomes the base that examples are followed from: those with the largest sum of
/// the objective, the mean over the area of the scores, and the share of what is known that they have right.
/// Serial.
class BaseChoice {
  public:
    /// scores: of the examples alone, K x N, 1 for the known label of known patches. gain: of the scores, and
    /// of what is right. The objective is referred to.
    BaseChoice(const PartitionObjective& objective, const ExampleLabels& examples, Eigen::MatrixXd scores,
               double gain);

    /// With the labels that suit these parts best, see offer().
    bool offer_parts(const std::vector<int>& part_of_patch);

    /// Whether the labels are better than all before.
    bool offer(std::vector<int> labels);

    /// The best labels, with those that are known.
    [[nodiscard]] std::vector<int> labels() const;

  private:
    const PartitionObjective& objective_;
    std::vector<int> known_;
    Eigen::MatrixXd scores_;
    double gain_;
    std::vector<double> weight_;  ///< of each patch: its share of all area, and of the known one
    double best_ = -std::numeric_limits<double>::infinity();
    std::vector<int> labels_;
};

/// What examples say of the parts of patches: known labels are fixed, and scores are gains.
KnownParts known_parts(const Eigen::MatrixXd& scores, const ExampleLabels& examples,
                       const std::vector<double>& patch_area, const ExampleWeights& weights);

/// The sum of the gains of `known` at these labels.
double gain_of(const KnownParts& known, const std::vector<int>& labels);

}  // namespace coseg
