#pragma once
// Measures how far two segmentations of one mesh agree, by the measures of the Princeton Segmentation
// Benchmark.

#include <optional>
#include <vector>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// All are errors. They are 0 for the same segmentation, whatever its numbers.
struct SegmentationAgreement {
    double rand_index_error = 0.0;          ///< 1 - Rand index over pairs of faces
    double hamming_distance = 0.0;          ///< mean of missing rate and false alarm rate, by area
    double missing_rate = 0.0;              ///< area of `reference` outside the matching segments of `answer`
    double false_alarm_rate = 0.0;          ///< area of `answer` outside the matching segments of `reference`
    double global_consistency_error = 0.0;  ///< refinement in one direction everywhere is no error
    double local_consistency_error = 0.0;   ///< refinement in either direction, face by face, is no error
    /// The mean distance over the surface from the boundaries of each to those of the other, both directions
    /// added, divided by the mean distance of the surface from its centroid. There is no value if only one of
    /// them has boundaries.
    std::optional<double> cut_discrepancy;
};

/// `reference` and `answer` hold the segment number of each face, any integers; `reference` is the
/// annotator's. geometry and graph are those of the mesh. Throws Error(internal) if lengths differ.
/// Source: Chen, Golovinskiy, Funkhouser 2009, "A benchmark for 3D mesh segmentation", section 4. Sizes of
/// segments are areas.
/// Deviates: the points of a boundary are its edges, weighted by length, and distances run over mesh edges
/// and unfolded shortcuts (src/geodesics/surface_graph.hpp).
SegmentationAgreement segmentation_agreement(const TriMesh& mesh, const FaceGeometry& geometry,
                                             const DualGraph& graph, const std::vector<int>& reference,
                                             const std::vector<int>& answer);

}  // namespace coseg
