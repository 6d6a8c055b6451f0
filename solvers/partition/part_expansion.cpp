#include "solvers/partition/part_expansion.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "solvers/boundaries/minimum_cut.hpp"
#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

namespace {

/// A part must gain this much by an expansion; below it is rounding.
constexpr double least_gain = 1e-9;
/// Passes over all parts in a mesh. A third one hardly ever changes a patch.
constexpr int sweeps = 2;

/// The sums over the parts, in all meshes, that derivatives are found from.
struct PooledSums {
    Eigen::MatrixXf deviations;  ///< D x K
    Eigen::VectorXd area;        ///< K
    Eigen::VectorXd share;       ///< K
    Eigen::MatrixXd share_in;    ///< K x M
};

PooledSums pooled_sums(const PartitionObjective& objective, const std::vector<int>& labels, int parts) {
    PooledSums sums{Eigen::MatrixXf::Zero(objective.deviations.rows(), parts), Eigen::VectorXd::Zero(parts),
                    Eigen::VectorXd::Zero(parts), Eigen::MatrixXd::Zero(parts, objective.meshes)};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const int part = labels[i];
        sums.deviations.col(part) += objective.deviations.col(static_cast<Eigen::Index>(i));
        sums.area(part) += objective.area[i];
        sums.share_in(part, objective.mesh_of[i]) += objective.share[i];
    }
    sums.share = sums.share_in.rowwise().sum();
    return sums;
}

/// The derivative of |X|^2 / a, in the weighted norm, when a patch joins: K x n, for n columns `x`.
Eigen::MatrixXd explained_gains(const Eigen::MatrixXf& sums, const Eigen::VectorXd& area,
                                const Eigen::VectorXf& weight, const Eigen::MatrixXf& x,
                                const Eigen::VectorXd& patch_area) {
    const Eigen::MatrixXf weighted = weight.asDiagonal() * sums;
    Eigen::MatrixXd gains = (weighted.transpose() * x).cast<double>();
    for (Eigen::Index part = 0; part < gains.rows(); ++part) {
        if (area(part) <= 0.0) {
            gains.row(part).setZero();
            continue;
        }
        const double square = weighted.col(part).dot(sums.col(part));
        gains.row(part) *= 2.0 / area(part);
        gains.row(part) -= (square / (area(part) * area(part))) * patch_area.transpose();
    }
    return gains;
}

/// The expansions in one mesh. Patches are numbered from its first.
class MeshExpansion {
  public:
    MeshExpansion(const PartitionObjective& objective, const KnownParts& known,
                  const std::vector<int>& labels, BlockRange patches)
        : objective_(objective), known_(known), first_(static_cast<int>(patches.begin)) {
        labels_.assign(labels.begin() + patches.begin, labels.begin() + patches.end);
    }

