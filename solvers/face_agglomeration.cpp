#include "solvers/face_agglomeration.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

namespace coseg {

namespace {

struct Contact {
    int group;
    double weight;
};

using Contacts = std::vector<Contact>;  // ascending by group

/// The best merge of one group, its owner, when it was pushed.
struct MergeCandidate {
    double change;
    int group_a, group_b;  // group_a < group_b
    int version_a, version_b;
    int owner;  // group_a or group_b
};

bool is_better(const MergeCandidate& x, const MergeCandidate& y) {
    return std::tie(x.change, x.group_a, x.group_b) < std::tie(y.change, y.group_a, y.group_b);
}

struct LaterCandidate {
    bool operator()(const MergeCandidate& x, const MergeCandidate& y) const { return is_better(y, x); }
};

auto find_contact(Contacts& contacts, int group) {
    return std::lower_bound(contacts.begin(), contacts.end(), group,
                            [](const Contact& c, int g) { return c.group < g; });
}

/// The groups while they grow; a group keeps the number of its lowest node.
///
/// The heap holds one candidate a group. What two groups would change is other only after one of them has grown, and a
/// group that has grown pushes its best candidate anew; so the best pair of all is the candidate of whichever of its
/// groups grew last, unless that group's best partner has grown since. Such a candidate surfaces before any worse one,
/// and is then replaced.
class Agglomeration {
  public:
    explicit Agglomeration(const WeightedGraph& graph);
    void merge_down_to(int target);
    [[nodiscard]] std::vector<int> numbered_groups();

  private:
    [[nodiscard]] MergeCandidate candidate(int owner, const Contact& contact) const;
    void push_best(int owner);
    [[nodiscard]] bool is_current(int group, int version) const;
    void merge(int a, int b);
    void unite_contacts(int a, int b);
    void redirect(int neighbor, int from, int to);
    int root(int node);

    std::vector<double> mass_;
    std::vector<double> cut_;
    std::vector<Contacts> contacts_;
    std::vector<int> version_;  // counts a group's merges; -1 once it is part of another
    std::vector<int> parent_;
    Contacts both_;  // scratch of unite_contacts
    std::priority_queue<MergeCandidate, std::vector<MergeCandidate>, LaterCandidate> candidates_;
    int groups_;
};

Agglomeration::Agglomeration(const WeightedGraph& graph)
    : mass_(graph.mass),
      cut_(graph.mass.size(), 0.0),
      contacts_(graph.mass.size()),
      version_(graph.mass.size(), 0),
      parent_(graph.mass.size()),
      groups_(graph.node_count()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t v = 0; v < mass_.size(); ++v) {
        for (auto k = static_cast<std::size_t>(graph.offsets[v]);
             k < static_cast<std::size_t>(graph.offsets[v + 1]); ++k) {
            contacts_[v].push_back({graph.neighbors[k], graph.weights[k]});
            cut_[v] += graph.weights[k];
        }
    }
    for (int v = 0; v < groups_; ++v) push_best(v);
}

MergeCandidate Agglomeration::candidate(int owner, const Contact& contact) const {
    const auto i = static_cast<std::size_t>(std::min(owner, contact.group));
    const auto j = static_cast<std::size_t>(std::max(owner, contact.group));
    const double change = (cut_[i] + cut_[j] - 2.0 * contact.weight) / (mass_[i] + mass_[j]) -
                          cut_[i] / mass_[i] - cut_[j] / mass_[j];
    return {change, static_cast<int>(i), static_cast<int>(j), version_[i], version_[j], owner};
}

void Agglomeration::push_best(int owner) {
    const Contacts& contacts = contacts_[static_cast<std::size_t>(owner)];
    if (contacts.empty()) return;
    MergeCandidate best = candidate(owner, contacts.front());
    for (const Contact& c : contacts) {
        const MergeCandidate other = candidate(owner, c);
        if (is_better(other, best)) best = other;
    }
    candidates_.push(best);
}

bool Agglomeration::is_current(int group, int version) const {
    return version_[static_cast<std::size_t>(group)] == version;
}

void Agglomeration::merge_down_to(int target) {
    while (groups_ > target && !candidates_.empty()) {
        const MergeCandidate best = candidates_.top();
        candidates_.pop();
        const bool a_stands = is_current(best.group_a, best.version_a);
        const bool b_stands = is_current(best.group_b, best.version_b);
        if (a_stands && b_stands)
            merge(best.group_a, best.group_b);
        else if (best.owner == best.group_a ? a_stands : b_stands)
            push_best(best.owner);
    }
}

void Agglomeration::merge(int a, int b) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    for (const Contact& c : contacts_[j]) {
        if (c.group != a) redirect(c.group, b, a);
    }
    unite_contacts(a, b);
    mass_[i] += mass_[j];
    // Summed anew: cut_a + cut_b - 2 c_ab would carry rounding errors from merge to merge.
    cut_[i] = 0.0;
    for (const Contact& c : contacts_[i]) cut_[i] += c.weight;
    ++version_[i];
    version_[j] = -1;
    parent_[j] = a;
    --groups_;
    push_best(a);
}

void Agglomeration::unite_contacts(int a, int b) {
    Contacts& x = contacts_[static_cast<std::size_t>(a)];
    Contacts& y = contacts_[static_cast<std::size_t>(b)];
    both_.clear();
    std::merge(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both_),
               [](const Contact& p, const Contact& q) { return p.group < q.group; });
    x.clear();
    y = {};
    for (const Contact& c : both_) {
        if (c.group == a || c.group == b) continue;
        if (!x.empty() && x.back().group == c.group) {
            x.back().weight += c.weight;
        } else {
            x.push_back(c);
        }
    }
}

/// In the neighbour's list, what it shared with `from` it now shares with `to`.
void Agglomeration::redirect(int neighbor, int from, int to) {
    Contacts& contacts = contacts_[static_cast<std::size_t>(neighbor)];
    const auto old = find_contact(contacts, from);
    const double weight = old->weight;
    contacts.erase(old);
    const auto place = find_contact(contacts, to);
    if (place != contacts.end() && place->group == to) {
        place->weight += weight;
    } else {
        contacts.insert(place, {to, weight});
    }
}

int Agglomeration::root(int node) {
    while (parent_[static_cast<std::size_t>(node)] != node) {
        int& parent = parent_[static_cast<std::size_t>(node)];
        parent = parent_[static_cast<std::size_t>(parent)];
        node = parent;
    }
    return node;
}

std::vector<int> Agglomeration::numbered_groups() {
    std::vector<int> group(mass_.size(), -1);
    int count = 0;
    for (std::size_t v = 0; v < mass_.size(); ++v) {
        const int lowest = root(static_cast<int>(v));  // <= v, so numbered before its other nodes
        group[v] = lowest == static_cast<int>(v) ? count++ : group[static_cast<std::size_t>(lowest)];
    }
    return group;
}

}  // namespace

std::vector<int> agglomerate(const WeightedGraph& graph, int target) {
    Agglomeration agglomeration(graph);
    agglomeration.merge_down_to(target);
    return agglomeration.numbered_groups();
}

}  // namespace coseg
