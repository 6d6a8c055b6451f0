#include "mpi_drivers/describe/description_file.hpp"

#include <filesystem>
#include <span>

#include "io/files/record_file.hpp"
#include "io/files/record_hash.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"

namespace coseg {

namespace {

/// Stands for the mesh's path in kept warnings: the same mesh may lie elsewhere next time.
constexpr const char* path_mark = "<path>";

std::string replaced(const std::string& text, const std::string& what, const std::string& by) {
    const std::size_t found = text.find(what);
    return found == std::string::npos ? text : text.substr(0, found) + by + text.substr(found + what.size());
}

void write_vector(Hdf5Writer& file, const std::string& name, const Eigen::VectorXd& values) {
    file.write(name, std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
}

void write_descriptors(Hdf5Writer& file, const MeshDescription& description) {
    for (std::size_t h = 0; h < feature_names.size(); ++h) {
        if (description.descriptors[h].size() > 0)
            write_vector(file, std::string("descriptors/") + feature_names[h], description.descriptors[h]);
    }
    const Eigen::MatrixXf& context = description.shape_context;
    file.write("descriptors/shape_context",
               std::span<const float>(context.data(), static_cast<std::size_t>(context.size())),
               {static_cast<std::uint64_t>(context.cols()), static_cast<std::uint64_t>(context.rows())},
               true);
}

Eigen::VectorXd read_vector(const Hdf5Reader& file, const std::string& name) {
    const std::vector<double> values = file.read<double>(name);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void read_descriptors(const Hdf5Reader& file, MeshDescription& description) {
    for (std::size_t h = 0; h < feature_names.size(); ++h) {
        const std::string name = std::string("descriptors/") + feature_names[h];
        if (static_cast<Feature>(h) != Feature::shape_context && file.has(name))
            description.descriptors[h] = read_vector(file, name);
    }
    const Hdf5Shape extent = file.shape("descriptors/shape_context");
    const std::vector<float> context = file.read<float>("descriptors/shape_context");
    description.shape_context = Eigen::Map<const Eigen::MatrixXf>(
        context.data(), static_cast<Eigen::Index>(extent.at(1)), static_cast<Eigen::Index>(extent.at(0)));
}

}  // namespace

ContentHash description_key(std::string_view bytes, const std::string& name, const std::string& path,
                            const DescriptionOptions& options) {
    ContentHasher hasher;
    hasher.add(source_fingerprint(KeptPiece::descriptions));
    hasher.add(std::int64_t{description_version});
    hasher.add(std::filesystem::path(path).extension().string());
    hasher.add(name);
    add_value(hasher, options);
    hasher.add(bytes);
    return hasher.result();
}

void write_description(const std::string& file_path, const MeshDescription& description,
                       const std::string& name, const std::string& path, const DescriptionOptions& options) {
    Hdf5Writer file(file_path, description_format, description_version);
    file.attribute("name", name);
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::descriptions));
    write_record(file, "options", options);
    file.summary("mesh " + name + ", " + std::to_string(description.geometry.area.size()) + " faces, seed " +
                 std::to_string(options.seed) + ", " + std::to_string(options.oversegmentations) + " x " +
                 std::to_string(options.patches) + " patches");
    write_record(file, "", description);
    write_descriptors(file, description);
    std::vector<std::string> warnings;
    for (const std::string& warning : description.warnings)
        warnings.push_back(replaced(warning, path, path_mark));
    file.write_texts("warnings", warnings);
    file.commit();
}

MeshDescription read_description(const std::string& file_path, int mesh, const std::string& name,
                                 const std::string& path) {
    const Hdf5Reader file(file_path, description_format, description_version);
    MeshDescription description;
    description.mesh = mesh;
    description.key = hash_text(name);
    read_record(file, "", description);
    index_incidence(description.graph);
    read_descriptors(file, description);
    for (const std::string& warning : file.read_texts("warnings"))
        description.warnings.push_back(replaced(warning, path_mark, path));
    return description;
}

}  // namespace coseg
