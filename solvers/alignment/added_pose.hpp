#pragma once
// Turns a shape that comes after a run to where it stands like the run's shapes.

#include <cstdint>
#include <tuple>

#include "solvers/alignment/rotation_fit.hpp"
#include "src/records/fields.hpp"
#include "src/records/shape_alignment.hpp"

namespace coseg {

/// What a shape that comes later must know of how the shapes of a run stand.
struct FrameOfShapes {
    /// Mean over the run's shapes of the agreement of their links in the frame; 0 where nothing is to be
    /// turned.
    double agreement = 0.0;
    /// Whether the frame is that of the files, in which most shapes stood alike; else each has been turned.
    bool as_in_files = true;
    static constexpr auto fields() {
        return std::tuple(field("agreement", &FrameOfShapes::agreement),
                          field("as_in_files", &FrameOfShapes::as_in_files));
    }
};

/// Of a run that was aligned so.
FrameOfShapes frame_of_shapes(const ShapeAlignment& alignment);

/// How a new shape is turned, and how well its links agree as it stands in its file.
struct AddedPose {
    ShapePose pose;
    double agreement_in_file = 0.0;
    static constexpr auto fields() {
        return std::tuple(field("pose", &AddedPose::pose),
                          field("agreement_in_file", &AddedPose::agreement_in_file));
    }
};

/// The pose, without scale and translation, of a new shape whose patches are linked with those of the run's
/// shapes, which lie in the frame. Its rotation is fitted from the 24 turns by right angles and 40 hashed
/// ones.
///
/// In a frame of the files it is turned only if its links then agree at least twice as well, and at least
/// half as well as those of the run's shapes, as the outliers of a run are (shape_alignment.hpp). In any
/// other frame it is always turned, mirrored if its links then agree better by a sixth, and not found where
/// they agree less than half as well as those of the run's shapes.
///
/// Deviates: this is not in the paper.
AddedPose added_pose(const LinkedPoints& links, const FrameOfShapes& frame, std::uint64_t seed);

}  // namespace coseg
