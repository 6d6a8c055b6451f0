#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/data_files/label_file.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "mpi_drivers/finished_runs/annotator_score.hpp"
#include "mpi_drivers/options/command.hpp"
#include "src/base/error.hpp"
#include "src/mesh/polygon_area.hpp"
#include "src/metrics/segmentation_score.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions {
    std::string truth_folder;
    std::string labels_folder;
    std::string patches_folder;
    std::string annotators_folder;
    std::vector<std::string> meshes;
    bool json = false;
};

struct ScoreInput {
    std::vector<LabelledShape> shapes;
    double patch_bound = 0.0;  ///< mean over shapes, 0 without --patches
    std::vector<std::string> meshes_without_truth;
    std::vector<std::string> truth_without_mesh;
};

std::string label_path(const std::string& folder, const std::string& name) {
    return (fs::path(folder) / (name + label_suffix)).string();
}

void require_folder(const std::string& folder, const std::string& option) {
    if (fs::is_directory(folder)) return;
    throw Error(ExitCode::input, "'" + folder + "' is not a folder; " + option +
                                     " takes the folder that holds one NAME.seg for each mesh NAME.");
}

/// A shape without a label file is not read: it may be a mesh that the segmentation had to set aside.
LabelledShape read_shape(const MeshEntry& mesh, const ScoreOptions& options) {
    const std::string labels_path = label_path(options.labels_folder, mesh.name);
    const std::string truth_path = label_path(options.truth_folder, mesh.name);
    LabelledShape shape{.name = mesh.name, .truth = {}, .labels = {}, .face_area = {}};
    if (!fs::exists(labels_path)) return shape;
    const PolygonMesh polygons = read_mesh(mesh.path);
    shape.face_area = relative_areas(polygons);
    shape.truth = read_labels(truth_path, polygons.face_count());
    shape.labels = read_labels(labels_path, polygons.face_count());
    return shape;
}

double bound_of_patches(LabelledShape shape, const ScoreOptions& options) {
    if (options.patches_folder.empty() || !shape.labels) return 0.0;
    shape.labels =
        read_labels(label_path(options.patches_folder, shape.name), static_cast<int>(shape.truth.size()));
    return upper_bound_of_labels(shape);
}

ScoreInput read_input(const ScoreOptions& options) {
    require_folder(options.truth_folder, "--truth");
    require_folder(options.labels_folder, "--labels");
    ScoreInput input;
    double bounds = 0.0;
    input.truth_without_mesh = label_file_names(options.truth_folder);
    for (const MeshEntry& mesh : expand_mesh_list(options.meshes)) {
        if (std::erase(input.truth_without_mesh, mesh.name) == 0) {
            input.meshes_without_truth.push_back(mesh.name);
        } else {
            input.shapes.push_back(read_shape(mesh, options));
            bounds += bound_of_patches(input.shapes.back(), options);
        }
    }
    const bool has_labels = std::any_of(input.shapes.begin(), input.shapes.end(),
                                        [](const LabelledShape& shape) { return shape.labels.has_value(); });
    if (!input.shapes.empty() && !has_labels) {
        throw Error(ExitCode::input, "no mesh has its labels in '" + options.labels_folder + "'; those of '" +
                                         input.shapes.front().name + "' would be '" +
                                         label_path(options.labels_folder, input.shapes.front().name) + "'.");
    }
    if (!input.shapes.empty()) {
        input.patch_bound = bounds / static_cast<double>(input.shapes.size());
        return input;
    }
    throw Error(ExitCode::input, "no mesh has its truth in '" + options.truth_folder + "'; the truth of '" +
                                     input.meshes_without_truth.front() + "' would be '" +
                                     label_path(options.truth_folder, input.meshes_without_truth.front()) +
                                     "'.");
}

std::vector<std::string> missing_names(const SegmentationScore& score) {
    std::vector<std::string> names;
    for (const ShapeScore& shape : score.shapes) {
        if (shape.missing) names.push_back(shape.name);
    }
    return names;
}

double percent(double share) { return 100.0 * share; }

/// Enough digits to compare runs, few enough that nobody takes the last one for real.
double rounded(double value) { return std::round(1e4 * value) / 1e4; }

nlohmann::ordered_json per_shape(const SegmentationScore& score, double ShapeScore::*figure, double unit) {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const ShapeScore& shape : score.shapes) result[shape.name] = rounded(unit * shape.*figure);
    return result;
}

