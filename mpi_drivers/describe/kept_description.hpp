#pragma once
// Takes a mesh's description from the state folder if it is there and whole, and else makes and keeps it.

#include "io/folders/state_folder.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "mpi_drivers/describe/mesh_description.hpp"

namespace coseg {

/// The description is the same, to the bit, whether it was kept or not; `reused` says which. Without a folder
/// nothing is kept. A damaged file is set aside and named in a warning of the description. Serial. Throws
/// Error(input) if the mesh cannot be used, Error(output) if its description cannot be written.
DescribedMesh kept_description(int mesh, const MeshEntry& entry, const DescriptionOptions& options,
                               const StateFolder* folder);

}  // namespace coseg
