#pragma once
// The header of an OFF file: what stands at each vertex, and how many vertices and faces follow.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/text_cursor.hpp"

namespace coseg {

struct OffHeader {
    int coordinates = 3;       ///< a vertex has, with the weight
    bool has_weight = false;   ///< "4": the last coordinate divides the others
    bool has_normals = false;  ///< "N": three numbers behind the coordinates
    bool has_colours = false;  ///< "C": three or four numbers behind those
    bool has_texture = false;  ///< "ST": two numbers behind those
    std::int64_t vertex_count = 0;
    std::int64_t face_count = 0;
    /// Where the number of edges is, which nobody needs and which often lacks. A number that stands alone on
    /// the line behind the other counts could also be the first coordinate in a file of one number a line.
    enum class EdgeCount { read, absent, on_next_line, maybe_on_next_line } edge_count = EdgeCount::read;
    TextCursor behind;  ///< on the line of the last count that was read
};

/// Reads [prefixes]OFF, [dimension] and the counts. Prefixes are any of ST, C, N, 4, n in any order;
/// without a keyword the file begins with the counts. Throws Error(input) naming path and line for a header
/// that is cut short or not understood, binary OFF, and vertices of other than three dimensions.
OffHeader read_off_header(std::string_view bytes, const std::string& path);

}  // namespace coseg
