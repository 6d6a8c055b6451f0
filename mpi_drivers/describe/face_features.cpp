#include "mpi_drivers/describe/face_features.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/data_files/face_feature_file.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

Eigen::MatrixXf of_working_faces(const Eigen::MatrixXf& of_input_faces, const FaceMap& map) {
    return of_input_faces(Eigen::all, map.input_face);
}

/// The numbers a face that all meshes have. Collective.
int agreed_dimensions(const Comm& comm, const Collection& collection,
                      const std::vector<Eigen::MatrixXf>& features) {
    std::vector<int> local(2 * features.size());
    for (std::size_t k = 0; k < features.size(); ++k) {
        local[2 * k] = collection.local[k].mesh;
        local[2 * k + 1] = static_cast<int>(features[k].rows());
    }
    const std::vector<int> all = all_gather(comm, std::span<const int>(local));
    std::vector<int> of_mesh(collection.meshes.size(), 0);
    for (std::size_t k = 0; k + 1 < all.size(); k += 2) of_mesh[at(all[k])] = all[k + 1];
    for (std::size_t m = 1; m < of_mesh.size(); ++m) {
        if (of_mesh[m] == of_mesh[0]) continue;
        throw AgreedError(ExitCode::input, "--face-features: there are " + std::to_string(of_mesh[m]) +
                                               " numbers a face for " + collection.meshes[m].name + " but " +
                                               std::to_string(of_mesh[0]) + " for " +
                                               collection.meshes[0].name + "; all meshes must have as many");
    }
    return of_mesh.front();
}

void add_face_features(const Comm& comm, const Collection& collection, const FeatureOptions& options,
                       CollectionDescriptors& descriptors) {
    std::vector<Eigen::MatrixXf> features;
    agree(comm, [&] {
        for (const MeshDescription& mesh : collection.local) {
            const std::string path =
                face_feature_path(options.face_features, collection.meshes[at(mesh.mesh)].name);
            features.push_back(of_working_faces(read_face_features(path, mesh.map.input_faces), mesh.map));
        }
    });
    const int dimensions = agreed_dimensions(comm, collection, features);
    const auto row = static_cast<int>(descriptors.table.size());
    descriptors.table.push_back(face_features_descriptor(dimensions, options.face_feature_weight));
    for (std::size_t k = 0; k < features.size(); ++k) {
        FaceValues values = std::move(features[k]);
        if (dimensions == 1)
            values = Eigen::VectorXd(std::get<Eigen::MatrixXf>(values).row(0).transpose().cast<double>());
        descriptors.of_mesh[k].push_back({row, std::move(values)});
    }
}

}  // namespace

CollectionDescriptors weighted_descriptors(const Comm& comm, const Collection& collection,
                                           CollectionDescriptors descriptors, const FeatureOptions& options) {
    for (std::size_t row = 0; row < descriptors.table.size(); ++row)
        descriptors.table[row].weight = options.weights.at(row);
    if (!options.face_features.empty() && options.face_feature_weight > 0.0)
        add_face_features(comm, collection, options, descriptors);
    return descriptors;
}

}  // namespace coseg
