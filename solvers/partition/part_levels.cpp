#include "solvers/partition/part_levels.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "solvers/choice/part_shares.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Groups of clusters, as rows of the sums, that become fewer.
class Groups {
  public:
    Groups(ClusterSums sums, std::vector<int> part)
        : sums_(std::move(sums)), part_(std::move(part)), group_of_(part_.size()), lead_(part_.size()) {
        std::iota(group_of_.begin(), group_of_.end(), 0);
        std::iota(lead_.begin(), lead_.end(), 0);
    }

    [[nodiscard]] int count() const { return sums_.count(); }
    [[nodiscard]] const std::vector<int>& group_of_cluster() const { return group_of_; }
    [[nodiscard]] double area(int group) const { return sums_.area.row(group).sum(); }

    /// Every group becomes its own leader.
    void name_leaders(const std::vector<int>& number_of_group) { lead_ = number_of_group; }

    /// Unites the pair that loses least, of one part if `inside`.
    PieceUnion unite_best(bool inside) {
        PieceUnion best{.kept = -1, .taken = -1, .loss = std::numeric_limits<double>::infinity()};
        for (int a = 0; a < count(); ++a) {
            for (int b = a + 1; b < count(); ++b) {
                if (inside && part_[at(a)] != part_[at(b)]) continue;
                const double lost = loss(a, b);
                if (lost < best.loss) best = {a, b, lost};
            }
        }
        return unite_groups(best);
    }

    /// Unites the two groups whose clusters have the same label.
    PieceUnion unite_same(const std::vector<int>& label_of_cluster) {
        std::vector<int> group_of_label(group_of_.size(), -1);
        for (std::size_t c = 0; c < group_of_.size(); ++c) {
            int& known = group_of_label[at(label_of_cluster[c])];
            const int a = std::min(known, group_of_[c]);
            const int b = std::max(known, group_of_[c]);
            if (known >= 0 && a != b) return unite_groups({a, b, loss(a, b)});
            known = group_of_[c];
        }
        throw Error(ExitCode::internal, "levels of parts are not nested");
    }

  private:
    [[nodiscard]] double loss(int a, int b) const {
        return value_of_part(sums_, std::array{a}) + value_of_part(sums_, std::array{b}) -
               value_of_part(sums_, std::array{a, b});
    }

    /// The union of two groups, which it then names by the pieces that lead them.
    PieceUnion unite_groups(PieceUnion both) {
        const int a = both.kept;
        const int b = both.taken;
        both.kept = std::min(lead_[at(a)], lead_[at(b)]);
        both.taken = std::max(lead_[at(a)], lead_[at(b)]);
        join(a, b, both.kept);
        return both;
    }

    void join(int a, int b, int lead) {
        const int last = count() - 1;
        unite(sums_, a, b);
        lead_[at(a)] = lead;
        lead_[at(b)] = lead_[at(last)];
        lead_.pop_back();
        part_[at(b)] = part_[at(last)];
        part_.pop_back();
        for (int& group : group_of_) group = group == b ? a : (group == last ? b : group);
    }

    ClusterSums sums_;
    std::vector<int> part_;      ///< of each group
    std::vector<int> group_of_;  ///< of each cluster
    std::vector<int> lead_;      ///< of each group
};

/// The part of each group.
std::vector<int> parts_of_groups(const Groups& groups, const std::vector<int>& part_of_cluster) {
    std::vector<int> part(at(groups.count()));
    for (std::size_t c = 0; c < part_of_cluster.size(); ++c)
        part[at(groups.group_of_cluster()[c])] = part_of_cluster[c];
    return part;
}

/// A number for each group: in each part the largest one has that of the part, and the others follow in any
/// order.
std::vector<int> provisional_numbers(const Groups& groups, const std::vector<int>& part_of_group, int parts) {
    std::vector<int> largest(at(parts), -1);
    for (int g = 0; g < groups.count(); ++g) {
        int& best = largest[at(part_of_group[at(g)])];
        if (best < 0 || groups.area(g) > groups.area(best)) best = g;
    }
    std::vector<int> number(at(groups.count()));
    int next = parts;
    for (int g = 0; g < groups.count(); ++g)
        number[at(g)] = largest[at(part_of_group[at(g)])] == g ? part_of_group[at(g)] : next++;
    return number;
}

