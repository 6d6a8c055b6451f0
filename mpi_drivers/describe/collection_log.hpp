#pragma once
// What is said of a collection that has been described.

#include <string>

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/parallel/stage_log.hpp"

namespace coseg {

/// "20 shapes, 60000 faces, 3000 patches, 12 from the state folder".
std::string described_summary(const Collection& collection);

/// Says which meshes were set aside and what is unusual about others, ten sentences at most.
void warn_of_meshes(const Collection& collection, const StageLog& log);

}  // namespace coseg
