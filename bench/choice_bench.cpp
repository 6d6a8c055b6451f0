// Writes what the choice among partitions looks at: the terms of the partitions that searches with different
// weights find, and how right each is. bench/choice_fit.py fits the weights to it.
//
//   mpirun -n P choice_bench --truth DIR --parts K [--seed 1] [--searches 1] [--spread 0.5]
//                            [--weights FILE ...] [--unweighted] -- MESH...
//
// The graphs of the starts that a run keeps are cut once for all searches. For each FILE there are so many
// searches: the first has its weights, and each other one has every weight multiplied by exp(spread * a
// standard normal number). A FILE is JSON, {"term": weight, ...}; the other weights are the program's, and
// all are without a FILE. A weight of 1 of a term that is printed adds the term to the score, whatever the
// numbers of patches and over-segmentations are.

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/mpi_program.hpp"
#include "mpi_drivers/co_segmentation.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "mpi_drivers/partition/cut_stage.hpp"
#include "mpi_drivers/partition/example_stage.hpp"
#include "mpi_drivers/process/checked_petsc.hpp"
#include "solvers/choice/partition_search.hpp"
#include "solvers/partition/start_clusterings.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/metrics/assignment.hpp"

namespace {

using coseg::at;
using coseg::BetweenPartVariance;
using coseg::Comm;
using nlohmann::ordered_json;

struct Settings {
    std::vector<std::string> meshes;
    std::string truth;
    int parts = 2;
    std::uint64_t seed = 1;
    int searches = 1;
    double spread = 0.5;
    std::vector<std::string> weights;
    bool unweighted = false;
};

/// The weight of a descriptor that has none: it is looked at and changes nothing.
constexpr double next_to_none = 1e-9;

/// All weights of the score in one list, of 50 patches and three over-segmentations.
struct Weights {
    std::vector<std::string> names;
    std::vector<double> values;
};

Weights product_weights(const std::vector<BetweenPartVariance>& explained,
                        const std::vector<coseg::Descriptor>& descriptors, bool unweighted) {
    Weights weights;
    const auto add = [&](const std::string& name, double value) {
        weights.names.push_back(name);
        weights.values.push_back(value);
    };
    for (std::size_t h = 0; h < explained.size(); ++h) {
        if (!unweighted && explained[h] == BetweenPartVariance{}) continue;
        const std::string name = h < descriptors.size() ? std::string(descriptors[h].name) : "positions";
        add(name + ".pooled", explained[h].pooled);
        add(name + ".per_mesh", explained[h].per_mesh);
    }
    const coseg::ChoiceWeights choice;
    add("crease", choice.crease);
    add("overlap", choice.overlap);
    add("concavity", choice.concavity);
    add("size", choice.size);
    add("links", choice.links);
    return weights;
}

/// A collection up to its clusters, which do not depend on the weights.
class ClusteredCollection {
  public:
    /// Collective.
    ClusteredCollection(const Comm& comm, const Settings& settings, coseg::StageLog& log);

    [[nodiscard]] const Weights& weights() const noexcept { return weights_; }
    /// The partitions that a search with these weights gives, as JSON. Collective.
    ordered_json search(const Comm& comm, const std::vector<double>& weights, int number);
    /// The patches' labels with the most area, and these improved. Collective.
    ordered_json truth(const Comm& comm, const std::vector<double>& weights);

  private:
    struct Task;
    [[nodiscard]] Task task(const Comm& comm, const std::vector<double>& weights) const;
    [[nodiscard]] ordered_json described(const coseg::PartitionCandidate& candidate) const;
    [[nodiscard]] double accuracy(const std::vector<int>& labels) const;

