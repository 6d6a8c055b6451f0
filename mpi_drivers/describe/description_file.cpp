#include "mpi_drivers/describe/description_file.hpp"

#include <filesystem>
#include <span>

#include "io/files/hdf5_file.hpp"
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

template <class T, class Item, class Get>
std::vector<T> column(const std::vector<Item>& items, std::initializer_list<Get> fields) {
    std::vector<T> values;
    for (const Item& item : items) {
        for (const Get field : fields) values.push_back(static_cast<T>(item.*field));
    }
    return values;
}

void write_vector(Hdf5Writer& file, const std::string& name, const Eigen::VectorXd& values) {
    file.write(name, std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
}

void write_options(Hdf5Writer& file, const DescriptionOptions& options) {
    const auto& [seed, remesh, patches, oversegmentations, cut_noise, geodesic_samples, descriptors] =
        options;
    static_cast<void>(descriptors);  // the file shows by its datasets which they are
    file.attribute("seed", static_cast<std::int64_t>(seed));
    file.attribute("remesh", to_string(remesh));
    file.attribute("patches", std::int64_t{patches});
    file.attribute("oversegmentations", std::int64_t{oversegmentations});
    file.attribute("cut-noise", cut_noise);
    file.attribute("geodesic-samples", std::int64_t{geodesic_samples});
}

void write_graph(Hdf5Writer& file, const DualGraph& graph) {
    const std::uint64_t edges = graph.edges.size();
    file.write("graph/faces_and_vertices",
               column<std::int32_t>(graph.edges, {&DualEdge::face_a, &DualEdge::face_b, &DualEdge::vertex_a,
                                                  &DualEdge::vertex_b}),
               {edges, 4});
    file.write("graph/length_and_dihedral",
               column<double>(graph.edges, {&DualEdge::length, &DualEdge::dihedral}), {edges, 2});
    file.write("graph/is_virtual", column<std::int8_t>(graph.edges, {&DualEdge::is_virtual}));
}

void write_faces(Hdf5Writer& file, const MeshDescription& description) {
    file.attribute("remeshed", std::int64_t{description.remeshed});
    file.attribute("overlong_area", description.overlong_area);
    file.attribute("input_faces", std::int64_t{description.map.input_faces});
    file.write("faces/input_face", description.map.input_face);
    file.write("faces/label_donor_of_input_face", description.map.label_donor);
    write_vector(file, "faces/area", description.geometry.area);
    file.write_matrix("faces/normal", description.geometry.normal);
    file.write_matrix("faces/centroid", description.geometry.centroid);
    file.attribute("total_area", description.geometry.total_area);
}

std::string dataset_of(const Descriptor& descriptor) { return "descriptors/" + descriptor.name; }

void write_descriptors(Hdf5Writer& file, const FaceDescriptors& descriptors) {
    for (const FaceDescriptor& one : descriptors) {
        const std::string name = dataset_of(descriptor_table()[at(one.row)]);
        if (const auto* numbers = std::get_if<Eigen::VectorXd>(&one.values)) {
            write_vector(file, name, *numbers);
            continue;
        }
        const auto& vectors = std::get<Eigen::MatrixXf>(one.values);
        file.write(name, std::span<const float>(vectors.data(), at(vectors.size())),
                   {at(vectors.cols()), at(vectors.rows())}, true);
    }
}

std::string of_number(const std::string& name, std::size_t number) {
    return name + "/" + std::to_string(number);
}

void write_patches(Hdf5Writer& file, const MeshDescription& description) {
    file.write("patch_counts", description.patch_counts);
    for (std::size_t s = 0; s < description.patches.size(); ++s) {
        file.write(of_number("patches", s), description.patches[s]);
        const std::vector<PatchNeighbors>& neighbors = description.neighbors[s];
        file.write(of_number("neighbors/pairs", s),
                   column<std::int32_t>(neighbors, {&PatchNeighbors::patch_a, &PatchNeighbors::patch_b}),
                   {neighbors.size(), 2});
        file.write(of_number("neighbors/length_and_concavity", s),
                   column<double>(neighbors, {&PatchNeighbors::boundary_length, &PatchNeighbors::concavity}),
                   {neighbors.size(), 2});
    }
    file.write("overlaps/oversegmentations",
               column<std::int32_t>(description.overlaps, {&OverlapsOfPair::oversegmentation_a,
                                                           &OverlapsOfPair::oversegmentation_b}),
               {description.overlaps.size(), 2});
    for (std::size_t k = 0; k < description.overlaps.size(); ++k) {
        const std::vector<PatchOverlap>& overlaps = description.overlaps[k].overlaps;
        file.write(of_number("overlaps/pairs", k),
                   column<std::int32_t>(overlaps, {&PatchOverlap::patch_a, &PatchOverlap::patch_b}),
                   {overlaps.size(), 2});
        file.write(of_number("overlaps/intersection_over_union", k),
                   column<double>(overlaps, {&PatchOverlap::intersection_over_union}));
    }
}

Eigen::VectorXd read_vector(const Hdf5Reader& file, const std::string& name) {
    const std::vector<double> values = file.read<double>(name);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

DualGraph read_graph(const Hdf5Reader& file, int faces) {
    const auto ends = file.read<std::int32_t>("graph/faces_and_vertices");
    const auto numbers = file.read<double>("graph/length_and_dihedral");
    const auto is_virtual = file.read<std::int8_t>("graph/is_virtual");
    DualGraph graph;
    graph.face_count = faces;
    for (std::size_t e = 0; e < is_virtual.size(); ++e) {
        graph.edges.push_back({ends[4 * e], ends[4 * e + 1], ends[4 * e + 2], ends[4 * e + 3], numbers[2 * e],
                               numbers[2 * e + 1], is_virtual[e] != 0});
    }
    index_incidence(graph);
    return graph;
}

void read_faces(const Hdf5Reader& file, MeshDescription& description) {
    description.remeshed = file.integer("remeshed") != 0;
    description.overlong_area = file.number("overlong_area");
    description.map.input_faces = static_cast<int>(file.integer("input_faces"));
    description.map.input_face = file.read<std::int32_t>("faces/input_face");
    description.map.label_donor = file.read<std::int32_t>("faces/label_donor_of_input_face");
    description.geometry.area = read_vector(file, "faces/area");
    description.geometry.normal = file.read_matrix("faces/normal");
    description.geometry.centroid = file.read_matrix("faces/centroid");
    description.geometry.total_area = file.number("total_area");
    description.graph = read_graph(file, static_cast<int>(description.geometry.area.size()));
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
        const Hdf5Shape extent = file.shape(name);
        const std::vector<float> values = file.read<float>(name);
        descriptors.push_back(
            {static_cast<int>(row), Eigen::MatrixXf(Eigen::Map<const Eigen::MatrixXf>(
                                        values.data(), static_cast<Eigen::Index>(extent.at(1)),
                                        static_cast<Eigen::Index>(extent.at(0))))});
    }
    return descriptors;
}

std::vector<PatchNeighbors> read_neighbors(const Hdf5Reader& file, std::size_t s) {
    const auto pairs = file.read<std::int32_t>(of_number("neighbors/pairs", s));
    const auto numbers = file.read<double>(of_number("neighbors/length_and_concavity", s));
    std::vector<PatchNeighbors> neighbors;
    for (std::size_t k = 0; k < pairs.size(); k += 2)
        neighbors.push_back({pairs[k], pairs[k + 1], numbers[k], numbers[k + 1]});
    return neighbors;
}

void read_patches(const Hdf5Reader& file, MeshDescription& description) {
    description.patch_counts = file.read<std::int32_t>("patch_counts");
    for (std::size_t s = 0; s < description.patch_counts.size(); ++s) {
        description.patches.push_back(file.read<std::int32_t>(of_number("patches", s)));
        description.neighbors.push_back(read_neighbors(file, s));
    }
    const auto numbers = file.read<std::int32_t>("overlaps/oversegmentations");
    for (std::size_t k = 0; k < numbers.size() / 2; ++k) {
        const auto pairs = file.read<std::int32_t>(of_number("overlaps/pairs", k));
        const auto shares = file.read<double>(of_number("overlaps/intersection_over_union", k));
        std::vector<PatchOverlap> overlaps;
        for (std::size_t o = 0; o < shares.size(); ++o)
            overlaps.push_back({pairs[2 * o], pairs[2 * o + 1], shares[o]});
        description.overlaps.push_back({numbers[2 * k], numbers[2 * k + 1], std::move(overlaps)});
    }
}

}  // namespace

