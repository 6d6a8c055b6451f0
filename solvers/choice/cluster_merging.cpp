#include "solvers/choice/cluster_merging.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "solvers/choice/part_shares.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Some of the unions made.
struct Partial {
    ClusterSums sums;
    std::vector<int> group;  ///< of each cluster: its row in sums
    double value = 0.0;
    Eigen::MatrixXd gain;  ///< of the union of a and b, symmetric; found once, as most unions leave it alone
};

double gain_of_union(const ClusterSums& sums, int a, int b) {
    return value_of_part(sums, std::array{a, b}) - value_of_part(sums, std::array{a}) -
           value_of_part(sums, std::array{b});
}

Partial all_alone(const ClusterSums& clusters) {
    const int count = clusters.count();
    Partial partial{clusters, std::vector<int>(at(count)), value_of_parts(clusters),
                    Eigen::MatrixXd::Zero(count, count)};
    std::iota(partial.group.begin(), partial.group.end(), 0);
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b)
            partial.gain(a, b) = partial.gain(b, a) = gain_of_union(clusters, a, b);
    }
    return partial;
}

/// a < b. As in unite(), the last takes the number b.
Partial after_union(const Partial& before, int a, int b, double value) {
    const int last = before.sums.count() - 1;
    Partial after = before;
    after.value = value;
    unite(after.sums, a, b);
    for (int& g : after.group) g = g == b ? a : (g == last ? b : g);
    after.gain.row(b) = after.gain.row(last).eval();
    after.gain.col(b) = after.gain.col(last).eval();
    after.gain.conservativeResize(last, last);
    for (int c = 0; c < last; ++c) {
        if (c != a)
            after.gain(a, c) = after.gain(c, a) = gain_of_union(after.sums, std::min(a, c), std::max(a, c));
    }
    return after;
}

struct Union {
    double value = 0.0;  ///< of all parts, after it
    std::size_t of = 0;  ///< the partial result
    int a = 0;           ///< a < b
    int b = 0;
};

std::vector<Union> all_unions(const std::vector<Partial>& partials) {
    std::vector<Union> unions;
    for (std::size_t p = 0; p < partials.size(); ++p) {
        for (int a = 0; a < partials[p].sums.count(); ++a) {
            for (int b = a + 1; b < partials[p].sums.count(); ++b)
                unions.push_back({partials[p].value + partials[p].gain(a, b), p, a, b});
        }
    }
    return unions;
}

std::vector<int> group_after(const Partial& partial, int a, int b) {
    std::vector<int> group = partial.group;
    std::replace(group.begin(), group.end(), b, a);
    return group;
}

/// One union more in each.
std::vector<Partial> next_step(const std::vector<Partial>& partials, int beam) {
    std::vector<Union> unions = all_unions(partials);
    std::stable_sort(unions.begin(), unions.end(),
                     [](const Union& x, const Union& y) { return x.value > y.value; });
    std::set<std::vector<int>> seen;
    std::vector<Partial> next;
    for (const Union& u : unions) {
        if (static_cast<int>(next.size()) == beam) break;
        if (seen.insert(renumbered(group_after(partials[u.of], u.a, u.b))).second)
            next.push_back(after_union(partials[u.of], u.a, u.b, u.value));
    }
    return next;
}

/// Worth more than everything else that speaks for a partition.
constexpr double cost_of_degenerate_part = 1e4;

bool is_degenerate_union(const ClusterSums& clusters, std::span<const int> members) {
    Eigen::RowVectorXd share = Eigen::RowVectorXd::Zero(clusters.share.cols());
    for (const int c : members) share += clusters.share.row(c);
    return is_degenerate_part(share);
}

/// Moves whole clusters between the parts of a finished result: first by the values of the parts alone, and
/// then, where a part is hardly one, with a cost for such parts.
class ClusterMoves {
  public:
    ClusterMoves(const ClusterSums& clusters, std::vector<int> part, int parts)
        : clusters_(clusters),
          part_(std::move(part)),
          parts_(parts),
          alone_(part_.size()),
          value_(parts),
          with_(parts, clusters.count()),
          united_(parts, parts),
          left_(clusters.count()) {
        run();
        if (!any_degenerate()) return;
        degenerate_parts_cost_ = true;
        run();
    }

    [[nodiscard]] const std::vector<int>& parts() const noexcept { return part_; }

  private:
    void run() {
        for (int c = 0; c < clusters_.count(); ++c) alone_[at(c)] = value(std::array{c});
        std::vector<int> changed(at(parts_));
        std::iota(changed.begin(), changed.end(), 0);
        for (int round = 0; round < most_rounds; ++round) {
            look_at(changed);
            Move best = best_single();
            const Move exchange = best_exchange();
            if (exchange.gain > best.gain) best = exchange;
            if (best.cluster < 0) return;
            changed = apply(best);
        }
    }

    /// Every move gains, so that it ends by itself; this is to be sure of it whatever rounding does.
    static constexpr int most_rounds = 100;
    static constexpr double least_gain = 1e-9;

