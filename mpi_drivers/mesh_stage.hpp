#pragma once
// The first stage: meshes are dealt over the ranks, largest first, and each is read and described where it was dealt.

#include <string>
#include <vector>

#include "io/mesh_list.hpp"
#include "mpi_drivers/mesh_description.hpp"
#include "mpi_drivers/run_options.hpp"
#include "src/comm.hpp"
#include "src/patch_numbering.hpp"
#include "src/stage_log.hpp"

namespace coseg {

/// What every rank knows of a mesh; `mesh` counts usable meshes only, in the collection's order.
struct MeshFacts {
    std::string name;
    std::string path;
    int owner = 0;  ///< the rank that holds its description
    int input_faces = 0;
    int working_faces = 0;
    bool remeshed = false;
    double overlong_area = 0.0;  ///< see src/face_suitability.hpp
    double seconds = 0.0;
    std::vector<std::string> warnings;
};

struct SetAside {
    std::string path;
    std::string reason;
};

struct Collection {
    std::vector<MeshFacts> meshes;       ///< usable meshes, all ranks
    std::vector<SetAside> set_aside;     ///< unusable ones, all ranks
    std::vector<MeshDescription> local;  ///< of this rank, ascending by mesh
    PatchNumbering numbering{1, {}};     ///< all ranks
};

/// Collective. Throws AgreedError(input) if no mesh can be used, or with options.strict if any cannot.
/// What each rank computes depends on the schedule; the result, apart from `owner` and `seconds`, does not.
Collection describe_collection(const Comm& comm, const std::vector<MeshEntry>& entries,
                               const RunOptions& options, StageLog& log);

}  // namespace coseg