ContentHash description_key(std::string_view bytes, const std::string& name, const std::string& path,
                            const DescriptionOptions& options) {
    // One name for each field: a new option does not compile until it stands here.
    const auto& [seed, remesh, patches, oversegmentations, cut_noise, geodesic_samples, descriptors] =
        options;
    ContentHasher hasher;
    hasher.add(source_fingerprint(KeptPiece::descriptions));
    hasher.add(std::int64_t{description_version});
    hasher.add(std::filesystem::path(path).extension().string());
    hasher.add(name);
    hasher.add(seed);
    hasher.add(to_string(remesh));
    hasher.add(patches);
    hasher.add(oversegmentations);
    hasher.add(cut_noise);
    hasher.add(geodesic_samples);
    hasher.add(std::span<const int>(descriptors));
    hasher.add(bytes);
    return hasher.result();
}

void write_description(const std::string& file_path, const DescribedMesh& described, const std::string& name,
                       const std::string& path, const DescriptionOptions& options) {
    const MeshDescription& description = described.mesh;
    Hdf5Writer file(file_path, description_format, description_version);
    file.attribute("name", name);
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::descriptions));
    write_options(file, options);
    file.summary("mesh " + name + ", " + std::to_string(description.geometry.area.size()) + " faces, seed " +
                 std::to_string(options.seed) + ", " + std::to_string(options.oversegmentations) + " x " +
                 std::to_string(options.patches) + " patches");
    write_faces(file, description);
    write_descriptors(file, described.descriptors);
    write_graph(file, description.graph);
    write_patches(file, description);
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
    read_faces(file, description);
    read_patches(file, description);
    for (const std::string& warning : file.read_texts("warnings"))
        description.warnings.push_back(replaced(warning, path_mark, path));
    described.descriptors = read_descriptors(file);
    return described;
}

}  // namespace coseg
