#pragma once
// For `coseg run --keep-features`: writes what the optimiser and the cut were given as a file that `coseg
// cluster` reads.

#include <string>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Writes features, meshes, areas, neighbours and overlaps of all patches. Collective; AgreedError(output).
void write_features(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                    const std::string& path);

}  // namespace coseg
