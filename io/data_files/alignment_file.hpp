#pragma once
// alignment.json: how the shapes of a run are turned so that all stand alike.

#include <string>
#include <vector>

#include "src/records/shape_alignment.hpp"

namespace coseg {

/// x -> scale * rotation * x + translation takes the coordinates of the shape's file to the common frame, in
/// which shapes have their centre near the origin and the root mean square of a coordinate is about 1.
struct AlignedShape : ShapePose {
    std::string name;
};

struct AlignmentFile {
    bool aligned = false;  ///< if not, all rotations are the identity: the shapes stand as in their files
    std::string reason;
    double standing_share = 0.0;
    double agreement_before = 0.0;
    double agreement_after = 0.0;
    std::vector<AlignedShape> shapes;  ///< in the order of the run
};

std::string alignment_text(const AlignmentFile& alignment);

/// Throws Error(input) for a file that is not what alignment_text gives.
AlignmentFile read_alignment(const std::string& path);

}  // namespace coseg
