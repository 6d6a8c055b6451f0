#pragma once
// What users give for every face, as one more descriptor of the collection.

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The descriptors with the run's weights and, if options.face_features names a folder, a row more for what
/// it holds, with its values of each mesh of this rank: those of the face of the file that a working face
/// came from. They are read anew in every run, so no description depends on them. No row where their weight
/// is 0. Collective. Throws AgreedError(input) as read_face_features, and where meshes have different numbers
/// a face.
CollectionDescriptors weighted_descriptors(const Comm& comm, const Collection& collection,
                                           CollectionDescriptors descriptors, const FeatureOptions& options);

}  // namespace coseg