    struct Move {
        double gain = least_gain;
        int cluster = -1;  ///< goes
        int to = -1;       ///< to this part; or this part takes in `other`, whose number the cluster gets
        int other = -1;
    };

    [[nodiscard]] double value(std::span<const int> members) const {
        const double value = value_of_part(clusters_, members);
        const bool costs = degenerate_parts_cost_ && is_degenerate_union(clusters_, members);
        return costs ? value - cost_of_degenerate_part : value;
    }

    [[nodiscard]] bool any_degenerate() const {
        for (int p = 0; p < parts_; ++p) {
            if (is_degenerate_union(clusters_, members(p))) return true;
        }
        return false;
    }

    [[nodiscard]] std::vector<int> members(int part, int without = -1, int with = -1) const {
        std::vector<int> result;
        for (int c = 0; c < clusters_.count(); ++c) {
            if ((part_[at(c)] == part && c != without) || c == with) result.push_back(c);
        }
        return result;
    }

    /// Finds all values that depend on the clusters of these parts; those of other parts stay as they are.
    void look_at(const std::vector<int>& changed) {
        std::vector<char> is_changed(at(parts_), 0);
        for (const int p : changed) {
            is_changed[at(p)] = 1;
            look_at_part(p);
        }
        for (int p = 0; p < parts_; ++p) {
            for (int q = p + 1; q < parts_; ++q) {
                if (is_changed[at(p)] != 0 || is_changed[at(q)] != 0) united_(p, q) = value_of_union(p, q);
            }
        }
    }

    void look_at_part(int part) {
        value_(part) = value(members(part));
        for (int c = 0; c < clusters_.count(); ++c) {
            if (part_[at(c)] != part) {
                with_(part, c) = value(members(part, -1, c));
                continue;
            }
            const std::vector<int> rest = members(part, c);
            left_(c) = rest.empty() ? -std::numeric_limits<double>::infinity() : value(rest) - value_(part);
        }
    }

    /// a < b.
    [[nodiscard]] double value_of_union(int a, int b) const {
        std::vector<int> both = members(a);
        for (const int c : members(b)) both.push_back(c);
        return value(both);
    }

    [[nodiscard]] Move best_single() const {
        Move best;
        for (int c = 0; c < clusters_.count(); ++c) {
            for (int p = 0; p < parts_ && left_(c) > -std::numeric_limits<double>::infinity(); ++p) {
                if (p == part_[at(c)]) continue;
                const double gain = left_(c) + with_(p, c) - value_(p);
                if (gain > best.gain) best = {gain, c, p, -1};
            }
        }
        return best;
    }

    [[nodiscard]] Move best_exchange() const {
        Move best;
        for (int p = 0; p < parts_; ++p) {
            for (int q = p + 1; q < parts_; ++q) {
                const double united = united_(p, q) - value_(p) - value_(q);
                for (int c = 0; c < clusters_.count(); ++c) {
                    if (part_[at(c)] == p || part_[at(c)] == q) continue;
                    const double gain = united + left_(c) + alone_[at(c)];
                    if (gain > best.gain) best = {gain, c, p, q};
                }
            }
        }
        return best;
    }

    /// The parts whose clusters are others now.
    std::vector<int> apply(const Move& move) {
        const int from = part_[at(move.cluster)];
        if (move.other < 0) {
            part_[at(move.cluster)] = move.to;
            return {from, move.to};
        }
        std::replace(part_.begin(), part_.end(), move.other, move.to);
        part_[at(move.cluster)] = move.other;
        return {from, move.to, move.other};
    }

    const ClusterSums& clusters_;
    std::vector<int> part_;
    int parts_;
    bool degenerate_parts_cost_ = false;
    std::vector<double> alone_;  ///< value of each cluster as a part
    Eigen::VectorXd value_;      ///< of each part
    Eigen::MatrixXd with_;       ///< K x C: value of a part with one more cluster
    Eigen::MatrixXd united_;     ///< K x K: value of two parts as one, above the diagonal
    Eigen::VectorXd left_;  ///< C: what a cluster's part gains when it leaves; -infinity from a part of one
};

}  // namespace

int merging_beam(int clusters) { return clusters < 30 ? 4 : 2; }

std::vector<std::vector<int>> merge_clusters(const ClusterSums& clusters, int parts) {
    if (clusters.count() <= parts) {
        std::vector<int> same(at(clusters.count()));
        std::iota(same.begin(), same.end(), 0);
        return {same};
    }
    std::vector<Partial> partials = {all_alone(clusters)};
    const int beam = merging_beam(clusters.count());
    while (partials.front().sums.count() > parts) partials = next_step(partials, beam);
    std::vector<std::vector<int>> results;
    for (Partial& partial : partials) {
        results.push_back(ClusterMoves(clusters, std::move(partial.group), parts).parts());
    }
    return results;
}

}  // namespace coseg
