#include "mpi_drivers/finished_runs/finished_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>

#include "io/data_files/alignment_file.hpp"
#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/files/content_hash.hpp"
#include "io/files/file_contents.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/index.hpp"
#include "src/mesh/polygon_area.hpp"
#include "src/mesh/turned_polygons.hpp"
#include "src/metrics/assignment.hpp"
#include "src/parallel/exact_sum.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

constexpr int most_truth_labels = 10000;

std::map<std::string, std::string> paths_by_name(const std::vector<std::string>& meshes) {
    std::map<std::string, std::string> paths;
    if (meshes.empty()) return paths;
    for (const MeshEntry& entry : expand_mesh_list(meshes)) paths[entry.name] = entry.path;
    return paths;
}

std::string path_of(const FinishedShape& shape, const std::map<std::string, std::string>& paths) {
    const auto moved = paths.find(shape.name);
    std::string path = moved != paths.end() ? moved->second : shape.path;
    if (fs::exists(path)) return path;
    throw Error(ExitCode::input, path + ": the mesh is not where the run found it; say where with --meshes");
}

/// Of the run's shapes by name; none where they stand as in their files.
std::map<std::string, Eigen::Matrix3d> rotations_of(const FinishedRun& run) {
    std::map<std::string, Eigen::Matrix3d> rotations;
    const std::string path = run.folder + "/" + result_files::alignment;
    if (!fs::exists(path)) return rotations;
    const AlignmentFile file = read_alignment(path);
    if (!file.aligned) return rotations;
    for (const AlignedShape& shape : file.shapes) rotations[shape.name] = shape.rotation;
    return rotations;
}

/// Reads labels of 0 .. count - 1, and notes the file if it has another checksum than the run's.
std::vector<int> read_checked(LabelledMesh& shape, const std::string& path, const std::string& checksum,
                              int count) {
    const std::string bytes = read_regular_file(path);
    std::vector<int> labels = parse_labels(bytes, path, shape.mesh.face_count());
    const auto wrong =
        std::find_if(labels.begin(), labels.end(), [&](int label) { return label < 0 || label >= count; });
    if (wrong != labels.end())
        throw Error(ExitCode::input,
                    path + ": face " + std::to_string(wrong - labels.begin()) + " has " +
                        std::to_string(*wrong) +
                        ", which the run did not have; correct the file, or run coseg run again");
    if (!checksum.empty() && hash_bytes(bytes).hex() != checksum) shape.changed_files.push_back(path);
    return labels;
}

LabelledMesh read_shape(const FinishedRun& run, int number, const FinishedInput& input,
                        const std::map<std::string, std::string>& paths) {
    const FinishedShape& shape = run.shapes[at(number)];
    LabelledMesh labelled;
    labelled.number = number;
    labelled.name = shape.name;
    labelled.path = path_of(shape, paths);
    labelled.mesh = read_mesh(labelled.path);
    const int faces = labelled.mesh.face_count();
    labelled.part = read_checked(labelled, result_files::path_of(result_files::parts, run.folder, shape.name),
                                 shape.labels_xxh3, run.parts);
    labelled.patch =
        read_checked(labelled, result_files::path_of(result_files::patches, run.folder, shape.name),
                     shape.patches_xxh3, std::numeric_limits<int>::max());
    const std::string truth = input.truth + "/" + shape.name + label_suffix;
    if (!input.truth.empty() && fs::exists(truth)) labelled.truth = read_labels(truth, faces);
    return labelled;
}

struct ChangedFile {
    std::string path;
    static constexpr auto fields() { return std::tuple(field("path", &ChangedFile::path)); }
};

/// Collective.
void warn_of_changed_files(const Comm& comm, const std::vector<LabelledMesh>& shapes) {
    std::vector<ChangedFile> mine;
    for (const LabelledMesh& shape : shapes) {
        for (const std::string& path : shape.changed_files) mine.push_back({path});
    }
    const std::vector<ChangedFile> all = all_gather_records(comm, mine);
    if (all.empty() || !comm.is_root()) return;
    const auto first = std::min_element(
        all.begin(), all.end(), [](const ChangedFile& a, const ChangedFile& b) { return a.path < b.path; });
    std::fprintf(stderr, "coseg: warning: %s%s\n", changed_file_sentence(first->path).c_str(),
                 all.size() > 1 ? (", like " + std::to_string(all.size() - 1) + " more").c_str() : "");
}

