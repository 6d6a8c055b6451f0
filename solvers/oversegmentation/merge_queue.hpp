#pragma once
// Says which two groups to merge next: a heap with one candidate for each group, which is replaced in place
// when the group grows.

#include <vector>

namespace coseg {

/// The best merge of one group (its owner) at the time when it was found.
struct MergeCandidate {
    double change = 0.0;
    int group_a = -1, group_b = -1;  ///< group_a < group_b
    int owner = -1;                  ///< group_a or group_b
    int partner_version = 0;         ///< the version of the other group then

    [[nodiscard]] int partner() const noexcept { return owner == group_a ? group_b : group_a; }
};

/// Candidates are ordered by change, then by the lower groups.
[[nodiscard]] inline bool is_better(const MergeCandidate& x, const MergeCandidate& y) noexcept {
    if (x.change != y.change) return x.change < y.change;
    return x.group_a != y.group_a ? x.group_a < y.group_a : x.group_b < y.group_b;
}

class MergeQueue {
  public:
    /// Owners are 0 .. groups - 1.
    explicit MergeQueue(int groups);
    [[nodiscard]] bool empty() const noexcept { return heap_.empty(); }
    /// The best candidate; of two owners with the same pair either one.
    [[nodiscard]] const MergeCandidate& top() const noexcept { return heap_.front(); }
    /// Replaces the owner's candidate, if it has one.
    void set(const MergeCandidate& candidate);
    /// Nothing happens if the owner has no candidate.
    void remove(int owner);

  private:
    void place(std::size_t slot, const MergeCandidate& candidate);
    void settle(std::size_t slot, const MergeCandidate& candidate);
    [[nodiscard]] std::size_t best_child(std::size_t slot) const;

    std::vector<MergeCandidate> heap_;
    std::vector<int> slot_of_;  // per owner; -1: none
};

}  // namespace coseg