nlohmann::ordered_json to_json(const SegmentationScore& score, const ScoreInput& input,
                               const ScoreOptions& options) {
    nlohmann::ordered_json result;
    result["one_to_one"] = rounded(percent(score.one_to_one));
    result["many_to_one"] = rounded(percent(score.many_to_one));
    result["one_label"] = rounded(percent(score.one_label));
    if (!options.patches_folder.empty()) result["patch_bound"] = rounded(percent(input.patch_bound));
    result["rand_index"] = rounded(score.rand_index);
    result["face_rand_index"] = rounded(score.face_rand_index);
    result["clusters"] = score.clusters;
    result["labels"] = score.truth_labels;
    result["shapes"] = score.shapes.size();
    result["missing"] = missing_names(score);
    result["meshes_without_truth"] = input.meshes_without_truth;
    result["truth_without_mesh"] = input.truth_without_mesh;
    result["per_shape"] = per_shape(score, &ShapeScore::one_to_one, 100.0);
    result["per_shape_many_to_one"] = per_shape(score, &ShapeScore::many_to_one, 100.0);
    result["per_shape_rand_index"] = per_shape(score, &ShapeScore::rand_index, 1.0);
    return result;
}

std::string right_aligned(double value, int decimals, int width) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << std::setw(width) << value;
    return text.str();
}

std::string padded(const std::string& name, std::size_t width) {
    return name + std::string(width - name.size(), ' ');
}

std::string table_row(const std::string& padded_name, double one_to_one, double many_to_one,
                      double rand_index) {
    return padded_name + right_aligned(percent(one_to_one), 2, 12) +
           right_aligned(percent(many_to_one), 2, 13) + right_aligned(rand_index, 4, 12) + "\n";
}

std::string listed(const std::string& what, const std::vector<std::string>& names) {
    if (names.empty()) return "";
    std::string text = what + ":";
    for (const std::string& name : names) text += " " + name;
    return text + "\n";
}

std::string to_table(const SegmentationScore& score, const ScoreInput& input) {
    const std::string mean_name = "mean of " + std::to_string(score.shapes.size());
    std::size_t width = mean_name.size();
    for (const ShapeScore& shape : score.shapes) width = std::max(width, shape.name.size());

    std::string text = std::string(width, ' ') + "  one-to-one  many-to-one  Rand index\n";
    for (const ShapeScore& shape : score.shapes) {
        const std::string name = padded(shape.name, width);
        text += shape.missing ? name + "  no labels: counts as 0\n"
                              : table_row(name, shape.one_to_one, shape.many_to_one, shape.rand_index);
    }
    text += table_row(padded(mean_name, width), score.one_to_one, score.many_to_one, score.rand_index);
    text += "\n" + std::to_string(score.clusters) + " parts against " + std::to_string(score.truth_labels) +
            " truth labels; one single part for everything would score " +
            right_aligned(percent(score.one_label), 2, 0) + "\n";
    text += listed("without labels, counted as 0", missing_names(score));
    text += listed("not scored, no truth", input.meshes_without_truth);
    text += listed("not scored, their truth has no mesh here", input.truth_without_mesh);
    return text;
}

void run_score(const Invocation& invocation, const ScoreOptions& options) {
    agree(invocation.world, [&] {
        if (!invocation.world.is_root()) return;
        if (!options.annotators_folder.empty()) {
            require_folder(options.labels_folder, "--labels");
            std::cout << annotator_json(compare_with_annotators(expand_mesh_list(options.meshes),
                                                                options.annotators_folder,
                                                                options.labels_folder))
                      << std::flush;
            return;
        }
        const ScoreInput input = read_input(options);
        const SegmentationScore score = score_segmentation(input.shapes);
        std::cout << (options.json ? to_json(score, input, options).dump(2) + "\n" : to_table(score, input))
                  << std::flush;
    });
}

}  // namespace

Command add_score_command(CLI::App& parent) {
    auto options = std::make_shared<ScoreOptions>();
    CLI::App* app = parent.add_subcommand(
        "score",
        "Compare the labels of a collection with the truth: accuracy by area in percent, Rand index");
    CLI::Option_group* known = app->add_option_group("known", "What the labels are compared with");
    known->add_option("--truth", options->truth_folder, "Folder of the truth: NAME.seg for each mesh NAME");
    known->add_option("--annotators", options->annotators_folder,
                      "Folder of several people's segmentations: NAME/NAME_*.seg; prints the measures of the "
                      "Princeton benchmark as JSON");
    known->require_option(1);
    app->add_option("--labels", options->labels_folder, "Folder of the labels to score: NAME.seg")
        ->required();
    app->add_option(
        "--patches", options->patches_folder,
        "Folder of patches, NAME.seg: tells how good labels of these patches can be (with --json)");
    app->add_flag("--json", options->json, "Print one JSON object instead of a table");
    app->add_option("meshes", options->meshes, "Meshes, folders of meshes, or @LIST of either")->required();
    return {app, [options](const Invocation& invocation) { run_score(invocation, *options); }};
}

}  // namespace coseg