    std::vector<int> run(const PooledSums& pooled, const std::vector<int>& all_labels) {
        find_gains(pooled);
        find_ties(all_labels);
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            bool changed = false;
            for (int part = 0; part < gains_.rows(); ++part) changed = expand(part) || changed;
            if (!changed) break;
        }
        return std::move(labels_);
    }

  private:
    struct Tie {
        int a = 0;  ///< a < b
        int b = 0;
        double gain = 0.0;
    };

    [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(labels_.size()); }
    [[nodiscard]] bool is_fixed(int i) const {
        return !known_.fixed.empty() && known_.fixed[at(first_ + i)] >= 0;
    }

    void find_gains(const PooledSums& pooled) {
        const Eigen::MatrixXf x = objective_.deviations.middleCols(first_, count());
        const Eigen::Map<const Eigen::VectorXd> area(objective_.area.data() + first_, count());
        const Eigen::Map<const Eigen::VectorXd> share(objective_.share.data() + first_, count());
        const Eigen::Index parts = pooled.area.size();
        Eigen::MatrixXf own = Eigen::MatrixXf::Zero(x.rows(), parts);
        Eigen::VectorXd own_area = Eigen::VectorXd::Zero(parts);
        for (Eigen::Index i = 0; i < count(); ++i) {
            own.col(labels_[at(i)]) += x.col(i);
            own_area(labels_[at(i)]) += area(i);
        }
        gains_ = explained_gains(own, own_area, objective_.per_mesh, x, area) +
                 explained_gains(pooled.deviations, pooled.area, objective_.pooled, x, area);
        const int mesh = objective_.mesh_of[at(first_)];
        for (Eigen::Index part = 0; part < parts; ++part) {
            const double sum = pooled.share(part);
            if (sum <= 0.0) continue;
            // Of (variance / mean) = squares / sum - sum / M.
            const double slope = 2.0 * pooled.share_in(part, mesh) / sum -
                                 pooled.share_in.row(part).squaredNorm() / (sum * sum) -
                                 1.0 / objective_.meshes;
            gains_.row(part) -= objective_.size_weight * slope * share.transpose();
        }
        if (known_.gain.size() > 0) gains_ += known_.gain.middleCols(first_, count());
    }

    /// Ties inside the mesh stay ties; those to other meshes become gains.
    void find_ties(const std::vector<int>& all_labels) {
        for (int i = 0; i < static_cast<int>(count()); ++i) {
            for_each_tie(objective_, first_ + i, [&](int other, double gain) {
                const int j = other - first_;
                if (j < 0 || j >= count()) {
                    gains_(all_labels[at(other)], i) += gain;
                } else if (i < j) {
                    ties_.push_back({i, j, gain});
                }
            });
        }
    }

    /// Lets `part` take the best set of patches; whether any patch has changed. Nodes on the sink side take
    /// the part, and the others keep theirs. A tie costs its gain where its ends come to differ:
    /// `kept` where both keep, `first` where only a keeps, `second` where only b does.
    bool expand(int part) {
        std::vector<double> keeping(labels_.size(), 0.0);  // cost of keeping, less that of taking
        for (Eigen::Index i = 0; i < count(); ++i)
            keeping[at(i)] = gains_(part, i) - gains_(labels_[at(i)], i);
        std::vector<CutArc> arcs;
        for (const Tie& tie : ties_) {
            const int a = labels_[at(tie.a)];
            const int b = labels_[at(tie.b)];
            const double kept = a != b ? tie.gain : 0.0;
            const double first = a != part ? tie.gain : 0.0;
            const double second = b != part ? tie.gain : 0.0;
            keeping[at(tie.a)] -= second - kept;
            keeping[at(tie.b)] += second;
            const double both = first + second - kept;
            if (both > 0.0) arcs.push_back({tie.a, tie.b, both, 0.0});
        }
        std::vector<double> taking_costs(labels_.size(), 0.0);
        std::vector<double> keeping_costs(labels_.size(), 0.0);
        // More than everything that a fixed patch could save others by going over.
        double total = 1.0;
        for (const double k : keeping) total += std::abs(k);
        for (const CutArc& arc : arcs) total += arc.capacity;
        for (std::size_t i = 0; i < keeping.size(); ++i) {
            taking_costs[i] = is_fixed(static_cast<int>(i)) ? total : std::max(0.0, -keeping[i] + least_gain);
            keeping_costs[i] = is_fixed(static_cast<int>(i)) ? 0.0 : std::max(0.0, keeping[i] - least_gain);
        }
        const std::vector<char> takes = minimum_cut(taking_costs, keeping_costs, arcs);
        bool changed = false;
        for (std::size_t i = 0; i < takes.size(); ++i) {
            if (takes[i] == 0 || labels_[i] == part) continue;
            labels_[i] = part;
            changed = true;
        }
        return changed;
    }

    const PartitionObjective& objective_;
    const KnownParts& known_;
    int first_;
    std::vector<int> labels_;
    Eigen::MatrixXd gains_;  ///< K x n
    std::vector<Tie> ties_;
};

/// The patches of each mesh; they follow one another.
std::vector<BlockRange> patches_of_meshes(const std::vector<int>& mesh_of, int meshes) {
    std::vector<BlockRange> ranges(at(meshes));
    for (std::size_t i = 0; i < mesh_of.size(); ++i) {
        BlockRange& range = ranges[at(mesh_of[i])];
        if (range.begin == range.end) range.begin = static_cast<std::int64_t>(i);
        range.end = static_cast<std::int64_t>(i) + 1;
    }
    return ranges;
}

}  // namespace

std::vector<int> expand_parts(const Comm& comm, const PartitionObjective& objective, const KnownParts& known,
                              const std::vector<int>& labels, int parts) {
    const PooledSums pooled = pooled_sums(objective, labels, parts);
    const std::vector<BlockRange> patches = patches_of_meshes(objective.mesh_of, objective.meshes);
    const BlockRange mine = block_range(objective.meshes, comm.size(), comm.rank());
    std::vector<int> local;
    agree(comm, [&] {
        for (auto m = mine.begin; m < mine.end; ++m) {
            const std::vector<int> of_mesh =
                MeshExpansion(objective, known, labels, patches[at(m)]).run(pooled, labels);
            local.insert(local.end(), of_mesh.begin(), of_mesh.end());
        }
    });
    return all_gather(comm, std::span<const int>(local));
}

std::vector<int> climb_by_expansion(const Comm& comm, const PartitionObjective& objective,
                                    const KnownParts& known, std::vector<int> labels, int parts,
                                    const std::function<double(const std::vector<int>&)>& score, int rounds) {
    double best = score(labels);
    for (int round = 0; round < rounds; ++round) {
        std::vector<int> next = expand_parts(comm, objective, known, labels, parts);
        const double value = score(next);
        if (!(value > best + least_gain)) break;
        best = value;
        labels = std::move(next);
    }
    return labels;
}

}  // namespace coseg