/// The numbers of pieces such that the last union inside the parts has taken piece K, the one before it piece
/// K + 1, and so on.
std::vector<int> final_numbers(const std::vector<PieceUnion>& unions, int pieces, int parts) {
    std::vector<int> number(at(pieces));
    std::iota(number.begin(), number.end(), 0);
    int next = parts;
    for (int k = pieces - parts - 1; k >= 0; --k) number[at(unions[at(k)].taken)] = next++;
    return number;
}

/// The labels of pieces that have the labels of their patches.
std::vector<int> labels_of_pieces(const std::vector<int>& piece_of_patch, int pieces,
                                  const std::vector<int>& label_of_patch) {
    std::vector<int> labels(at(pieces), 0);
    for (std::size_t i = 0; i < piece_of_patch.size(); ++i) labels[at(piece_of_patch[i])] = label_of_patch[i];
    return labels;
}

}  // namespace

PartTree part_tree(ClusterSums clusters, const std::vector<int>& part_of_cluster, int finest,
                   const PartitionsByNumber& levels) {
    PartTree tree;
    const int parts = 1 + *std::max_element(part_of_cluster.begin(), part_of_cluster.end());
    const std::vector<int>& inside = levels.empty() ? part_of_cluster : levels.back();
    const int known = levels.empty() ? parts : static_cast<int>(levels.size()) + 1;
    Groups groups(std::move(clusters), inside);
    while (groups.count() > std::max(finest, known)) groups.unite_best(true);
    const int pieces = groups.count();
    const std::vector<int> provisional =
        provisional_numbers(groups, parts_of_groups(groups, part_of_cluster), parts);
    for (const int group : groups.group_of_cluster()) tree.piece_of_patch.push_back(provisional[at(group)]);
    groups.name_leaders(provisional);
    while (groups.count() > known) tree.unions.push_back(groups.unite_best(true));
    while (groups.count() > 2) {
        tree.unions.push_back(levels.empty() ? groups.unite_best(false)
                                             : groups.unite_same(levels[at(groups.count() - 3)]));
    }
    const std::vector<int> number = final_numbers(tree.unions, pieces, parts);
    for (int& piece : tree.piece_of_patch) piece = number[at(piece)];
    for (PieceUnion& u : tree.unions) u = {number[at(u.kept)], number[at(u.taken)], u.loss};
    return tree;
}

PartTree part_tree_of_patches(const PartitionObjective& objective, const std::vector<int>& part_of_patch,
                              const std::vector<int>& cluster_of_patch, PartitionsByNumber levels,
                              int finest) {
    const std::vector<int>& finest_known = levels.empty() ? part_of_patch : levels.back();
    const int known = 1 + *std::max_element(finest_known.begin(), finest_known.end());
    std::vector<int> pieces;
    for (std::size_t i = 0; i < part_of_patch.size(); ++i)
        pieces.push_back(cluster_of_patch[i] * known + finest_known[i]);
    pieces = renumbered(pieces);
    const int count = 1 + *std::max_element(pieces.begin(), pieces.end());
    const std::vector<int> part_of_piece = labels_of_pieces(pieces, count, part_of_patch);
    for (std::vector<int>& level : levels) level = labels_of_pieces(pieces, count, level);
    PartTree tree = part_tree(cluster_sums(objective, pieces, count), part_of_piece, finest, levels);
    for (int& piece : pieces) piece = tree.piece_of_patch[at(piece)];
    tree.piece_of_patch = std::move(pieces);
    return tree;
}

std::vector<int> labels_at_level(const PartTree& tree, int count) {
    std::vector<int> lead(at(tree.finest()));
    std::iota(lead.begin(), lead.end(), 0);
    for (int k = 0; k < tree.finest() - count; ++k) {
        const PieceUnion& u = tree.unions[at(k)];
        std::replace(lead.begin(), lead.end(), u.taken, u.kept);
    }
    std::vector<int> used = lead;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int& label : lead)
        label = static_cast<int>(std::lower_bound(used.begin(), used.end(), label) - used.begin());
    return lead;
}

}  // namespace coseg
