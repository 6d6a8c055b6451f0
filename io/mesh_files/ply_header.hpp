#pragma once
// The header of a PLY file: which elements follow, and what each of them holds.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coseg {

enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64, unknown };

struct PlyProperty {
    std::string name;
    PlyScalar type = PlyScalar::float32;  ///< unknown in ASCII only, where it does not matter
    std::optional<PlyScalar> list_count;  ///< the type of the count if the property is a list
};

struct PlyElement {
    std::string name;        ///< as printable() shows it
    std::int64_t count = 0;  ///< 0 .. 2^31 - 1, as the header promises
    std::vector<PlyProperty> properties;
};

/// Whether the property is the list of the corners of a face or of a strip.
bool is_corner_list(const PlyProperty& property);

struct PlyHeader {
    bool is_binary = false;
    bool is_big_endian = false;
    std::vector<PlyElement> elements;
    std::size_t data_offset = 0;  ///< where the data begins, in bytes
    std::int64_t lines = 0;
};

/// Throws Error(input) naming path and line for a header that is cut short or not understood, and for a
/// binary file with a type whose size is unknown.
PlyHeader read_ply_header(std::string_view bytes, const std::string& path);

/// The least number of bytes that an element takes: for a list those of its count, for a number in ASCII a
/// digit and the separator from the next one.
std::size_t least_bytes(const PlyElement& element, bool is_binary);

}  // namespace coseg
