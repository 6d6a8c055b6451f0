#pragma once
// Makes one more descriptor of the collection out of numbers that users give for every face.

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The descriptors with the run's weights. If options.face_features names a folder, there is one more row for
/// its numbers, with the values of each mesh of this rank: a working face has those of the face of the file
/// that it came from. The numbers are read again in every run, so that no description depends on them. There
/// is no row where their weight is 0. Collective. Throws AgreedError(input) as read_face_features does, and
/// where meshes have different numbers a face.
CollectionDescriptors weighted_descriptors(const Comm& comm, const Collection& collection,
                                           CollectionDescriptors descriptors, const FeatureOptions& options);

}  // namespace coseg
