#include "io/mesh_files/mesh_limits.hpp"

namespace coseg {

std::string bad_coordinate(std::int64_t vertex, double value) {
    return "vertex " + std::to_string(vertex) +
           (std::isfinite(value) ? " has a coordinate beyond 1e37; scale the mesh down"
                                 : " has a coordinate that is not a finite number; correct it");
}

std::string bad_index(std::int64_t face, std::int64_t index, std::int64_t vertices) {
    return "face " + std::to_string(face) + " refers to vertex " + std::to_string(index) +
           ", but there are " + std::to_string(vertices) +
           " vertices (counted from 0); correct the face or export the mesh again";
}

}  // namespace coseg
