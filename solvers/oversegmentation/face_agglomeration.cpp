#include "solvers/oversegmentation/face_agglomeration.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "solvers/oversegmentation/merge_queue.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

struct Contact {
    int group;
    double weight;
};

/// The lists of what each group touches, ascending by group, in one array: a list of its own in every group
/// would cost more in allocations than all merges do.
class ContactLists {
  public:
    explicit ContactLists(const WeightedGraph& graph);
    [[nodiscard]] std::span<const Contact> of(int group) const {
        const Place& place = places_[at(group)];
        return {contacts_.data() + place.begin, at(place.size)};
    }
    void unite(int a, int b);
    void redirect(int neighbor, int from, int to);

  private:
    struct Place {
        std::size_t begin;
        int size;
        int room;
    };
    void merge_both(int a, int b);
    std::vector<Contact> contacts_;
    std::vector<Place> places_;
    std::vector<Contact> both_;  // scratch of unite
};

ContactLists::ContactLists(const WeightedGraph& graph) {
    contacts_.reserve(2 * graph.neighbors.size());
    for (std::size_t k = 0; k < graph.neighbors.size(); ++k)
        contacts_.push_back({graph.neighbors[k], graph.weights[k]});
    places_.reserve(graph.mass.size());
    for (std::size_t v = 0; v < graph.mass.size(); ++v) {
        const int size = graph.offsets[v + 1] - graph.offsets[v];
        places_.push_back({at(graph.offsets[v]), size, size});
    }
}

/// Fills both_ with the contacts of a and b to other groups.
void ContactLists::merge_both(int a, int b) {
    both_.clear();
    const std::span<const Contact> x = of(a);
    const std::span<const Contact> y = of(b);
    auto j = y.begin();
    const auto take = [&](const Contact& c) {
        if (c.group != a && c.group != b) both_.push_back(c);
    };
    for (const Contact& c : x) {
        while (j != y.end() && j->group < c.group) take(*j++);
        take(c);
        if (j == y.end() || j->group != c.group) continue;
        both_.back().weight += j->weight;
        ++j;
    }
    while (j != y.end()) take(*j++);
}

/// Lets a touch everything that a and b touched, and b nothing.
void ContactLists::unite(int a, int b) {
    merge_both(a, b);
    Place& place = places_[at(a)];
    const int size = static_cast<int>(both_.size());
    if (size > place.room) {
        place.begin = contacts_.size();
        place.room = 2 * size;
        contacts_.resize(contacts_.size() + at(place.room));
    }
    place.size = size;
    std::copy(both_.begin(), both_.end(), contacts_.begin() + static_cast<std::ptrdiff_t>(place.begin));
    places_[at(b)].size = 0;
}

/// In the neighbour's list, moves what it shared with `from` to `to`, which is the lower number.
void ContactLists::redirect(int neighbor, int from, int to) {
    Place& place = places_[at(neighbor)];
    Contact* const list = contacts_.data() + place.begin;
    int old = 0;
    while (list[old].group != from) ++old;
    const double weight = list[old].weight;
    int target = old;
    while (target > 0 && list[target - 1].group >= to) --target;
    if (list[target].group == to) {
        list[target].weight += weight;
        std::copy(list + old + 1, list + place.size, list + old);
        --place.size;
    } else {
        std::copy_backward(list + target, list + old, list + old + 1);
        list[target] = {to, weight};
    }
}

struct Group {
    double mass;
    double cut;      // weight of the boundary
    double density;  // cut / mass
    int version;     // counts the merges; -1 once it is part of another
};

/// The groups while they grow. A group keeps the number of its lowest node.
///
/// The queue holds one candidate for each group. The change that merging two groups would bring differs only
/// after one of them has grown, and a group that has grown looks for its best candidate again. The best pair
/// of all is therefore the candidate of whichever of its groups grew last, unless that group's best partner
/// has grown since. Such a candidate comes to the top before any worse one, and is then replaced.
class Agglomeration {
  public:
    explicit Agglomeration(const WeightedGraph& graph);
    void merge_down_to(int target);
    [[nodiscard]] std::vector<int> numbered_groups();

