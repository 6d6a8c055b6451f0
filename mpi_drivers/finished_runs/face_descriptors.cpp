#include "mpi_drivers/finished_runs/face_descriptors.hpp"

#include "src/base/index.hpp"
#include "src/descriptors/shape_context.hpp"

namespace coseg {

namespace {

/// A face without a working face takes the value of its label donor, as it takes its label.
std::vector<double> per_input_face(const FaceMap& map, const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& areas) {
    const auto faces = static_cast<std::size_t>(map.input_faces);
    std::vector<double> sums(faces, 0.0);
    std::vector<double> weights(faces, 0.0);
    for (std::size_t w = 0; w < map.input_face.size(); ++w) {
        const auto f = static_cast<std::size_t>(map.input_face[w]);
        const auto row = static_cast<Eigen::Index>(w);
        sums[f] += areas[row] * values[row];
        weights[f] += areas[row];
    }
    std::vector<double> means(faces, 0.0);
    for (std::size_t f = 0; f < faces; ++f) {
        std::size_t from = f;
        for (std::size_t steps = 0; !(weights[from] > 0.0) && steps < faces; ++steps)
            from = static_cast<std::size_t>(map.label_donor[from]);
        if (weights[from] > 0.0) means[f] = sums[from] / weights[from];
    }
    return means;
}

Eigen::VectorXd mean_ring(const Eigen::MatrixXf& contexts) {
    Eigen::VectorXd rings = Eigen::VectorXd::Zero(contexts.cols());
    for (Eigen::Index f = 0; f < contexts.cols(); ++f) {
        double total = 0.0;
        for (Eigen::Index bin = 0; bin < contexts.rows(); ++bin) {
            const Eigen::Index ring = bin % shape_context_bins / shape_context_angles;
            rings[f] += static_cast<double>(ring) * contexts(bin, f);
            total += contexts(bin, f);
        }
        if (total > 0.0) rings[f] /= total;
    }
    return rings;
}

}  // namespace

FaceDescriptors face_descriptors(const FinishedRun& run, const LabelledMesh& shape) {
    RunOptions options;
    options.seed = run.seed;
    options.remesh = run.remesh;
    options.patches = run.patches;
    options.geodesic_samples = run.geodesic_samples;
    MeshDescription description =
        describe_mesh_faces(shape.number, shape.name, shape.path, description_options(options));
    description.descriptors[at(Feature::shape_context)] = mean_ring(description.shape_context);
    FaceDescriptors values;
    for (std::size_t h = 0; h < values.size(); ++h)
        values[h] = per_input_face(description.map, description.descriptors[h], description.geometry.area);
    return values;
}

}  // namespace coseg
