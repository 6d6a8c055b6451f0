// `coseg export`: a finished run's shapes in any format that is written, for ParaView and modelling programs,
// and the borders and measures of their parts.

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "io/data_files/label_file.hpp"
#include "io/mesh_files/mesh_format.hpp"
#include "mpi_drivers/finished_runs/border_export.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/part_export.hpp"
#include "mpi_drivers/finished_runs/shape_parts.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/finished_runs/shown_descriptors.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
    FinishedInput input;
    std::vector<std::string> formats = {"vtk"};
    std::string out;
    std::string names;
    bool descriptors = true;
    bool split = false;
    bool instances = false;
};

constexpr const char* borders_kind = "borders";  // not a mesh format

std::vector<std::string> exported_kinds() {
    std::vector<std::string> kinds = writable_formats();
    kinds.emplace_back(borders_kind);
    return kinds;
}

constexpr double grid_step = 2.2;  // shapes have radius 1

/// The shape with radius 1 at its place in a grid that is read like a page, in the plane of right and up.
PolygonMesh on_grid(const LabelledMesh& shape, int shapes, const View& front) {
    const int columns = sheet_columns(shapes);
    PolygonMesh placed = shape.mesh;
    Eigen::Vector3d low = placed.vertices.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& p : placed.vertices) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double radius = std::max(0.5 * (high - low).norm(), 1e-300);
    const int row = shape.number / columns;
    const int column = shape.number % columns;
    const Eigen::Vector3d place = grid_step * (column * front.right() - row * front.up);
    for (Eigen::Vector3d& p : placed.vertices) p = (p - 0.5 * (low + high)) / radius + place;
    return placed;
}

/// Those that count by default.
std::vector<int> exported_descriptors() {
    std::vector<int> rows;
    const std::vector<Descriptor>& table = descriptor_table();
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table[row].weight > 0.0) rows.push_back(static_cast<int>(row));
    }
    return rows;
}

/// What is known of the parts of this rank's shapes beside their faces.
struct PartFacts {
    std::vector<std::string> names;
    std::vector<std::vector<int>> instances;  ///< per shape and face; empty if they are not asked for
};

/// What is exported, and into which format.
struct Export {
    const FinishedRun& run;
    const std::vector<LabelledMesh>& shapes;  ///< of this rank
    const PartFacts& facts;
    const MeshFormat& format;
    std::string folder;
    bool with_descriptors = true;
    bool split = false;

    [[nodiscard]] bool has_collection() const { return format.write_collection != nullptr && !split; }
    [[nodiscard]] std::string file(const std::string& name) const {
        return name + std::string(format.suffix);
    }
};

/// Of this rank's shape number k.
FaceArrays face_arrays(const Export& task, std::size_t k) {
    const LabelledMesh& shape = task.shapes[k];
    FaceArrays arrays;
    arrays.part_names = task.facts.names;
    arrays.labels = {{"part", shape.part}, {"patch", shape.patch}};
    if (!task.facts.instances.empty()) arrays.labels.emplace_back("piece", task.facts.instances[k]);
    if (!shape.truth.empty()) arrays.labels.emplace_back("truth", shape.truth);
    if (!task.with_descriptors) return arrays;
    const std::vector<int> rows = exported_descriptors();
    const std::vector<std::vector<double>> values = shown_descriptors(task.run, shape, rows);
    for (std::size_t row = 0; row < rows.size(); ++row)
        arrays.values.emplace_back(descriptor_table()[at(rows[row])].name, values[row]);
    return arrays;
}

/// Collective: the view in which the grid of a collection is laid out.
View view_of_grid(const Comm& world, const std::vector<LabelledMesh>& shapes) {
    std::vector<DrawnShape> outlines;
    for (const LabelledMesh& shape : shapes)
        outlines.push_back(
            {shape.number, "", picture_mesh(shape.mesh, std::vector<Color>(shape.part.size()))});
    return agree_on_view(world, outlines, {.view = "front"});
}

/// The shapes of this rank in a file each, and again in the grid if the format has a file that opens many.
void write_shapes(const Export& task, const View& front) {
    for (std::size_t k = 0; k < task.shapes.size(); ++k) {
        const LabelledMesh& shape = task.shapes[k];
        const FaceArrays arrays = face_arrays(task, k);
        if (task.split) {
            write_split(task.format, task.folder + "/" + shape.name, shape, arrays, task.run.parts);
            continue;
        }
        write_whole(task.format, task.folder + "/" + task.file(shape.name), shape, arrays);
        if (!task.has_collection()) continue;
        task.format.write(task.folder + "/grid/" + task.file(shape.name),
                          on_grid(shape, static_cast<int>(task.run.shapes.size()), front), arrays);
    }
}

void write_collection(const Export& task) {
    std::vector<std::pair<std::string, std::string>> files;
    for (const FinishedShape& shape : task.run.shapes)
        files.emplace_back(shape.name, "grid/" + task.file(shape.name));
    const std::string path = task.folder + "/collection" + std::string(task.format.collection_suffix);
    task.format.write_collection(path, files);
    std::cout << path << std::endl;
}

