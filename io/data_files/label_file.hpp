#pragma once
// Label files NAME.seg: one integer per input face, one a line, in the order of the mesh file's faces.

#include <string>
#include <vector>

namespace coseg {

/// Reads a label file; blank lines are passed over. Labels may be any int.
/// Throws Error(input) naming path and line if a line is not one integer, and path, last line and both counts
/// if expected_count >= 0 and the file has another number of labels.
std::vector<int> read_labels(const std::string& path, int expected_count = -1);

/// Writes whole or not at all (atomic_file.hpp); Error(output) as there.
void write_labels(const std::string& path, const std::vector<int>& labels);

}  // namespace coseg
