#include "io/mesh_files/corner_welder.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// What equal coordinates have in common.
double key_of(double coordinate) {
    constexpr double smallest = std::numeric_limits<float>::min();
    return std::abs(coordinate) <= smallest ? 0.0 : coordinate;
}

std::uint64_t hash_of(const Eigen::Vector3d& position) {
    const auto bits = [&](int k) { return std::bit_cast<std::uint64_t>(key_of(position[k])); };
    return mix_bits(mix_bits(mix_bits(bits(0)) ^ bits(1)) ^ bits(2));
}

}  // namespace

bool is_same_position(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return key_of(a[0]) == key_of(b[0]) && key_of(a[1]) == key_of(b[1]) && key_of(a[2]) == key_of(b[2]);
}

int CornerWelder::number_of(const Eigen::Vector3d& position) {
    std::size_t slot = slot_of(position);
    if (slots_[slot] >= 0) return slots_[slot];
    if (2 * (vertices_.size() + 1) > slots_.size()) {
        grow();
        slot = slot_of(position);
    }
    slots_[slot] = static_cast<int>(vertices_.size());
    vertices_.push_back(position);
    return slots_[slot];
}

/// The slot of the vertex at the position, else the one where it belongs.
std::size_t CornerWelder::slot_of(const Eigen::Vector3d& position) const {
    std::size_t slot = hash_of(position) & (slots_.size() - 1);
    while (slots_[slot] >= 0 && !is_same_position(vertices_[at(slots_[slot])], position))
        slot = (slot + 1) & (slots_.size() - 1);
    return slot;
}

void CornerWelder::grow() {
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t v = 0; v < vertices_.size(); ++v) slots_[slot_of(vertices_[v])] = static_cast<int>(v);
}

}  // namespace coseg
