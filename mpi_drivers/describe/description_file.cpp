#include "mpi_drivers/describe/description_file.hpp"

#include <filesystem>
#include <span>

#include "io/files/record_file.hpp"
#include "io/files/record_hash.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
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

std::string dataset_of(const Descriptor& descriptor) { return "descriptors/" + descriptor.name; }

void write_descriptors(Hdf5Writer& file, const FaceDescriptors& descriptors) {
    for (const FaceDescriptor& one : descriptors) {
        const std::string name = dataset_of(descriptor_table()[at(one.row)]);
        if (const auto* numbers = std::get_if<Eigen::VectorXd>(&one.values)) {
            write_vector(file, name, *numbers);
            continue;
        }
        file.write_matrix(name, std::get<Eigen::MatrixXf>(one.values), true);
    }
}

Eigen::VectorXd read_vector(const Hdf5Reader& file, const std::string& name) {
    const std::vector<double> values = file.read<double>(name);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

FaceDescriptors read_descriptors(const Hdf5Reader& file) {
    FaceDescriptors descriptors;
    const std::vector<Descriptor>& table = descriptor_table();
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string name = dataset_of(table[row]);
        if (!file.has(name)) continue;
        if (table[row].bins != BinKind::words) {
            descriptors.push_back({static_cast<int>(row), read_vector(file, name)});
            continue;
        }
        descriptors.push_back({static_cast<int>(row), file.read_matrix<float>(name)});
    }
    return descriptors;
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

void write_description(const std::string& file_path, const DescribedMesh& described, const std::string& name,
                       const std::string& path, const DescriptionOptions& options) {
    const MeshDescription& description = described.mesh;
    Hdf5Writer file(file_path, description_format, description_version);
    file.attribute("name", name);
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::descriptions));
    write_record(file, "options", options);
    file.summary("mesh " + name + ", " + std::to_string(description.geometry.area.size()) + " faces, seed " +
                 std::to_string(options.seed) + ", " + std::to_string(options.oversegmentations) + " x " +
                 std::to_string(options.patches) + " patches");
    write_record(file, "", description);
    write_descriptors(file, described.descriptors);
    std::vector<std::string> warnings;
    for (const std::string& warning : description.warnings)
        warnings.push_back(replaced(warning, path, path_mark));
    file.write_texts("warnings", warnings);
    file.commit();
}

DescribedMesh read_description(const std::string& file_path, int mesh, const std::string& name,
                               const std::string& path) {
    const Hdf5Reader file(file_path, description_format, description_version);
    DescribedMesh described;
    MeshDescription& description = described.mesh;
    description.mesh = mesh;
    description.key = hash_text(name);
    read_record(file, "", description);
    described.descriptors = read_descriptors(file);
    for (const std::string& warning : file.read_texts("warnings"))
        description.warnings.push_back(replaced(warning, path_mark, path));
    return described;
}

}  // namespace coseg
