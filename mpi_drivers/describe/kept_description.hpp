#pragma once
// A mesh's description from the state folder if it is there and whole, else made and kept.

#include "io/folders/state_folder.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "mpi_drivers/describe/mesh_description.hpp"

namespace coseg {

/// The same description, to the bit, whether it was kept or not; `reused` tells. folder: none keeps nothing.
/// A damaged file is set aside and named in a warning of the description. Serial. Throws Error(input) if the mesh cannot
/// be used, Error(output) if its description cannot be written.
DescribedMesh kept_description(int mesh, const MeshEntry& entry, const DescriptionOptions& options,
                               const StateFolder* folder);

}  // namespace coseg
