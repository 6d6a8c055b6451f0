#pragma once
// Removes specks and teeth from a labelling of faces.

#include <vector>

#include "src/mesh/dual_graph.hpp"

namespace coseg {

/// Every piece of fewer than `minimum_faces` faces takes the label with which it shares the longest boundary,
/// the smallest piece first. A piece is a connected set of faces of one label, where virtual edges do not
/// count. A piece without neighbours stays. labels: F entries, changed in place.
void merge_label_islands(const DualGraph& graph, int minimum_faces, std::vector<int>& labels);

/// A face two of whose neighbours share another label takes that label, until there is no such face.
/// Boundaries thus lose the teeth that cutting at whole triangles leaves. Faces are visited in ascending
/// order, so that the result is unique.
void remove_label_teeth(const DualGraph& graph, std::vector<int>& labels);

}  // namespace coseg
