#pragma once
// Makes families of shapes with true labels in code. On such collections co-segmentation can be tried and
// tested.

#include <cstdint>
#include <string>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// A closed, connected manifold mesh of about one unit in size, with z up, and a label per face.
struct LabeledShape {
    TriMesh mesh;
    std::vector<int> face_label;           ///< F, an index into label_names
    std::vector<std::string> label_names;  ///< all labels of the family, whether this shape has them or not
};

struct ShapeFamily {
    std::string name;
    std::string description;
    std::vector<std::string> labels;
};

/// All families, in the order in which they are listed to users.
const std::vector<ShapeFamily>& shape_families();

/// The family whose name differs from `name` by the fewest letters inserted, deleted or replaced.
const ShapeFamily& nearest_family(const std::string& name);

/// The family of that name. Throws Error(usage) with the list of families and the nearest name.
const ShapeFamily& shape_family(const std::string& name);

inline constexpr int least_generated_faces = 500;
inline constexpr int most_generated_faces = 200'000;
inline constexpr int most_generated_shapes = 1'000'000;  ///< in one collection

/// Shape `index` of the endless collection that `seed` gives. The number of its faces is within 15 % of
/// `target_faces`, and its triangles are even. It is a function of the arguments alone. Boundaries of parts
/// lie in the creases between the solids that make up the shape. Throws Error(usage) for an unknown family or
/// target_faces outside least_generated_faces .. most_generated_faces.
LabeledShape generate_shape(const std::string& family, std::uint64_t seed, int index, int target_faces);

}  // namespace coseg
