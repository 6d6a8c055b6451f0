#pragma once
// One mesh for its descriptors, with the parts that several of them share.

#include <cstdint>
#include <functional>
#include <optional>

#include "src/descriptors/laplacian_spectrum.hpp"
#include "src/geodesics/geodesic.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

/// The parts that are made once for all descriptors of a mesh that ask for them, in the order of the work.
enum class SharedPart { none, geodesics, spectrum };

/// Called with the name of a step of the work when that step ends.
using StepEnd = std::function<void(const char* step)>;

/// References to one working mesh of area 1, which must outlive this, and its shared parts.
class DescriptorContext {
  public:
    /// `samples` and `seed` are those of geodesic_table.
    DescriptorContext(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph, int samples,
                      std::uint64_t seed, StepEnd step_end);

    [[nodiscard]] const TriMesh& mesh() const noexcept { return mesh_; }
    /// face_geometry(mesh).
    [[nodiscard]] const FaceGeometry& geometry() const noexcept { return geometry_; }
    /// dual_graph(mesh, geometry).
    [[nodiscard]] const DualGraph& graph() const noexcept { return graph_; }

    /// Made when it is first asked for; the largest thing that is held of a mesh.
    const GeodesicTable& geodesics();
    /// The lowest eigenfunctions, made likewise.
    const LaplacianSpectrum& spectrum();

    void end_step(const char* step) const { step_end_(step); }

    /// Frees the shared parts; what is asked for again is made again.
    void release();

  private:
    const TriMesh& mesh_;
    const FaceGeometry& geometry_;
    const DualGraph& graph_;
    int samples_;
    std::uint64_t seed_;
    StepEnd step_end_;
    std::optional<GeodesicTable> geodesics_;
    std::optional<LaplacianSpectrum> spectrum_;
};

}  // namespace coseg
