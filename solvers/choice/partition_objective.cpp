#include "solvers/choice/partition_objective.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "src/base/index.hpp"
#include "src/parallel/node_shared_array.hpp"

namespace coseg {

PatchDeviations::PatchDeviations(Eigen::MatrixXf own) : rows_(own.rows()), columns_(own.cols()) {
    const auto kept = std::make_shared<const Eigen::MatrixXf>(std::move(own));
    values_ = std::shared_ptr<const float>(kept, kept->data());
}

PatchDeviations::PatchDeviations(std::shared_ptr<const float> values, Eigen::Index rows, Eigen::Index columns)
    : values_(std::move(values)), rows_(rows), columns_(columns) {}

namespace {

std::vector<double> mesh_areas(const PartitionEvidence& evidence, int meshes) {
    std::vector<double> areas(at(meshes), 0.0);
    for (std::size_t i = 0; i < evidence.mesh_of.size(); ++i)
        areas[at(evidence.mesh_of[i])] += evidence.patch_area[i];
    return areas;
}

/// Writes the deviations of a descriptor into rows `first` and following.
void add_deviations(const PartitionEvidence& evidence, const PatchColumns& x,
                    const std::vector<double>& mesh_area, Eigen::Index first,
                    Eigen::Map<Eigen::MatrixXf> deviations) {
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(x.rows(), static_cast<Eigen::Index>(mesh_area.size()));
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        mean.col(evidence.mesh_of[at(i)]) += evidence.patch_area[at(i)] * x.col(i).cast<double>();
    for (std::size_t m = 0; m < mesh_area.size(); ++m) {
        if (mesh_area[m] > 0.0) mean.col(static_cast<Eigen::Index>(m)) /= mesh_area[m];
    }
    double spread = 0.0;
    double squares = 0.0;
    auto rows = deviations.middleRows(first, x.rows());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double area = evidence.patch_area[at(i)];
        const Eigen::VectorXd deviation = x.col(i).cast<double>() - mean.col(evidence.mesh_of[at(i)]);
        squares += area * x.col(i).cast<double>().squaredNorm();
        spread += area * deviation.squaredNorm();
        rows.col(i) = (area * deviation).cast<float>();
    }
    if (spread > 1e-12 * squares) {
        rows /= static_cast<float>(std::sqrt(spread));
    } else {
        rows.setZero();
    }
}

class Ties {
  public:
    explicit Ties(std::size_t patches) : of_(patches) {}
    void add(int a, int b, double gain) {
        of_[at(a)].push_back({b, gain});
        of_[at(b)].push_back({a, gain});
    }
    std::vector<std::vector<PatchTie>> take() { return std::move(of_); }

  private:
    std::vector<std::vector<PatchTie>> of_;
};

/// What overlap_agreement gains by the pair in the same part.
void add_overlaps(const PartitionEvidence& evidence, double weight, Ties& ties) {
    const std::vector<double> all = overlap_sums(evidence.overlaps, evidence.mesh_of.size());
    double area = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) area += all[i] > 0.0 ? evidence.patch_area[i] : 0.0;
    for (const GlobalPatchOverlap& pair : evidence.overlaps) {
        double gain = 0.0;
        for (const std::size_t i : {at(pair.patch_a), at(pair.patch_b)}) {
            if (all[i] > 0.0) gain += evidence.patch_area[i] / all[i];
        }
        ties.add(pair.patch_a, pair.patch_b, weight * pair.intersection_over_union * gain / area);
    }
}

/// D.
Eigen::Index dimension(const PartitionEvidence& evidence) {
    Eigen::Index rows = 0;
    for (const ChoiceDescriptor& d : evidence.descriptors) rows += d.histograms.rows();
    return rows;
}

/// Writes the deviations of the descriptors first, first + step, first + 2 step, ...
void write_deviations(const PartitionEvidence& evidence, std::size_t first, std::size_t step,
                      const Eigen::Map<Eigen::MatrixXf>& deviations) {
    const std::vector<double> mesh_area = mesh_areas(evidence, mesh_count(evidence.mesh_of));
    Eigen::Index row = 0;
    for (std::size_t h = 0; h < evidence.descriptors.size(); ++h) {
        const PatchColumns& x = evidence.descriptors[h].histograms;
        if (h % step == first) add_deviations(evidence, x, mesh_area, row, deviations);
        row += x.rows();
    }
}

