#pragma once
// Writes levels/K/NAME.seg: the labels of every shape at each level of the tree of parts.

#include <string>
#include <vector>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/results/label_stage.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// A face has the piece of most of its patches that have its part, or, where none has, the largest piece of
/// this part in its mesh. Its label at a level follows from its piece (labels_at_level), so that levels are
/// nested face by face, and the level of K parts is that of labels/NAME.seg. Pieces of small patches may come
/// out without a face: a level is written under the number of its parts that have one, once for each number.
/// Does nothing where the cut has no tree. Collective; throws AgreedError(output).
void write_levels(const Comm& comm, const std::string& folder, const Collection& collection,
                  const CutResult& cut, const std::vector<MeshLabels>& labels);

}  // namespace coseg
