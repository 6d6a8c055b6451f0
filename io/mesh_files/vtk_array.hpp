#pragma once
// The numbers of the arrays (DataArray) of VTK's XML files, in all ways in which they are written there.
// Source: VTK File Formats, XML formats.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace coseg {

/// What the whole file says about its arrays.
struct VtkEncoding {
    bool is_big_endian = false;
    bool has_long_headers = false;  ///< lengths have 64 bits, not 32
    std::string compressor = {};    ///< of arrays that are no text; empty if they are not compressed
    bool has_base64_appended = false;
    std::string_view appended = {};  ///< the bytes or the base64 of the arrays behind the XML
};

struct VtkArray {
    std::string what;       ///< for messages: "'offsets' of Polys"
    std::string type;       ///< "Float32"
    std::string format;     ///< "ascii", "binary" (base64) or "appended"
    std::string_view text;  ///< of the first two
    std::string offset;     ///< of the last: where the array begins in VtkEncoding::appended
};

/// All numbers of the array. Throws Error(input), a sentence that begins with "PATH: " and names the array,
/// where it is cut short, holds what is no number, or is written in a way that is not known, as by a
/// compressor other than zlib. Takes memory for
/// what is there, never for what a length promises.
std::vector<double> vtk_reals(const VtkArray& array, const VtkEncoding& encoding, const std::string& path);

/// The same for an array of whole numbers; those beyond 2^63 - 1 are then negative.
std::vector<std::int64_t> vtk_integers(const VtkArray& array, const VtkEncoding& encoding,
                                       const std::string& path);

}  // namespace coseg