/// What the ranks of a node write together. Collective.
PatchDeviations shared_deviations(const Comm& comm, const PartitionEvidence& evidence) {
    const Eigen::Index rows = dimension(evidence);
    const auto columns = static_cast<Eigen::Index>(evidence.mesh_of.size());
    const auto memory = std::make_shared<NodeSharedArray<float>>(comm, at(rows * columns));
    const Comm& node = memory->ranks().here();
    write_deviations(evidence, at(node.rank()), at(node.size()), {memory->data(), rows, columns});
    memory->fence();
    return {std::shared_ptr<const float>(memory, memory->data()), rows, columns};
}

PatchDeviations own_deviations(const PartitionEvidence& evidence) {
    Eigen::MatrixXf own(dimension(evidence), static_cast<Eigen::Index>(evidence.mesh_of.size()));
    write_deviations(evidence, 0, 1, {own.data(), own.rows(), own.cols()});
    return PatchDeviations(std::move(own));
}

void weigh_rows(const PartitionEvidence& evidence, PartitionObjective& objective) {
    objective.per_mesh.resize(dimension(evidence));
    objective.pooled.resize(dimension(evidence));
    Eigen::Index first = 0;
    for (const ChoiceDescriptor& d : evidence.descriptors) {
        const Eigen::Index rows = d.histograms.rows();
        objective.per_mesh.segment(first, rows).setConstant(static_cast<float>(d.weight.per_mesh));
        objective.pooled.segment(first, rows).setConstant(static_cast<float>(d.weight.pooled));
        first += rows;
    }
}

PartitionObjective objective_of(const PartitionEvidence& evidence, const ChoiceWeights& weights,
                                PatchDeviations deviations) {
    const std::vector<int>& mesh_of = evidence.mesh_of;
    const int meshes = mesh_count(evidence.mesh_of);
    const std::vector<double> mesh_area = mesh_areas(evidence, meshes);
    PartitionObjective objective;
    objective.deviations = std::move(deviations);
    weigh_rows(evidence, objective);
    Ties ties(mesh_of.size());
    for (const GlobalPatchNeighbors& pair : evidence.neighbors)
        ties.add(pair.patch_a, pair.patch_b, weights.crease * crease_cost(pair) / meshes);
    add_overlaps(evidence, weights.overlap, ties);
    objective.ties = ties.take();
    objective.mesh_of = mesh_of;
    objective.area = evidence.patch_area;
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        const double whole = mesh_area[at(mesh_of[i])];
        objective.share.push_back(whole > 0.0 ? evidence.patch_area[i] / whole : 0.0);
    }
    objective.meshes = meshes;
    objective.size_weight = weights.size;
    if (evidence.links) {
        const double all = std::accumulate(evidence.links->values.begin(), evidence.links->values.end(), 0.0);
        objective.links = evidence.links;
        // Both halves of a link are inside together.
        objective.link_gain = all > 0.0 ? 2.0 * weights.links / all : 0.0;
    }
    return objective;
}

}  // namespace

PartitionObjective partition_objective(const PartitionEvidence& evidence, const ChoiceWeights& weights) {
    return objective_of(evidence, weights, own_deviations(evidence));
}

PartitionObjective partition_objective(const Comm& comm, const PartitionEvidence& evidence,
                                       const ChoiceWeights& weights) {
    return objective_of(evidence, weights, shared_deviations(comm, evidence));
}

std::vector<BlockRange> patches_of_meshes(const PartitionObjective& objective) {
    std::vector<BlockRange> ranges(at(objective.meshes));
    for (std::size_t i = 0; i < objective.mesh_of.size(); ++i) {
        BlockRange& range = ranges[at(objective.mesh_of[i])];
        if (range.begin == range.end) range.begin = static_cast<std::int64_t>(i);
        range.end = static_cast<std::int64_t>(i) + 1;
    }
    return ranges;
}

double relative_variance(double sum, double squares, int meshes) {
    const double mean = sum / meshes;
    return mean > 0.0 ? std::max(0.0, squares / meshes - mean * mean) / mean : 0.0;
}

}  // namespace coseg
