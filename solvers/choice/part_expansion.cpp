#include "solvers/choice/part_expansion.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "solvers/boundaries/minimum_cut.hpp"
#include "solvers/choice/part_gains.hpp"
#include "src/base/index.hpp"
#include "src/parallel/block_range.hpp"

namespace coseg {

namespace {

/// A part must gain this much by an expansion; below it is rounding.
constexpr double least_gain = 1e-9;
constexpr int climb_rounds = 15;
/// Passes over all parts in a mesh. A third one hardly ever changes a patch.
constexpr int sweeps = 2;

/// The expansions in one mesh. Patches are numbered from its first.
class MeshExpansion {
  public:
    MeshExpansion(const PartitionObjective& objective, const KnownParts& known,
                  const std::vector<int>& labels, BlockRange patches)
        : objective_(objective), known_(known), first_(static_cast<int>(patches.begin)) {
        labels_.assign(labels.begin() + patches.begin, labels.begin() + patches.end);
    }

    std::vector<int> run(const PartGains& gains, const std::vector<int>& all_labels, double inertia) {
        gains_ = gains.of_mesh({first_, first_ + count()});
        if (known_.gain.size() > 0) gains_ += known_.gain.middleCols(first_, count());
        for (Eigen::Index i = 0; i < count() && inertia > 0.0; ++i)
            gains_(labels_[at(i)], i) += inertia * objective_.share[at(first_ + i)] / objective_.meshes;
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

bool all_fixed(const KnownParts& known, BlockRange patches) {
    return !known.fixed.empty() &&
           std::all_of(known.fixed.begin() + patches.begin, known.fixed.begin() + patches.end,
                       [](int part) { return part >= 0; });
}

}  // namespace

std::vector<int> expand_parts(const Comm& comm, const PartitionObjective& objective, const KnownParts& known,
                              const std::vector<int>& labels, int parts, double inertia) {
    const PartGains gains(objective, labels, parts);
    const std::vector<BlockRange> patches = patches_of_meshes(objective);
    const BlockRange mine = block_range(objective.meshes, comm.size(), comm.rank());
    std::vector<int> local;
    agree(comm, [&] {
        for (auto m = mine.begin; m < mine.end; ++m) {
            if (all_fixed(known, patches[at(m)])) {
                local.insert(local.end(), labels.begin() + patches[at(m)].begin,
                             labels.begin() + patches[at(m)].end);
                continue;
            }
            const std::vector<int> of_mesh =
                MeshExpansion(objective, known, labels, patches[at(m)]).run(gains, labels, inertia);
            local.insert(local.end(), of_mesh.begin(), of_mesh.end());
        }
    });
    return all_gather(comm, std::span<const int>(local));
}

std::vector<int> climb_by_expansion(const Comm& comm, const PartitionObjective& objective,
                                    const KnownParts& known, std::vector<int> labels, int parts,
                                    const Climb& climb) {
    double best = climb.score(labels);
    for (const double inertia : climb.inertias) {
        for (int round = 0; round < climb_rounds; ++round) {
            std::vector<int> next = expand_parts(comm, objective, known, labels, parts, inertia);
            const double value = climb.score(next);
            if (!(value > best + least_gain)) break;
            best = value;
            labels = std::move(next);
        }
    }
    return labels;
}

}  // namespace coseg