int largest_truth_label(const std::vector<LabelledMesh>& shapes) {
    int largest = -1;
    for (const LabelledMesh& shape : shapes) {
        for (const int label : shape.truth) largest = std::max(largest, label);
    }
    return largest;
}

void add_agreement(ExactSum& gains, const LabelledMesh& shape, int labels) {
    const std::vector<double> areas = relative_areas(shape.mesh);
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::map<std::pair<int, int>, double> shares;
    for (std::size_t f = 0; f < shape.truth.size(); ++f) {
        if (shape.truth[f] >= 0 && total > 0.0) shares[{shape.part[f], shape.truth[f]}] += areas[f] / total;
    }
    for (const auto& [cell, share] : shares) {
        gains.add_scalar(static_cast<std::size_t>(cell.first) * static_cast<std::size_t>(labels) +
                             static_cast<std::size_t>(cell.second),
                         std::min(share, 1.0));
    }
}

}  // namespace

FinishedRun read_run(const Comm& comm, const std::string& folder) {
    FinishedRun run;
    agree(comm, [&] { run = read_finished_run(folder); });
    if (run.is_report_changed && comm.is_root())
        std::fprintf(stderr, "coseg: warning: %s\n", changed_file_sentence(report_path(folder)).c_str());
    return run;
}

std::vector<LabelledMesh> read_shapes(const Comm& comm, const FinishedRun& run, const FinishedInput& input) {
    std::vector<LabelledMesh> shapes;
    agree(comm, [&] {
        if (!input.truth.empty() && !fs::is_directory(input.truth)) {
            throw Error(ExitCode::input, "'" + input.truth +
                                             "' is not a folder; --truth takes the folder that " +
                                             "holds one NAME.seg for each mesh NAME");
        }
        const std::map<std::string, std::string> paths = paths_by_name(input.meshes);
        const std::map<std::string, Eigen::Matrix3d> rotations = rotations_of(run);
        const int count = static_cast<int>(run.shapes.size());
        for (int number = comm.rank(); number < count; number += comm.size()) {
            shapes.push_back(read_shape(run, number, input, paths));
            const auto rotation = rotations.find(shapes.back().name);
            if (rotation != rotations.end()) shapes.back().rotation = rotation->second;
        }
    });
    warn_of_changed_files(comm, shapes);
    return shapes;
}

PictureMesh standing_picture(const LabelledMesh& shape, const std::vector<Color>& color_of_face) {
    if (shape.rotation.isIdentity(0.0)) return picture_mesh(shape.mesh, color_of_face);
    return picture_mesh(turned(shape.mesh, shape.rotation), color_of_face);
}

std::vector<int> agree_on_truth(const Comm& comm, const std::vector<LabelledMesh>& shapes, int parts) {
    const int largest = all_max(comm, largest_truth_label(shapes));
    if (largest < 0) throw AgreedError(ExitCode::input, "no shape has its truth in the folder of --truth");
    if (largest >= most_truth_labels) {
        throw AgreedError(ExitCode::input, "the truth has labels of " + std::to_string(most_truth_labels) +
                                               " and more; number them from 0");
    }
    const int labels = largest + 1;
    ExactSum gains(static_cast<std::size_t>(parts) * static_cast<std::size_t>(labels));
    for (const LabelledMesh& shape : shapes) add_agreement(gains, shape, labels);
    gains.reduce(comm);
    return best_assignment(
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            gains.scalars().data(), parts, labels));
}

std::vector<bool> wrong_faces(const LabelledMesh& shape, const std::vector<int>& label_of_part) {
    std::vector<bool> is_wrong(shape.part.size(), false);
    for (std::size_t f = 0; f < shape.truth.size(); ++f)
        is_wrong[f] = shape.truth[f] < 0 || label_of_part[at(shape.part[f])] != shape.truth[f];
    return is_wrong;
}

std::optional<double> right_share(const LabelledMesh& shape, const std::vector<bool>& is_wrong) {
    const std::vector<double> areas = relative_areas(shape.mesh);
    double right_area = 0.0;
    for (std::size_t f = 0; f < areas.size(); ++f) right_area += is_wrong[f] ? 0.0 : areas[f];
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    return total > 0.0 ? std::optional<double>(right_area / total) : std::nullopt;
}

}  // namespace coseg
