#pragma once
// Makes a collection of some meshes of another one, for the stages after the features.

#include <vector>

#include "mpi_drivers/describe/feature_stage.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"

namespace coseg {

struct PartCollection {
    Collection collection;      ///< without meshes' geometry, graphs and descriptors
    PatchFeatures features;     ///< columns of these meshes' patches
    std::vector<int> patch_of;  ///< the number of each patch in the whole collection
};

/// `meshes` are numbers in the collection, ascending. The result is the same on every rank except for the
/// local meshes. Collective.
PartCollection part_of_collection(const Comm& comm, const Collection& collection,
                                  const PatchFeatures& features, const std::vector<int>& meshes);

}  // namespace coseg
