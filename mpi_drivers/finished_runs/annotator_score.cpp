#include "mpi_drivers/finished_runs/annotator_score.hpp"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/data_files/label_file.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/connected_pieces.hpp"
#include "src/repair/mesh_repair.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> annotations_of(const std::string& folder, const std::string& name) {
    std::vector<std::string> paths;
    const fs::path own = fs::path(folder) / name;
    if (!fs::is_directory(own)) return paths;
    for (const std::string& annotation : label_file_names(own.string())) {
        if (annotation.starts_with(name + "_")) paths.push_back((own / (annotation + label_suffix)).string());
    }
    return paths;
}

std::vector<int> on_working_faces(const std::vector<int>& label, const FaceMap& map) {
    std::vector<int> working;
    for (const int f : map.input_face) working.push_back(label[at(f)]);
    return working;
}

AnnotatedShape compare(const MeshEntry& mesh, const std::vector<std::string>& annotations,
                       const std::string& labels_folder) {
    AnnotatedShape shape{.name = mesh.name, .missing = false, .annotators = {}};
    const std::string labels_path = (fs::path(labels_folder) / (mesh.name + label_suffix)).string();
    if (!fs::exists(labels_path)) {
        shape.missing = true;
        return shape;
    }
    const PolygonMesh polygons = read_mesh(mesh.path);
    RepairedMesh repaired = repair(polygons, mesh.path);
    scale_to_unit_area(repaired.mesh);
    const FaceGeometry geometry = face_geometry(repaired.mesh);
    const DualGraph graph = dual_graph(repaired.mesh, geometry);
    const std::vector<int> parts =
        on_working_faces(read_labels(labels_path, polygons.face_count()), repaired.map);
    const std::vector<int> pieces = connected_pieces(graph, parts, VirtualEdges::ignored);
    for (const std::string& path : annotations) {
        const std::vector<int> segments =
            on_working_faces(read_labels(path, polygons.face_count()), repaired.map);
        shape.annotators.push_back(segmentation_agreement(repaired.mesh, geometry, graph, segments, pieces));
    }
    return shape;
}

struct Measure {
    const char* name;
    std::optional<double> (*of)(const SegmentationAgreement&);
};

constexpr Measure measures[] = {
    {"rand_index_error", [](const SegmentationAgreement& a) { return std::optional(a.rand_index_error); }},
    {"cut_discrepancy", [](const SegmentationAgreement& a) { return a.cut_discrepancy; }},
    {"hamming_distance", [](const SegmentationAgreement& a) { return std::optional(a.hamming_distance); }},
    {"missing_rate", [](const SegmentationAgreement& a) { return std::optional(a.missing_rate); }},
    {"false_alarm_rate", [](const SegmentationAgreement& a) { return std::optional(a.false_alarm_rate); }},
    {"global_consistency_error",
     [](const SegmentationAgreement& a) { return std::optional(a.global_consistency_error); }},
    {"local_consistency_error",
     [](const SegmentationAgreement& a) { return std::optional(a.local_consistency_error); }}};

std::optional<double> mean_of(const std::vector<std::optional<double>>& values) {
    double sum = 0.0;
    int count = 0;
    for (const std::optional<double>& value : values) {
        if (!value) continue;
        sum += *value;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

Json rounded(const std::optional<double>& value) {
    return value ? Json(std::round(1e6 * *value) / 1e6) : Json(nullptr);
}

}  // namespace

std::vector<AnnotatedShape> compare_with_annotators(const std::vector<MeshEntry>& meshes,
                                                    const std::string& annotators_folder,
                                                    const std::string& labels_folder) {
    std::vector<AnnotatedShape> shapes;
    for (const MeshEntry& mesh : meshes) {
        const std::vector<std::string> annotations = annotations_of(annotators_folder, mesh.name);
        if (!annotations.empty()) shapes.push_back(compare(mesh, annotations, labels_folder));
    }
    if (!shapes.empty()) return shapes;
    throw Error(ExitCode::input, "no mesh has an annotator in '" + annotators_folder + "'; those of '" +
                                     meshes.front().name + "' would be '" + annotators_folder + "/" +
                                     meshes.front().name + "/" + meshes.front().name + "_0.seg' and so on.");
}

std::string annotator_json(const std::vector<AnnotatedShape>& shapes) {
    Json result;
    std::vector<std::string> missing;
    Json per_shape = Json::object();
    int annotations = 0;
    for (const Measure& measure : measures) {
        std::vector<std::optional<double>> means;
        for (const AnnotatedShape& shape : shapes) {
            std::vector<std::optional<double>> values;
            for (const SegmentationAgreement& agreement : shape.annotators)
                values.push_back(measure.of(agreement));
            means.push_back(mean_of(values));
            if (!shape.missing) per_shape[shape.name][measure.name] = rounded(means.back());
        }
        result[measure.name] = rounded(mean_of(means));
    }
    for (const AnnotatedShape& shape : shapes) {
        if (shape.missing) missing.push_back(shape.name);
        annotations += static_cast<int>(shape.annotators.size());
    }
    result["shapes"] = shapes.size() - missing.size();
    result["annotations"] = annotations;
    result["missing"] = missing;
    result["per_shape"] = per_shape;
    return result.dump(2) + "\n";
}

}  // namespace coseg
