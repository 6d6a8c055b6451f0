#include "mpi_drivers/partition/example_stage.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "io/data_files/label_file.hpp"
#include "io/data_files/result_files.hpp"
#include "io/files/atomic_file.hpp"
#include "mpi_drivers/describe/patch_gather.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/patches/patch_label_areas.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

std::string label_path(const std::string& folder, const std::string& name) {
    return folder + "/" + name + label_suffix;
}

/// The names of the shapes that FOLDER has labels of, sorted.
std::vector<std::string> example_names(const std::string& folder) {
    std::vector<std::string> names = label_file_names(folder);
    if (names.empty())
        throw Error(ExitCode::input, "--examples " + folder + ": there is no label file NAME.seg in it");
    return names;
}

/// Labels 0 .. parts-1, and -1 for faces of which nothing is said.
std::vector<int> read_example(const std::string& path, int parts, int faces = -1) {
    std::vector<int> labels = read_labels(path, faces);
    for (std::size_t f = 0; f < labels.size(); ++f) {
        if (labels[f] >= -1 && labels[f] < parts) continue;
        const std::string where =
            path + ": face " + std::to_string(f) + " has label " + std::to_string(labels[f]);
        throw Error(ExitCode::input,
                    labels[f] < 0
                        ? where + "; labels are 0, 1, ..., or -1 where nothing is said"
                        : where + ", but there are " + std::to_string(parts) + " parts; labels count from 0");
    }
    return labels;
}

int labels_in(const std::string& folder) {
    int largest = -1;
    for (const std::string& name : example_names(folder)) {
        const std::vector<int> labels = read_example(label_path(folder, name), most_parts);
        if (!labels.empty()) largest = std::max(largest, *std::max_element(labels.begin(), labels.end()));
    }
    if (largest < 0) throw Error(ExitCode::input, "--examples " + folder + ": no face has a label");
    return largest + 1;
}

/// What FOLDER/names.txt calls the labels; nothing where it is not there.
LabelNames names_in(const std::string& folder, int parts) {
    LabelNames names = names_in_folder(folder);
    refuse_names_beyond(names, parts, folder + "/" + result_files::names);
    return names;
}

void refuse_strangers(const Collection& collection, const std::vector<std::string>& names,
                      const std::string& folder) {
    std::set<std::string> known;
    for (const MeshFacts& mesh : collection.meshes) known.insert(mesh.name);
    for (const std::string& name : names) {
        if (known.count(name) == 0)
            throw Error(ExitCode::input,
                        label_path(folder, name) +
                            ": no shape of this name is segmented; it is not among the meshes, or "
                            "it was set aside");
    }
}

void warn_of_labels_without_example(const Eigen::MatrixXd& areas, StageLog& log) {
    for (Eigen::Index label = 0; label < areas.rows(); ++label) {
        if (areas.row(label).sum() <= 0.0)
            log.warn("no example shows label " + std::to_string(label) +
                     "; it becomes a part that no example has");
    }
}

}  // namespace

Eigen::MatrixXd label_areas(const MeshDescription& mesh, const std::vector<int>& label_of_input_face,
                            int parts) {
    std::vector<int> labels;
    for (const int face : mesh.map.input_face)
        labels.push_back(label_of_input_face.empty() ? -1 : label_of_input_face[at(face)]);
    Eigen::Index patches = 0;
    for (const int count : mesh.patch_counts) patches += count;
    Eigen::MatrixXd areas(parts, patches);
    Eigen::Index first = 0;
    for (std::size_t s = 0; s < mesh.patches.size(); ++s) {
        areas.middleCols(first, mesh.patch_counts[s]) =
            patch_label_areas(mesh.patches[s], mesh.patch_counts[s], labels, parts, mesh.geometry.area);
        first += mesh.patch_counts[s];
    }
    return areas;
}

RunOptions with_parts_of_examples(const Comm& comm, const RunOptions& options) {
    RunOptions result = options;
    PartitionOptions& partition = result.partition;
    if (partition.examples.empty()) {
        if (partition.parts == 0) throw AgreedError(ExitCode::usage, "--parts is required");
        return result;
    }
    int labels = 0;
    agree(comm, [&] {
        if (comm.is_root()) labels = labels_in(partition.examples);
    });
    broadcast(comm, labels);
    if (partition.parts == 0 || partition.parts == found_parts) partition.parts = labels;
    if (labels > partition.parts)
        throw AgreedError(ExitCode::input, "--examples " + partition.examples + ": there is a label " +
                                               std::to_string(labels - 1) + ", which needs --parts " +
                                               std::to_string(labels) + " or more; labels count from 0");
    agree(comm, [&] {
        if (comm.is_root()) names_in(partition.examples, partition.parts);
    });
    return result;
}

GivenLabels read_given_labels(const Comm& comm, const Collection& collection, const PartitionOptions& options,
                              StageLog& log) {
    GivenLabels given;
    if (options.examples.empty()) return given;
    log.begin("examples");
    std::vector<std::string> names;
    std::vector<Eigen::MatrixXd> local;
    agree(comm, [&] {
        names = example_names(options.examples);
        if (comm.is_root()) given.names = names_in(options.examples, options.parts);
        refuse_strangers(collection, names, options.examples);
        for (const MeshDescription& mesh : collection.local) {
            const std::string& name = collection.meshes[at(mesh.mesh)].name;
            const bool is_example = std::binary_search(names.begin(), names.end(), name);
            given.faces.push_back(is_example ? read_example(label_path(options.examples, name), options.parts,
                                                            mesh.map.input_faces)
                                             : std::vector<int>{});
            local.push_back(label_areas(mesh, given.faces.back(), options.parts));
        }
    });
    given.patches.area = gather_patch_columns(comm, collection, local, options.parts);
    if (given.patches.area.sum() <= 0.0)
        throw AgreedError(ExitCode::input, "--examples " + options.examples + ": no face has a label");
    log.end(with_unit(static_cast<std::int64_t>(names.size()), "shape with labels", "shapes with labels"));
    return given;
}

GivenLabels read_examples(const Comm& comm, const Collection& collection, const PartitionOptions& options,
                          StageLog& log) {
    GivenLabels given = read_given_labels(comm, collection, options, log);
    warn_of_labels_without_example(given.patches.area, log);
    return given;
}

void write_part_names(const Comm& comm, const std::string& folder, const LabelNames& names) {
    agree(comm, [&] {
        if (comm.is_root() && !names.empty())
            write_file(folder + "/" + result_files::names, names_text(names));
    });
}

}  // namespace coseg
