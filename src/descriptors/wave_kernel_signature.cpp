#include "src/descriptors/wave_kernel_signature.hpp"

#include <algorithm>
#include <cmath>

namespace coseg {

namespace {

/// k x energies: the weight of each eigenpair at each energy; columns sum to 1.
Eigen::MatrixXd energy_weights(const Eigen::VectorXd& eigenvalues) {
    constexpr double sigma = 7.0;  // steps between energies
    const Eigen::ArrayXd level = eigenvalues.array().log();
    const double low = level.minCoeff();
    const double step = (level.maxCoeff() - low) / (wave_kernel_energies - 1);
    Eigen::MatrixXd weights(eigenvalues.size(), wave_kernel_energies);
    for (int e = 0; e < wave_kernel_energies; ++e) {
        // Where all eigenvalues are equal the step is 0, and they all count alike.
        const Eigen::ArrayXd away =
            step > 0.0 ? ((level - low) / step - e).eval() : Eigen::ArrayXd::Zero(level.size());
        weights.col(e) = (-0.5 * (away / sigma).square()).exp();
        weights.col(e) /= weights.col(e).sum();
    }
    return weights;
}

}  // namespace

Eigen::MatrixXf wave_kernel_signature(const TriMesh& mesh, const FaceGeometry& geometry,
                                      const LaplacianSpectrum& spectrum) {
    constexpr double least = 1e-3;
    const Eigen::Index faces = mesh.face_count();
    Eigen::MatrixXf signatures = Eigen::MatrixXf::Zero(wave_kernel_energies, faces);
    if (spectrum.eigenvalues.size() < 2) return signatures;
    const Eigen::MatrixXd at_vertex =
        energy_weights(spectrum.eigenvalues).transpose() * spectrum.eigenfunctions.cwiseAbs2().transpose();
    const auto at_face = [&](Eigen::Index f) -> Eigen::VectorXd {
        const auto corner = mesh.faces.col(f);
        return (at_vertex.col(corner[0]) + at_vertex.col(corner[1]) + at_vertex.col(corner[2])) / 3.0;
    };
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(wave_kernel_energies);
    for (Eigen::Index f = 0; f < faces; ++f) mean += geometry.area[f] / geometry.total_area * at_face(f);
    for (Eigen::Index f = 0; f < faces; ++f)
        signatures.col(f) = (at_face(f).array() / mean.array()).max(least).log().cast<float>();
    return signatures;
}

Eigen::VectorXd wave_kernel_level(const Eigen::MatrixXf& signatures) {
    if (signatures.cols() == 0) return {};
    return signatures.topRows(signatures.rows() / 2).cast<double>().colwise().mean().transpose();
}

}  // namespace coseg