/// Collective.
void make_folder(const Comm& world, const std::string& folder) {
    agree(world, [&] {
        std::error_code cause;
        if (world.is_root()) fs::create_directories(folder, cause);
        if (cause) throw Error(ExitCode::output, folder + ": cannot be made (" + cause.message() + ")");
    });
}

/// Collective.
void export_shapes(const Comm& world, const Export& task) {
    make_folder(world, task.has_collection() ? task.folder + "/grid" : task.folder);
    const View front = task.has_collection() ? view_of_grid(world, task.shapes) : View{};
    agree(world, [&] {
        write_shapes(task, front);
        if (!world.is_root()) return;
        if (task.format.write_shared != nullptr && !task.split)
            task.format.write_shared(task.folder, task.run.parts);
        if (task.has_collection())
            write_collection(task);
        else
            std::cout << task.folder << std::endl;
    });
}

/// OUT/instances/NAME.seg. Collective.
void write_instances(const Comm& world, const std::vector<LabelledMesh>& shapes, const PartFacts& facts,
                     const std::string& out) {
    const std::string folder = out + "/instances";
    make_folder(world, folder);
    agree(world, [&] {
        for (std::size_t k = 0; k < shapes.size(); ++k)
            write_labels(folder + "/" + shapes[k].name + label_suffix, facts.instances[k]);
        if (world.is_root()) std::cout << folder << std::endl;
    });
}

/// Meshes that lie where the export writes would be replaced by what it makes of them.
void refuse_output_over_meshes(const std::vector<LabelledMesh>& shapes, const ExportOptions& options,
                               const std::string& out) {
    if (options.split) return;  // into folders that are named like the meshes
    for (const std::string& name : options.formats) {
        if (name == borders_kind) continue;
        for (const LabelledMesh& shape : shapes) {
            std::error_code ignored;
            const std::string file =
                out + "/" + name + "/" + shape.name + std::string(writable_format(name).suffix);
            if (fs::equivalent(file, shape.path, ignored))
                throw Error(
                    ExitCode::output,
                    shape.path + ": is a mesh of the run, which would be overwritten; name another --out");
        }
    }
}

/// Collective over the invocation's ranks.
void export_run(const ExportOptions& options, const Comm& world) {
    const FinishedRun run = read_run(world, options.input.folder);
    const std::string out = options.out.empty() ? options.input.folder : options.out;
    agree(world, [&] {
        if (world.is_root()) check_output_folder(out);
    });
    const std::vector<LabelledMesh> shapes = read_shapes(world, run, options.input);
    agree(world, [&] { refuse_output_over_meshes(shapes, options, out); });
    PartFacts facts{names_of_parts(world, run, shapes, options.input, options.names), {}};
    if (options.instances) {
        facts.instances = instances_of(world, shapes);
        write_instances(world, shapes, facts, out);
    }
    for (const std::string& name : options.formats) {
        const std::string folder = out + "/" + name;
        if (name == borders_kind) {
            make_folder(world, folder);
            const std::vector<int> rows = options.descriptors ? exported_descriptors() : std::vector<int>{};
            export_borders(world, {run, shapes, facts.names, rows, folder});
            if (world.is_root()) std::cout << folder << std::endl;
            continue;
        }
        const MeshFormat& format = writable_format(name);
        export_shapes(world, {run, shapes, facts, format, folder, options.descriptors && format.keeps_values,
                              options.split});
    }
}

}  // namespace

Command add_export_command(CLI::App& parent) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App* app =
        parent.add_subcommand("export", "Write a finished run for ParaView or for modelling programs");
    app->add_option("RESULT", options->input.folder, "The folder that coseg run was given with --out")
        ->required();
    app->add_option(
           "--to", options->formats,
           "vtk (a VTP per shape with parts, patches and descriptors, and collection.vtm with all "
           "of them in a grid), glb (one named node per part; of a GLB or glTF with its textures), obj "
           "(one material per part), ply (one colour per part), off, stl, borders (the curves between "
           "parts, and measures of the parts), or several with commas")
        ->delimiter(',')
        ->capture_default_str()
        ->check(CLI::IsMember(exported_kinds()));
    app->add_flag("--split", options->split, "Write every part of every shape as a mesh file of its own");
    app->add_flag("--instances", options->instances,
                  "Number the connected pieces of each part (leg 1 to 4), the same in all shapes that stand "
                  "alike: instances/NAME.seg, and pieces instead of parts in glb and with --split");
    app->add_option(
           "--names", options->names,
           "Names of the parts, one a line or `NUMBER NAME`; names.txt in RESULT, else labels.txt in the "
           "folder of --truth if not given")
        ->type_name("FILE");
    app->add_flag("--descriptors,!--no-descriptors", options->descriptors,
                  "Compute the descriptors again for vtk and borders (on by default)");
    app->add_option("--truth", options->input.truth,
                    "Folder of true labels, NAME.seg: become the array truth");
    app->add_option("--meshes", options->input.meshes,
                    "Where the meshes are now, if not where the run found them: files, folders or @LIST")
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--out", options->out,
                    "Folder to write into: vtk/, glb/, obj/ and so on in it; RESULT itself if not given");
    app->footer("Example: mpirun -n 2 coseg export result --to vtk,obj");
    return {app, [options](const Invocation& invocation) { export_run(*options, invocation.world); }};
}

}  // namespace coseg