    coseg::BasePartition run_;
    Eigen::MatrixXd truth_;  // labels x N: the area of each patch on faces of each label
    std::vector<int> mesh_of_;
    std::optional<coseg::PartitionInput> input_;
    std::optional<coseg::PreparedCut> graphs_;
    std::vector<coseg::PartitionCandidate> clusterings_;
    Weights weights_;
    double share_ = 1.0;   // what shares explained are multiplied with
    double crease_ = 1.0;  // likewise of creases
    int parts_ = 2;
};

coseg::BasePartition clustered_run(const Comm& comm, const Settings& settings, coseg::StageLog& log) {
    coseg::RunOptions options;
    set_seed(options, settings.seed);
    options.partition.parts = settings.parts;
    options.output.keep_model = false;
    options.process.watches_signals = false;
    return base_partition(comm, coseg::list_meshes(comm, settings.meshes), options, {}, log);
}

ClusteredCollection::ClusteredCollection(const Comm& comm, const Settings& settings, coseg::StageLog& log)
    : run_(clustered_run(comm, settings, log)), parts_(settings.parts) {
    coseg::PartitionOptions options = run_.options.partition;
    options.examples = settings.truth;
    truth_ = read_given_labels(comm, run_.collection, options, log).patches.area;
    mesh_of_ = run_.collection.numbering.mesh_of();
    share_ = coseg::share_weight(run_.collection.numbering);
    crease_ = coseg::weights_of_choice(run_.collection.numbering.oversegmentations()).crease /
              coseg::ChoiceWeights().crease;
    const std::vector<coseg::Descriptor> descriptors = run_.features.descriptors;
    options.examples.clear();
    input_.emplace(partition_input(comm, run_.collection, std::move(run_.features),
                                   run_.optimisation.result.coefficients, options));
    std::vector<BetweenPartVariance>& explained = input_->choice_weights;
    explained = coseg::explained_weights(descriptors, 1.0, explained.size() > descriptors.size());
    weights_ = product_weights(explained, descriptors, settings.unweighted);
    if (settings.unweighted) {
        for (BetweenPartVariance& w : explained) w.pooled = std::max(w.pooled, next_to_none);
    }
    const coseg::CutOptions cut = cut_options(*input_, options);
    const std::vector<coseg::GlobalPatchNeighbors> neighbors = local_neighbors(run_.collection);
    const std::vector<coseg::GlobalPatchOverlap> overlaps = local_overlaps(run_.collection);
    const coseg::CutInput cut_input{
        input_->coefficients,      neighbors, overlaps,         mesh_of_, input_->patch_area, {},
        input_->known_positions(), nullptr,   &input_->features};
    graphs_.emplace(prepared_cut(comm, cut_input, cut));
    // Starts that screening has left out of the run are not among its outcomes.
    std::vector<coseg::CutStart> starts;
    for (const coseg::StartOutcome& outcome : run_.cut.starts) starts.push_back(outcome.start);
    clusterings_ = start_clusterings(comm, graphs_->clustering(cut_input, cut, starts), graphs_->one_rank);
}

/// What a search looks at. It refers to itself.
struct ClusteredCollection::Task {
    coseg::ChoiceWeights choice;
    std::vector<coseg::ChoiceDescriptor> descriptors;
    coseg::PartitionEvidence evidence;
    coseg::PartitionObjective objective;
};

ClusteredCollection::Task ClusteredCollection::task(const Comm& comm,
                                                    const std::vector<double>& weights) const {
    std::vector<coseg::ChoiceDescriptor> descriptors = input_->choice();
    std::size_t next = 0;
    for (coseg::ChoiceDescriptor& d : descriptors) {
        d.weight = {.pooled = share_ * weights[next], .per_mesh = share_ * weights[next + 1]};
        next += 2;
    }
    const coseg::ChoiceWeights choice{.crease = crease_ * weights[next],
                                      .overlap = weights[next + 1],
                                      .concavity = weights[next + 2],
                                      .size = weights[next + 3],
                                      .links = weights[next + 4]};
    const coseg::PartitionEvidence evidence{
        graphs_->neighbors, graphs_->overlaps,
        descriptors,        mesh_of_,
        input_->patch_area, graphs_->links_count ? std::optional(graphs_->terms.base.view()) : std::nullopt};
    return {choice, std::move(descriptors), evidence, partition_objective(comm, evidence, choice)};
}

double ClusteredCollection::accuracy(const std::vector<int>& labels) const {
    Eigen::MatrixXd common = Eigen::MatrixXd::Zero(parts_, truth_.rows());
    for (std::size_t i = 0; i < labels.size(); ++i)
        common.row(labels[i]) += truth_.col(static_cast<Eigen::Index>(i)).transpose();
    const std::vector<int> label_of = coseg::best_assignment(common);
    double right = 0.0;
    for (std::size_t p = 0; p < label_of.size(); ++p) {
        if (label_of[p] >= 0) right += common(static_cast<Eigen::Index>(p), label_of[p]);
    }
    return right / truth_.sum();
}

ordered_json ClusteredCollection::described(const coseg::PartitionCandidate& candidate) const {
    const coseg::StartOutcome& outcome = candidate.outcome;
    std::vector<double> values;
    for (const BetweenPartVariance& explained : outcome.terms.explained) {
        values.push_back(share_ * explained.pooled);
        values.push_back(share_ * explained.per_mesh);
    }
    values.insert(values.end(), {crease_ * outcome.terms.crease, outcome.terms.overlap,
                                 outcome.terms.concavity, outcome.terms.size, outcome.terms.links});
    return {{"accuracy", accuracy(candidate.labels)},
            {"score", outcome.score},
            {"degenerate", outcome.degenerate || outcome.parts_found < parts_},
            {"values", values}};
}

ordered_json ClusteredCollection::search(const Comm& comm, const std::vector<double>& weights, int number) {
    const Task with = task(comm, weights);
    const coseg::SearchTask searched{with.evidence, with.objective, with.choice, parts_};
    std::vector<coseg::PartitionCandidate> found = search_partitions(comm, searched, clusterings_);
    found.push_back(expanded(comm, searched, found[ranked_candidates(found).front()]));
    ordered_json partitions;
    for (std::size_t k = 0; k < found.size(); ++k) {
        ordered_json partition = described(found[k]);
        partition["search"] = number;
        partition["taken"] = k + 1 == found.size();
        partitions.push_back(std::move(partition));
    }
    return partitions;
}

ordered_json ClusteredCollection::truth(const Comm& comm, const std::vector<double>& weights) {
    const Task with = task(comm, weights);
    const coseg::SearchTask searched{with.evidence, with.objective, with.choice, parts_};
    std::vector<int> labels(mesh_of_.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
        truth_.col(static_cast<Eigen::Index>(i)).maxCoeff(&labels[i]);
    const coseg::PartitionCandidate candidate = relabelled(searched, {}, std::move(labels));
    return {{"labels", described(candidate)}, {"improved", described(expanded(comm, searched, candidate))}};
}

/// The weights of the search of this number, the first of which has them as they are.
std::vector<double> spread_weights(std::vector<double> weights, double spread, std::uint64_t seed,
                                   int search) {
    for (std::size_t k = 0; k < weights.size() && search > 0; ++k) {
        const std::uint64_t hash =
            coseg::hash_words({seed, static_cast<std::uint64_t>(search), std::uint64_t{k}});
        weights[k] *= std::exp(spread * coseg::normal_of(hash));
    }
    return weights;
}

/// Those of the file, and of the program where it says nothing.
std::vector<double> read_weights(const std::string& path, const Weights& product) {
    std::ifstream file(path);
    const auto given = nlohmann::json::parse(file);
    std::vector<double> weights;
    for (std::size_t k = 0; k < product.names.size(); ++k)
        weights.push_back(given.value(product.names[k], product.values[k]));
    return weights;
}

void measure(const Comm& comm, const Settings& settings) {
    const coseg::CheckedPetsc petsc(comm, {});
    coseg::StageLog log(comm, coseg::Verbosity::quiet);
    ClusteredCollection collection(comm, settings, log);
    const Weights& product = collection.weights();
    std::vector<std::vector<double>> given;
    for (const std::string& path : settings.weights) given.push_back(read_weights(path, product));
    if (given.empty()) given.push_back(product.values);
    ordered_json json{{"terms", product.names}, {"weights", product.values}};
    json["truth"] = collection.truth(comm, given.front());
    int number = 0;
    for (const std::vector<double>& weights : given) {
        for (int k = 0; k < settings.searches; ++k, ++number) {
            for (ordered_json& partition :
                 collection.search(comm, spread_weights(weights, settings.spread, settings.seed, k), number))
                json["partitions"].push_back(std::move(partition));
        }
    }
    if (comm.is_root()) std::cout << json.dump() << "\n";
}

int program(int argc, char** argv) {
    Settings settings;
    CLI::App app("Writes what the choice among partitions looks at.");
    app.add_option("--truth", settings.truth, "Folder of NAME.seg for every mesh")->required();
    app.add_option("--parts", settings.parts)->required();
    app.add_option("--seed", settings.seed);
    app.add_option("--searches", settings.searches, "Searches for each file of weights");
    app.add_option("--spread", settings.spread, "Deviation of the logarithm of a weight");
    app.add_option("--weights", settings.weights, "Files of weights of terms, as JSON");
    app.add_flag("--unweighted", settings.unweighted, "Print the terms of descriptors without a weight too");
    app.add_option("meshes", settings.meshes)->required();
    return coseg::parse_and_run(app, argc, argv, [&] { measure(Comm(MPI_COMM_WORLD), settings); });
}

}  // namespace

int main(int argc, char** argv) { return coseg::run_with_mpi(argc, argv, program); }
