#pragma once
// What users give for every face, as one more descriptor of the collection.

#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/run_options.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Adds a row for options.face_features with its weight to the table, and its values to each mesh of this rank: those of the
/// face of the file that a working face came from. They are read anew in every run, so no description depends on them.
/// Nothing where the weight is 0. Collective. Throws AgreedError(input) as read_face_features, and where meshes have
/// different numbers a face.
void add_face_features(const Comm& comm, DescribedCollection& described, const RunOptions& options);

}  // namespace coseg
