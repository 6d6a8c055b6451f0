#pragma once
// Removes specks and teeth from a labelling of faces.

#include <vector>

#include "src/mesh/dual_graph.hpp"

namespace coseg {

/// Pieces (connected faces of one label, virtual edges left out) of fewer than `minimum_faces` faces take the
/// label with which they share the longest boundary, the smallest piece first. A piece without neighbours
/// stays. labels: F entries, changed in place.
void merge_label_islands(const DualGraph& graph, int minimum_faces, std::vector<int>& labels);

/// A face two of whose neighbours share another label takes that label, until there is none: boundaries lose
/// the teeth that cutting at whole triangles leaves. Faces in ascending order, so the result is one.
void remove_label_teeth(const DualGraph& graph, std::vector<int>& labels);

}  // namespace coseg
