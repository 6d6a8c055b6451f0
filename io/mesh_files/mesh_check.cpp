#include "io/mesh_files/mesh_check.hpp"

#include <cmath>

namespace coseg {

std::string bad_index(long long face, long long index, long long vertices) {
    return "face " + std::to_string(face) + " refers to vertex " + std::to_string(index) +
           ", but there are " + std::to_string(vertices) +
           " vertices (counted from 0); correct the face or export the mesh again";
}

std::string bad_coordinate(long long vertex, double value) {
    if (!std::isfinite(value)) {
        return "vertex " + std::to_string(vertex) +
               " has a coordinate that is not a finite number; correct it";
    }
    if (std::abs(value) > largest_coordinate) {
        return "vertex " + std::to_string(vertex) + " has a coordinate beyond 1e37; scale the mesh down";
    }
    return {};
}

}  // namespace coseg
