#include "solvers/partition/corrected_parts.hpp"

#include <array>
#include <limits>
#include <utility>

#include "solvers/choice/cluster_sums.hpp"
#include "solvers/partition/part_confidence.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Rounds of expansions. After the third hardly a patch changes.
constexpr int most_rounds = 4;
/// What a part costs that a mesh may not have: more than all gains and ties together, which are of the order
/// of the score's weights.
constexpr double forbidden = 1e7;

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

/// Parts that a mesh may not have are neither held nor gained.
void forbid_parts(const SaidParts& said, const std::vector<int>& mesh_of, KnownParts& known) {
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        for (int part = 0; part < part_count(said); ++part) {
            if (said.allowed(part, mesh_of[i]) == 0)
                known.gain(part, static_cast<Eigen::Index>(i)) = -forbidden;
        }
        int& fixed = known.fixed[i];
        if (fixed >= 0 && said.allowed(fixed, mesh_of[i]) == 0) fixed = -1;
    }
}

}  // namespace

CorrectedPartition corrected_partition(const Comm& comm, const PartitionObjective& objective,
                                       const SaidParts& said, const Eigen::MatrixXd& scores,
                                       const ExampleWeights& weights) {
    const int parts = part_count(said);
    KnownParts known = known_parts(scores, {said.area}, objective.area, weights);
    std::vector<std::vector<int>> starts;
    agree(comm, [&] {
        forbid_parts(said, objective.mesh_of, known);
        starts.push_back(start_of(said, scores, known, objective.mesh_of, &said.base));
        starts.push_back(start_of(said, scores, known, objective.mesh_of, nullptr));
    });
    CorrectedPartition result;
    double best = -std::numeric_limits<double>::infinity();
    for (std::vector<int>& labels : starts) {
        for (int round = 0; round < most_rounds; ++round) {
            std::vector<int> next = expand_parts(comm, objective, known, labels, parts);
            const bool is_same = next == labels;
            labels = std::move(next);
            if (is_same) break;
        }
        const double value = value_of_parts(cluster_sums(objective, labels, parts)) + gain_of(known, labels);
        if (!(value > best)) continue;
        best = value;
        result.parts = std::move(labels);
    }
    result.confidence = part_confidence(objective, known, result.parts, parts);
    return result;
}

CorrectedParts::CorrectedParts(const Comm& comm, const CutInput& input, const CutOptions& options,
                               const std::vector<double>& confidence)
    : weights_(options.examples) {
    cut_ = prepared_cut(comm, input, options);
    agree(comm, [&] {
        if (input.features == nullptr)
            throw Error(ExitCode::internal, "corrected parts need the features of all patches");
        regression_.emplace(
            PatchLooks{*input.features, input.positions, cut_.terms.frame, input.patch_area, input.mesh_of},
            cut_.neighbors, confidence);
    });
    objective_ = partition_objective(comm, cut_.evidence(input), options.choice);
    cut_.neighbors = {};
    cut_.overlaps = {};
}

}  // namespace coseg