  private:
    [[nodiscard]] double change(int a, int b, double shared) const;
    [[nodiscard]] MergeCandidate best_of(int owner, std::span<const Contact> contacts) const;
    void renew_candidate(int owner);
    void merge(int a, int b);
    int root(int node);

    std::vector<Group> groups_;
    ContactLists contacts_;
    std::vector<int> parent_;
    MergeQueue candidates_;
    int count_;
};

Agglomeration::Agglomeration(const WeightedGraph& graph)
    : contacts_(graph),
      parent_(graph.mass.size()),
      candidates_(graph.node_count()),
      count_(graph.node_count()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    groups_.reserve(graph.mass.size());
    for (int v = 0; v < count_; ++v) {
        const double mass = graph.mass[at(v)];
        double cut = 0.0;
        for (const Contact& c : contacts_.of(v)) cut += c.weight;
        groups_.push_back({mass, cut, cut / mass, 0});
    }
    for (int v = 0; v < count_; ++v) renew_candidate(v);
}

/// The change of the sum over groups of cut / mass if a and b were merged; a < b, so that both see the same
/// rounding.
double Agglomeration::change(int a, int b, double shared) const {
    const Group& x = groups_[at(a)];
    const Group& y = groups_[at(b)];
    return (x.cut + y.cut - 2.0 * shared) / (x.mass + y.mass) - x.density - y.density;
}

MergeCandidate Agglomeration::best_of(int owner, std::span<const Contact> contacts) const {
    MergeCandidate best;
    for (const Contact& c : contacts) {
        const auto [a, b] = std::minmax(owner, c.group);
        const MergeCandidate other{change(a, b, c.weight), a, b, owner, 0};
        if (best.owner < 0 || is_better(other, best)) best = other;
    }
    const int partner = best.partner();
    best.partner_version = groups_[at(partner)].version;
    return best;
}

void Agglomeration::renew_candidate(int owner) {
    const std::span<const Contact> contacts = contacts_.of(owner);
    if (contacts.empty())
        candidates_.remove(owner);
    else
        candidates_.set(best_of(owner, contacts));
}

void Agglomeration::merge_down_to(int target) {
    while (count_ > target && !candidates_.empty()) {
        const MergeCandidate best = candidates_.top();
        const Group& partner = groups_[at(best.partner())];
        if (partner.version == best.partner_version)
            merge(best.group_a, best.group_b);
        else
            renew_candidate(best.owner);
    }
}

void Agglomeration::merge(int a, int b) {
    for (const Contact& c : contacts_.of(b)) {
        if (c.group != a) contacts_.redirect(c.group, b, a);
    }
    contacts_.unite(a, b);
    Group& grown = groups_[at(a)];
    Group& absorbed = groups_[at(b)];
    grown.mass += absorbed.mass;
    // The cut is summed again, because cut_a + cut_b - 2 c_ab would carry rounding errors from merge to
    // merge.
    grown.cut = 0.0;
    for (const Contact& c : contacts_.of(a)) grown.cut += c.weight;
    grown.density = grown.cut / grown.mass;
    ++grown.version;
    absorbed.version = -1;
    parent_[at(b)] = a;
    --count_;
    candidates_.remove(b);
    renew_candidate(a);
}

int Agglomeration::root(int node) {
    while (parent_[at(node)] != node) {
        int& parent = parent_[at(node)];
        parent = parent_[at(parent)];
        node = parent;
    }
    return node;
}

std::vector<int> Agglomeration::numbered_groups() {
    std::vector<int> group(parent_.size(), -1);
    int count = 0;
    for (std::size_t v = 0; v < parent_.size(); ++v) {
        const int lowest = root(static_cast<int>(v));  // <= v, so numbered before its other nodes
        group[v] = lowest == static_cast<int>(v) ? count++ : group[at(lowest)];
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
