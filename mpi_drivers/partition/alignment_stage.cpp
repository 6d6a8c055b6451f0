#include "mpi_drivers/partition/alignment_stage.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "solvers/alignment/shape_alignment.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

bool is_off(const PatchFeatures& features, const PartitionOptions& options) {
    return options.align == AlignMode::off || features.positions.cols() == 0;
}

}  // namespace

ShapeAlignment aligned(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                       const SparseCoefficients& coefficients, const PartitionOptions& options) {
    if (is_off(features, options)) {
        ShapeAlignment alignment;
        alignment.reason = "it is switched off";
        return alignment;
    }
    std::vector<std::uint64_t> keys;
    for (const MeshFacts& mesh : collection.meshes) keys.push_back(hash_text(mesh.name));
    const std::vector<int> mesh_of = collection.numbering.mesh_of();
    return align_shapes(comm, {coefficients, features.positions, mesh_of, features.patch_area,
                               std::move(keys), options.seed});
}

ShapeAlignment alignment_stage(const Comm& comm, const Collection& collection, const PatchFeatures& features,
                               const SparseCoefficients& coefficients, const PartitionOptions& options,
                               StageLog& log) {
    if (is_off(features, options)) return aligned(comm, collection, features, coefficients, options);
    log.begin("align");
    ShapeAlignment alignment = aligned(comm, collection, features, coefficients, options);
    log.end((alignment.applied() ? "aligned: " : "as they stand: ") + alignment.reason);
    return alignment;
}

}  // namespace coseg
