#include "src/patches/patch_numbering.hpp"

#include <numeric>

#include "src/base/index.hpp"

namespace coseg {

PatchNumbering::PatchNumbering(int oversegmentations, const std::vector<int>& patches)
    : oversegmentations_(oversegmentations),
      mesh_count_(static_cast<int>(patches.size()) / oversegmentations),
      first_(patches.size() + 1, 0) {
    std::partial_sum(patches.begin(), patches.end(), first_.begin() + 1);
}

std::vector<int> PatchNumbering::mesh_of() const {
    std::vector<int> mesh(at(patch_count()));
    for (int m = 0; m < mesh_count_; ++m) {
        for (int i = first(m, 0); i < first(m, 0) + count(m); ++i) mesh[at(i)] = m;
    }
    return mesh;
}

}  // namespace coseg
