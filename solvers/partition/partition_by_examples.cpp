#include "solvers/partition/partition_by_examples.hpp"

#include <optional>
#include <span>
#include <utility>

#include "solvers/partition/corrected_parts.hpp"
#include "solvers/partition/labelled_parts.hpp"
#include "solvers/partition/part_regression.hpp"

namespace coseg {

namespace {

/// The scores of the examples as a descriptor that a partition should explain, beside the others. The scores
/// must outlive the result.
std::vector<ChoiceDescriptor> with_scores(std::span<const ChoiceDescriptor> descriptors,
                                          const Eigen::MatrixXf& scores, double weight) {
    std::vector<ChoiceDescriptor> all(descriptors.begin(), descriptors.end());
    all.push_back({patch_columns(scores), {.pooled = weight, .per_mesh = weight}});
    return all;
}

/// The partitions that explain the scores of the examples too. Collective.
FoundPartition found_explaining(const Comm& comm, const PartitionEvidence& evidence,
                                const Eigen::MatrixXd& scores, const CutOptions& options,
                                std::vector<PartitionCandidate> clusterings) {
    const Eigen::MatrixXf single = scores.cast<float>();
    const std::vector<ChoiceDescriptor> descriptors =
        with_scores(evidence.descriptors, single, options.examples.explained);
    PartitionEvidence sought = evidence;
    sought.descriptors = descriptors;
    const PartitionObjective objective = partition_objective(comm, sought, options.choice);
    return found_by_search(comm, {sought, objective, options.choice, options.parts}, std::move(clusterings));
}

}  // namespace

FoundPartition found_by_examples(const Comm& comm, const CutInput& input, const PlacedEvidence& placed,
                                 const CutOptions& options, std::vector<PartitionCandidate> clusterings) {
    const PartitionEvidence& evidence = placed.evidence;
    std::optional<PartRegression> regression;
    SaidParts said{{}, input.examples->area, {}};
    Eigen::MatrixXd told;  // the scores by the examples alone
    agree(comm, [&] {
        regression.emplace(
            PatchLooks{*input.features, input.positions, placed.frame, input.patch_area, input.mesh_of},
            evidence.neighbors, std::vector<double>{});
        told = regression->scores(said);
    });
    std::vector<int> best_labels = labels_of_best_scores(told);
    FoundPartition explaining = found_explaining(comm, evidence, told, options, clusterings);
    const PartitionObjective objective = partition_objective(comm, evidence, options.choice);
    const SearchTask task{evidence, objective, options.choice, options.parts};
    FoundPartition alone = found_and_expanded(comm, task, options, std::move(clusterings));
    BaseChoice base(objective, *input.examples, std::move(told), options.examples.scores);
    base.offer_parts(alone.candidates[alone.chosen].labels);
    FoundPartition& found =
        base.offer_parts(explaining.candidates[explaining.chosen].labels) ? explaining : alone;
    base.offer(std::move(best_labels));
    said.base = base.labels();
    said.allowed = Eigen::MatrixXi::Ones(options.parts, objective.meshes);
    Eigen::MatrixXd scores;
    agree(comm, [&] { scores = regression->scores(said); });
    CorrectedPartition corrected = corrected_partition(comm, objective, said, scores, options.examples);
    PartitionCandidate& chosen = found.candidates[found.chosen];
    chosen = relabelled(task, std::move(chosen), std::move(corrected.parts));
    found.confidence = std::move(corrected.confidence);
    return std::move(found);
}

}  // namespace coseg
