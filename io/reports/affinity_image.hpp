#pragma once
// DIR/affinity.png: the links of all patches, sorted by part. Format of the rows: docs/formats.md,
// `partition.affinity`. Source: Hu, Fan, Liu 2012, Figure 4.

#include <string>
#include <vector>

#include "src/pictures/image.hpp"

namespace coseg {

/// The image of the affinity. rows: n texts of n digits 0-9a-z. part_ends: the bin after the last of each
/// part, ascending, at most n. White means no link, dark blue the strongest. Lines separate the parts, and a
/// strip in each part's colour runs along the top and the left. The image is at least 480 pixels wide.
/// Without rows it is empty.
Image affinity_image(const std::vector<std::string>& rows, const std::vector<int>& part_ends);

}  // namespace coseg
