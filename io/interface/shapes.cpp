// What <coseg/shapes.hpp> declares.

#include <algorithm>
#include <coseg/shapes.hpp>
#include <utility>

#include "io/folders/finished_run.hpp"
#include "io/interface/failures.hpp"
#include "io/interface/shape_polygons.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/families/shape_families.hpp"
#include "src/mesh/polygon_area.hpp"
#include "src/metrics/segmentation_score.hpp"

namespace coseg {

namespace {

void refuse_length(std::size_t shape, const char* what, std::size_t length, std::size_t faces) {
    throw Error(ExitCode::input, "shape " + std::to_string(shape) + ": " + std::to_string(length) + " " +
                                     what + " for " + std::to_string(faces) + " faces");
}

LabelledShape labelled(const Shape& shape, std::size_t index, const std::vector<int>& labels,
                       const std::vector<int>& truth) {
    LabelledShape row{.name = std::to_string(index), .truth = truth, .labels = {}, .face_area = {}};
    row.face_area = relative_areas(polygons_of(shape, index).mesh);
    const std::size_t faces = row.face_area.size();
    if (truth.size() != faces) refuse_length(index, "true labels", truth.size(), faces);
    if (!labels.empty() && labels.size() != faces) refuse_length(index, "labels", labels.size(), faces);
    if (!labels.empty()) row.labels = labels;
    return row;
}

Score scored(std::span<const Shape> shapes, const std::vector<std::vector<int>>& labels,
             const std::vector<std::vector<int>>& truth) {
    if (shapes.empty() || shapes.size() != labels.size() || shapes.size() != truth.size())
        throw Error(ExitCode::input, "there are " + std::to_string(shapes.size()) + " shapes, " +
                                         std::to_string(labels.size()) + " arrays of labels and " +
                                         std::to_string(truth.size()) +
                                         " of true labels; give as many of each");
    std::vector<LabelledShape> rows;
    for (std::size_t s = 0; s < shapes.size(); ++s)
        rows.push_back(labelled(shapes[s], s, labels[s], truth[s]));
    const SegmentationScore found = score_segmentation(rows);
    Score score{.accuracy = found.one_to_one,
                .many_to_one = found.many_to_one,
                .one_part = found.one_label,
                .rand_index = found.rand_index,
                .shapes = {}};
    for (const ShapeScore& shape : found.shapes)
        score.shapes.push_back({shape.one_to_one, shape.many_to_one, shape.rand_index});
    return score;
}

/// As `coseg generate` names its files.
std::string generated_name(const std::string& family, int index, int count) {
    const std::string digits = std::to_string(index);
    const std::size_t width = std::max<std::size_t>(4, std::to_string(count - 1).size());
    return family + "_" + std::string(width - digits.size(), '0') + digits;
}

GeneratedShape generated(const std::string& family, int index, int count, std::uint64_t seed, int faces) {
    LabeledShape made = generate_shape(family, seed, index, faces);
    GeneratedShape shape{generated_name(family, index, count), {}, std::move(made.face_label)};
    const Eigen::Matrix3Xd& vertices = made.mesh.vertices;
    const Eigen::Matrix3Xi& corners = made.mesh.faces;
    shape.mesh.vertices.assign(vertices.data(), vertices.data() + vertices.size());
    shape.mesh.corners.assign(corners.data(), corners.data() + corners.size());
    for (int f = 0; f <= made.mesh.face_count(); ++f) shape.mesh.offsets.push_back(3 * f);
    return shape;
}

}  // namespace

std::string interface_1::version() { return COSEG_VERSION; }

Shape interface_1::shape_of(const Mesh& mesh, const std::string& name) {
    return {.name = name,
            .path = {},
            .vertices = mesh.vertices,
            .corners = mesh.corners,
            .offsets = mesh.offsets};
}

Shape interface_1::shape_of(const std::string& path) {
    return {.name = {}, .path = path, .vertices = {}, .corners = {}, .offsets = {}};
}

Mesh interface_1::load_mesh(const std::string& path) {
    return with_failures([&] {
        const PolygonMesh polygons = read_mesh(path);
        Mesh mesh;
        for (const Eigen::Vector3d& p : polygons.vertices)
            mesh.vertices.insert(mesh.vertices.end(), {p.x(), p.y(), p.z()});
        mesh.corners = polygons.corners;
        mesh.offsets = polygons.offsets;
        return mesh;
    });
}

std::vector<std::string> interface_1::mesh_files(const std::vector<std::string>& arguments) {
    return with_failures([&] {
        std::vector<std::string> paths;
        for (const MeshEntry& entry : expand_mesh_list(arguments)) paths.push_back(entry.path);
        return paths;
    });
}

std::vector<GeneratedShape> interface_1::generate(const std::string& family, int count, std::uint64_t seed,
                                                  int faces) {
    return generate(family, count, seed, faces, [](int /*number*/) {});
}

std::vector<GeneratedShape> interface_1::generate(const std::string& family, int count, std::uint64_t seed,
                                                  int faces, const std::function<void(int)>& before_each) {
    return with_failures([&] {
        if (count < 1 || count > most_generated_shapes)
            throw Error(ExitCode::usage, "count: " + std::to_string(count) + " is not in 1 .. " +
                                             std::to_string(most_generated_shapes));
        std::vector<GeneratedShape> shapes;
        for (int k = 0; k < count; ++k) {
            before_each(k);
            shapes.push_back(generated(family, k, count, seed, faces));
        }
        return shapes;
    });
}

std::vector<std::string> interface_1::changed_files(const std::string& folder) {
    return with_failures([&] {
        std::vector<std::string> sentences;
        for (const std::string& path : files_changed_since(folder))
            sentences.push_back(changed_file_sentence(path));
        return sentences;
    });
}

Score interface_1::score(std::span<const Shape> shapes, const std::vector<std::vector<int>>& labels,
                         const std::vector<std::vector<int>>& truth) {
    return with_failures([&] { return scored(shapes, labels, truth); });
}

}  // namespace coseg
