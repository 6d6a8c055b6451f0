#pragma once
// How many parts there may be.

namespace coseg {

/// The largest K of a partition, of clusters and of examples, and the number of parts that corrections may
/// make.
inline constexpr int most_parts = 1000;

}  // namespace coseg
