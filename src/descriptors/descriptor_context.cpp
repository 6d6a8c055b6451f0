#include "src/descriptors/descriptor_context.hpp"

#include <utility>

namespace coseg {

DescriptorContext::DescriptorContext(const TriMesh& mesh, const FaceGeometry& geometry,
                                     const DualGraph& graph, int samples, std::uint64_t seed,
                                     StepEnd step_end)
    : mesh_(mesh),
      geometry_(geometry),
      graph_(graph),
      samples_(samples),
      seed_(seed),
      step_end_(std::move(step_end)) {}

const GeodesicTable& DescriptorContext::geodesics() {
    if (!geodesics_) {
        geodesics_ = geodesic_table(mesh_, geometry_, graph_, samples_, seed_);
        step_end_("geodesics");
    }
    return *geodesics_;
}

void DescriptorContext::release() { geodesics_.reset(); }

}  // namespace coseg
