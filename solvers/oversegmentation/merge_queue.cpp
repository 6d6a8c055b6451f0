#include "solvers/oversegmentation/merge_queue.hpp"

#include <algorithm>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr std::size_t fan_out = 4;  // a shallower heap than the binary one, and children in two cache lines

}  // namespace

MergeQueue::MergeQueue(int groups) : slot_of_(at(groups), -1) { heap_.reserve(slot_of_.size()); }

void MergeQueue::place(std::size_t slot, const MergeCandidate& candidate) {
    heap_[slot] = candidate;
    slot_of_[at(candidate.owner)] = static_cast<int>(slot);
}

/// The slot itself if it has no children.
std::size_t MergeQueue::best_child(std::size_t slot) const {
    const std::size_t first = fan_out * slot + 1;
    const std::size_t end = std::min(first + fan_out, heap_.size());
    if (first >= end) return slot;
    std::size_t best = first;
    for (std::size_t child = first + 1; child < end; ++child) {
        if (is_better(heap_[child], heap_[best])) best = child;
    }
    return best;
}

/// Puts the candidate where it belongs on the path through `slot`, whose content is overwritten.
void MergeQueue::settle(std::size_t slot, const MergeCandidate& candidate) {
    const std::size_t start = slot;
    while (slot > 0 && is_better(candidate, heap_[(slot - 1) / fan_out])) {
        place(slot, heap_[(slot - 1) / fan_out]);
        slot = (slot - 1) / fan_out;
    }
    while (slot >= start) {
        const std::size_t child = best_child(slot);
        if (child == slot || !is_better(heap_[child], candidate)) break;
        place(slot, heap_[child]);
        slot = child;
    }
    place(slot, candidate);
}

void MergeQueue::set(const MergeCandidate& candidate) {
    int& slot = slot_of_[at(candidate.owner)];
    if (slot < 0) {
        slot = static_cast<int>(heap_.size());
        heap_.push_back(candidate);
    }
    settle(at(slot), candidate);
}

void MergeQueue::remove(int owner) {
    const int slot = std::exchange(slot_of_[at(owner)], -1);
    if (slot < 0) return;
    const MergeCandidate last = heap_.back();
    heap_.pop_back();
    if (last.owner != owner) settle(at(slot), last);
}

}  // namespace coseg
