#pragma once
// Labels that are given for some patches, and parts without names that become these labels.

#include <Eigen/Core>
#include <vector>

#include "solvers/partition/part_expansion.hpp"

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

/// What examples say of the parts of patches: known labels are fixed, and scores are gains.
KnownParts known_parts(const Eigen::MatrixXd& scores, const ExampleLabels& examples,
                       const std::vector<double>& patch_area, const ExampleWeights& weights);

/// The sum of the gains of `known` at these labels.
double gain_of(const KnownParts& known, const std::vector<int>& labels);

}  // namespace coseg
