#pragma once
// Some meshes of a collection as a collection of their own, for the stages after the features.

#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"

namespace coseg {

struct PartCollection {
    Collection collection;      ///< without meshes' geometry, graphs and descriptors
    PatchFeatures features;     ///< columns of these meshes' patches
    std::vector<int> patch_of;  ///< per patch its number in the whole collection
};

/// `meshes`: numbers in the collection, ascending. Collective; the same on every rank but for the local
/// meshes.
PartCollection part_of_collection(const Comm& comm, const Collection& collection,
                                  const PatchFeatures& features, const std::vector<int>& meshes);

}  // namespace coseg
