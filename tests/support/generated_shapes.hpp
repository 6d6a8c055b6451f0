#pragma once
// Shapes with known parts that the program can make, for tests that should not depend on measured meshes.

#include <string>
#include <utility>
#include <vector>

#include "src/families/shape_families.hpp"

namespace coseg::test {

/// One chair, one aeroplane and one human of about 3,000 faces, as `coseg generate FAMILY --seed 1` makes
/// them, each with the name of its family. The meshes are closed and their faces have true labels.
inline std::vector<std::pair<std::string, LabeledShape>> generated_shapes() {
    std::vector<std::pair<std::string, LabeledShape>> shapes;
    for (const char* family : {"chair", "airplane", "human"})
        shapes.emplace_back(family, generate_shape(family, 1, 0, 3000));
    return shapes;
}

}  // namespace coseg::test
