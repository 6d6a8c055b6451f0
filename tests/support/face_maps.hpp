#pragma once
// Maps from working faces to input faces.

#include <numeric>

#include "src/mesh/face_map.hpp"

namespace coseg::test {

/// Every working face is the input face of the same number.
inline FaceMap identity_map(int faces) {
    FaceMap map;
    map.input_faces = faces;
    map.input_face.resize(static_cast<std::size_t>(faces));
    std::iota(map.input_face.begin(), map.input_face.end(), 0);
    map.label_donor = map.input_face;
    return map;
}

}  // namespace coseg::test
