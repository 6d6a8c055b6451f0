#pragma once
// Numbers the patches of the whole collection: by mesh in the collection's order, then by over-segmentation,
// then by patch.
//
// Example: mesh 0 has over-segmentations of 3 and 2 patches, mesh 1 of 4 and 4. The numbers are 0-2, 3-4 |
// 5-8, 9-12.

#include <cstdint>
#include <vector>

#include "src/base/index.hpp"

namespace coseg {

class PatchNumbering {
  public:
    /// patches[m * oversegmentations + s]: patches in over-segmentation s of mesh m.
    PatchNumbering(int oversegmentations, const std::vector<int>& patches);

    [[nodiscard]] int oversegmentations() const noexcept { return oversegmentations_; }
    [[nodiscard]] int mesh_count() const noexcept { return mesh_count_; }
    [[nodiscard]] int patch_count() const noexcept { return first_.back(); }

    /// First global number of over-segmentation `s` of mesh `m`.
    [[nodiscard]] int first(int m, int s) const { return first_[index(m, s)]; }
    [[nodiscard]] int count(int m, int s) const { return first_[index(m, s) + 1] - first_[index(m, s)]; }

    /// Patches of all over-segmentations of mesh `m`.
    [[nodiscard]] int count(int m) const { return first_[index(m + 1, 0)] - first_[index(m, 0)]; }

    /// The mesh of every patch, ascending.
    [[nodiscard]] std::vector<int> mesh_of() const;

  private:
    [[nodiscard]] std::size_t index(int m, int s) const { return at(m) * at(oversegmentations_) + at(s); }
    int oversegmentations_;
    int mesh_count_;
    std::vector<int> first_;
};

}  // namespace coseg
