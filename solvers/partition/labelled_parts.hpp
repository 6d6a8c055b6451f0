#pragma once
// Turns a partition whose parts have no names into one that says the labels of examples.

#include <Eigen/Core>
#include <vector>

#include "solvers/partition/example_scores.hpp"
#include "solvers/partition/part_expansion.hpp"

namespace coseg {

/// Weights of what examples say, in the unit of the score.
struct ExampleWeights {
    /// Of the mean over the area of the score that a patch has for its own label.
    double scores = 75.0;
    /// Of the share of the scores' spread that a partition explains, both common and per mesh, while parts
    /// have no names yet.
    double explained = 40.0;
};

/// The labels of the parts such that the sum over patches of area times example_scores is largest, each part
/// another label. scores: K x N; part_of_patch: 0 .. K-1.
std::vector<int> named_parts(const Eigen::MatrixXd& scores, const std::vector<int>& part_of_patch,
                             const std::vector<double>& patch_area);

/// What examples say of the parts of patches: known labels are fixed, and scores are gains.
KnownParts known_parts(const Eigen::MatrixXd& scores, const ExampleLabels& examples,
                       const std::vector<double>& patch_area, const ExampleWeights& weights);

/// The sum of the gains of `known` at these labels.
double gain_of(const KnownParts& known, const std::vector<int>& labels);

}  // namespace coseg
