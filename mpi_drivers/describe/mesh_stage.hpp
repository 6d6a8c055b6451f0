#pragma once
// The first stage: meshes are shared out among the ranks, largest first, and each is read and described on
// its rank.

#include <string>
#include <vector>

#include "io/mesh_files/mesh_list.hpp"
#include "mpi_drivers/describe/mesh_description.hpp"
#include "mpi_drivers/options/stage_options.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/stage_log.hpp"
#include "src/patches/patch_numbering.hpp"
#include "src/records/mesh_facts.hpp"

namespace coseg {

struct Collection {
    std::vector<MeshFacts> meshes;       ///< usable meshes, all ranks
    std::vector<SetAside> set_aside;     ///< unusable ones, all ranks
    std::vector<MeshDescription> local;  ///< of this rank, ascending by mesh
    PatchNumbering numbering{1, {}};     ///< all ranks
};

/// The values of faces of which the features are made.
struct CollectionDescriptors {
    std::vector<Descriptor> table;         ///< descriptor_table(); see weighted_descriptors
    std::vector<FaceDescriptors> of_mesh;  ///< of collection.local, in its order; `row` is of `table`
};

/// The result of the first stage.
struct DescribedCollection {
    Collection collection;
    CollectionDescriptors descriptors;
};

/// The meshes that a command line names, in the collection's order, on all ranks. Rank 0 alone asks the file
/// system. Collective; throws AgreedError(input) as expand_mesh_list does.
std::vector<MeshEntry> list_meshes(const Comm& comm, const std::vector<std::string>& inputs);

/// Describes all meshes. Collective. Throws AgreedError(input) if no mesh can be used, or with options.strict
/// if any cannot. With a state (may be null), descriptions are taken from its folder and kept there; throws
/// AgreedError(output) if one cannot be written, AgreedError(checkpointed) if a rank has been asked to end.
/// Where options leave the number of over-segmentations open, it is that of as many shapes as can be used;
/// the numbering has it. The schedule decides which rank computes what; the result, apart from `owner` and
/// `seconds`, does not depend on it.
DescribedCollection describe_collection(const Comm& comm, const std::vector<MeshEntry>& entries,
                                        const DescriptionOptions& options, bool strict, const RunState* state,
                                        StageLog& log);

struct DescribeTotals {
    std::int64_t described = 0;
    std::int64_t reused = 0;
    std::vector<SetAside> set_aside;
    std::vector<std::string> warnings;  ///< the same on all ranks, like the rest
};

/// Writes descriptions into the folder of `state`; none of them is kept in memory. Collective; throws as
/// describe_collection.
DescribeTotals describe_into_state(const Comm& comm, const std::vector<MeshEntry>& entries,
                                   const DescriptionOptions& options, bool strict, const RunState& state,
                                   StageLog& log);

}  // namespace coseg
