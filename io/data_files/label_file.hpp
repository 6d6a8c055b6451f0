#pragma once
// Label files NAME.seg: one integer per input face, one a line, in the order of the mesh file's faces.

#include <string>
#include <string_view>
#include <vector>

namespace coseg {

/// What the name of a label file ends in.
inline constexpr const char* label_suffix = ".seg";

/// The names NAME of all label files NAME.seg in the folder, sorted, but for hidden ones (.NAME.seg), which
/// are what macOS leaves beside a file. Throws Error(input) naming the folder if it cannot be read.
std::vector<std::string> label_file_names(const std::string& folder);

/// Reads a label file in UTF-8 or UTF-16; blank lines are skipped. Labels may be any int. Throws
/// Error(input) naming the path if it is no regular file, and also the line if that is not one integer. If
/// expected_count >= 0 and the file has another number of labels, the error names path, last line and both
/// counts.
std::vector<int> read_labels(const std::string& path, int expected_count = -1);

/// The labels that stand in the bytes of a label file; `path` is only for the errors, which are those of
/// read_labels().
std::vector<int> parse_labels(std::string_view bytes, const std::string& path, int expected_count = -1);

/// The text of a label file.
std::string label_text(const std::vector<int>& labels);

/// Writes the file whole or not at all. Throws Error(output) as atomic_file.hpp does.
void write_labels(const std::string& path, const std::vector<int>& labels);

}  // namespace coseg
