#include "src/descriptors/descriptor_context.hpp"

#include <utility>

#include "src/descriptors/wave_kernel_signature.hpp"

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

const LaplacianSpectrum& DescriptorContext::spectrum() {
    if (!spectrum_) {
        spectrum_ = laplacian_spectrum(mesh_, geometry_, graph_, wave_kernel_pairs);
        step_end_("spectrum");
    }
    return *spectrum_;
}

void DescriptorContext::release() {
    geodesics_.reset();
    spectrum_.reset();
}

}  // namespace coseg
