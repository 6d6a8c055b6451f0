#include "mpi_drivers/editing/linked_places.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// Trials after which the search gives up. Real files need no more than a few for each place.
constexpr int most_trials = 200'000;

[[noreturn]] void contradiction(const std::string& one, const std::string& other, const std::string& why) {
    throw Error(ExitCode::input, one + " and " + other + " contradict each other: " + why);
}

/// Places that must have the same part.
struct PlaceGroup {
    int said = -1;
    std::string said_by;
    Eigen::VectorXd scores;
    std::vector<char> allowed;     ///< of each part
    std::vector<std::string> why;  ///< of each part that is not allowed
    std::string member;            ///< a must-link of the group; empty where it is one place
    std::vector<std::pair<int, std::size_t>> others;  ///< groups of another part, and by which link
};

class LinkedGroups {
  public:
    LinkedGroups(const std::vector<LinkedPlace>& places, const std::vector<PlaceLink>& links)
        : places_(places), links_(links), group_of_(places.size()) {
        std::iota(group_of_.begin(), group_of_.end(), 0);
        join();
    }

    void gather(const Eigen::MatrixXi& allowed, const std::vector<std::vector<std::string>>& why_not) {
        const Eigen::Index parts = allowed.rows();
        for (std::size_t p = 0; p < places_.size(); ++p) {
            PlaceGroup& group = groups_[at(group_of_[p])];
            const LinkedPlace& place = places_[p];
            if (group.scores.size() == 0) {
                group.scores = Eigen::VectorXd::Zero(parts);
                group.allowed.assign(at(parts), 1);
                group.why.assign(at(parts), "");
            }
            group.scores += place.scores;
            if (place.said >= 0 && group.said >= 0 && place.said != group.said)
                contradiction(group.said_by, place.said_by,
                              group.member + " joins places of part " + std::to_string(group.said) + " and " +
                                  std::to_string(place.said));
            if (place.said >= 0) {
                group.said = place.said;
                group.said_by = place.said_by;
            }
            for (Eigen::Index part = 0; part < parts; ++part) {
                if (allowed(part, place.mesh) != 0) continue;
                group.allowed[at(part)] = 0;
                group.why[at(part)] = why_not[at(part)][at(place.mesh)];
            }
        }
        for (const PlaceGroup& group : groups_) {
            if (group.said >= 0 && group.allowed[at(group.said)] == 0)
                contradiction(group.said_by, group.why[at(group.said)],
                              group.member.empty() ? "a place has a part that its shape does not have"
                                                   : group.member + " carries the part to that shape");
        }
    }

    void separate() {
        for (std::size_t k = 0; k < links_.size(); ++k) {
            if (links_[k].same) continue;
            const int a = group_of_[at(links_[k].a)];
            const int b = group_of_[at(links_[k].b)];
            if (a == b)
                contradiction(links_[k].text, groups_[at(a)].member, "must-links join the two places");
            const PlaceGroup& one = groups_[at(a)];
            const PlaceGroup& other = groups_[at(b)];
            if (one.said >= 0 && one.said == other.said)
                contradiction(links_[k].text, one.said_by,
                              "both places are said to have part " + std::to_string(one.said) + ", by " +
                                  other.said_by + " too");
            groups_[at(a)].others.emplace_back(b, k);
            groups_[at(b)].others.emplace_back(a, k);
        }
    }

    std::vector<int> decided() {
        order_groups();
        part_.assign(groups_.size(), -1);
        if (!decide(0)) {
            if (trials_ >= most_trials)
                throw Error(ExitCode::input,
                            "no parts were found that meet all links; leave out some of the " +
                                std::to_string(links_.size()));
            const PlaceGroup& stuck = groups_[at(order_[deepest_])];
            if (stuck.others.size() < 2) {
                const auto why = std::find_if(stuck.why.begin(), stuck.why.end(),
                                              [](const std::string& text) { return !text.empty(); });
                contradiction(stuck.others.empty() ? stuck.member : links_[stuck.others.front().second].text,
                              why != stuck.why.end() ? *why : "having one part alone", "no part is left");
            }
            contradiction(links_[stuck.others[0].second].text, links_[stuck.others[1].second].text,
                          "there are too few parts for all places that must differ");
        }
        std::vector<int> parts;
        for (const int group : group_of_) parts.push_back(part_[at(group)]);
        return parts;
    }

  private:
    void join() {
        std::vector<std::string> member(places_.size());
        for (const PlaceLink& link : links_) {
            if (!link.same) continue;
            const int a = group_of_[at(link.a)];
            const int b = group_of_[at(link.b)];
            const int kept = std::min(a, b);
            std::replace(group_of_.begin(), group_of_.end(), std::max(a, b), kept);
            member[at(kept)] = link.text;
        }
        std::vector<int> number(places_.size(), -1);
        for (int& group : group_of_) {
            if (number[at(group)] < 0) {
                number[at(group)] = static_cast<int>(groups_.size());
                groups_.emplace_back();
                groups_.back().member = member[at(group)];
            }
            group = number[at(group)];
        }
    }

    /// What is said first, then by falling difference between the best part and the next.
    void order_groups() {
        std::vector<double> clear;
        for (const PlaceGroup& group : groups_) {
            std::vector<double> scores(group.scores.data(), group.scores.data() + group.scores.size());
            std::sort(scores.rbegin(), scores.rend());
            clear.push_back(group.said >= 0 ? 1e9 : scores.size() > 1 ? scores[0] - scores[1] : 0.0);
        }
        order_.resize(groups_.size());
        std::iota(order_.begin(), order_.end(), 0);
        std::stable_sort(order_.begin(), order_.end(),
                         [&](int a, int b) { return clear[at(a)] > clear[at(b)]; });
    }

    bool decide(std::size_t depth) {
        if (depth == order_.size()) return true;
        deepest_ = std::max(deepest_, depth);
        const int g = order_[depth];
        const PlaceGroup& group = groups_[at(g)];
        std::vector<int> parts;
        for (int part = 0; part < static_cast<int>(group.allowed.size()); ++part) {
            const bool is_taken =
                std::any_of(group.others.begin(), group.others.end(),
                            [&](const auto& other) { return part_[at(other.first)] == part; });
            if (group.allowed[at(part)] != 0 && !is_taken && (group.said < 0 || group.said == part))
                parts.push_back(part);
        }
        std::stable_sort(parts.begin(), parts.end(),
                         [&](int a, int b) { return group.scores[a] > group.scores[b]; });
        for (const int part : parts) {
            if (++trials_ >= most_trials) return false;
            part_[at(g)] = part;
            if (decide(depth + 1)) return true;
        }
        part_[at(g)] = -1;
        return false;
    }

    const std::vector<LinkedPlace>& places_;
    const std::vector<PlaceLink>& links_;
    std::vector<int> group_of_;
    std::vector<PlaceGroup> groups_;
    std::vector<int> order_;
    std::vector<int> part_;
    std::size_t deepest_ = 0;
    int trials_ = 0;
};

}  // namespace

std::vector<int> parts_of_places(const std::vector<LinkedPlace>& places, const std::vector<PlaceLink>& links,
                                 const Eigen::MatrixXi& allowed,
                                 const std::vector<std::vector<std::string>>& why_not) {
    LinkedGroups groups(places, links);
    groups.gather(allowed, why_not);
    groups.separate();
    return groups.decided();
}

}  // namespace coseg
