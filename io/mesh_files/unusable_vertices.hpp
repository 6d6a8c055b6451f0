#pragma once
// Vertices whose coordinates are beyond mesh_limits.hpp. A file may have them as long as no face uses one.

#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh_files/parsed_mesh.hpp"

namespace coseg {

class UnusableVertices {
  public:
    /// Notes that the vertex has this coordinate, for which is_usable_coordinate is false. Vertices ascend; a
    /// vertex may be noted several times. `line` is that of the file, 0 in binary data.
    void add(std::int64_t vertex, double coordinate, std::int64_t line);

    /// The mesh without these vertices, with one warning if there are any. Throws Error(input), a sentence
    /// "PATH:LINE: vertex ...", for the first of them that a face uses.
    [[nodiscard]] ParsedMesh left_out_of(ParsedMesh parsed, const std::string& path) const;

  private:
    struct Place {
        std::int64_t vertex;
        double coordinate;
        std::int64_t line;
    };
    [[noreturn]] static void refuse(const Place& place, const std::string& path);

    std::vector<Place> places_;  ///< ascending by vertex, one each
};

}  // namespace coseg
