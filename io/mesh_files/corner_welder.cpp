#include "io/mesh_files/corner_welder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// What equal coordinates have in common.
double key_of(double coordinate, double negligible) {
    return std::abs(coordinate) <= negligible ? 0.0 : coordinate;
}

std::uint64_t hash_of(const Eigen::Vector3d& position, double negligible) {
    const auto bits = [&](int k) { return std::bit_cast<std::uint64_t>(key_of(position[k], negligible)); };
    return mix_bits(mix_bits(mix_bits(bits(0)) ^ bits(1)) ^ bits(2));
}

}  // namespace

bool is_same_position(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double negligible) {
    const auto is_same = [&](int k) { return key_of(a[k], negligible) == key_of(b[k], negligible); };
    return is_same(0) && is_same(1) && is_same(2);
}

bool is_tiny(const std::vector<Eigen::Vector3d>& vertices) {
    constexpr double largest = 1e-30;
    return std::all_of(vertices.begin(), vertices.end(),
                       [](const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff() < largest; });
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
    std::size_t slot = hash_of(position, negligible_) & (slots_.size() - 1);
    while (slots_[slot] >= 0 && !is_same_position(vertices_[at(slots_[slot])], position, negligible_))
        slot = (slot + 1) & (slots_.size() - 1);
    return slot;
}

void CornerWelder::grow() {
    slots_.assign(2 * slots_.size(), -1);
    for (std::size_t v = 0; v < vertices_.size(); ++v) slots_[slot_of(vertices_[v])] = static_cast<int>(v);
}

}  // namespace coseg
