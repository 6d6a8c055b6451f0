#include "mpi_drivers/finished_runs/shown_descriptors.hpp"

#include "mpi_drivers/describe/mesh_description.hpp"
#include "src/base/index.hpp"

namespace coseg {

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

std::vector<std::vector<double>> shown_descriptors(const FinishedRun& run, const LabelledMesh& shape,
                                                   const std::vector<int>& chosen) {
    DescriptionOptions options;
    options.seed = run.seed;
    options.weld = parsed_weld(run.weld).value_or(options.weld);
    options.remesh = named<RemeshMode>(run.remesh).value_or(options.remesh);
    options.patches = run.patches;
    options.geodesic_samples = run.geodesic_samples;
    options.descriptors = chosen;
    const auto [mesh, descriptors] =
        describe_mesh_faces(shape.number, {shape.name, shape.path, 0, nullptr}, options);
    std::vector<std::vector<double>> values;
    for (const FaceDescriptor& descriptor : descriptors)
        values.push_back(per_input_face(mesh.map, shown_values(descriptor), mesh.geometry.area));
    return values;
}

}  // namespace coseg
