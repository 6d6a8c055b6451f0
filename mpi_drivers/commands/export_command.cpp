// `coseg export`: a finished run's shapes for ParaView (VTK) and for modelling programs (OBJ).

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "io/mesh_files/obj_format.hpp"
#include "io/mesh_files/vtk_writer.hpp"
#include "mpi_drivers/finished_runs/face_descriptors.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/options/command.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
    FinishedInput input;
    std::vector<std::string> formats = {"vtk"};
    std::string out;
    bool descriptors = true;
};

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

CellData cell_data(const FinishedRun& run, const LabelledMesh& shape, bool with_descriptors) {
    CellData data;
    data.labels = {{"part", shape.part}, {"patch", shape.patch}};
    if (!shape.truth.empty()) data.labels.emplace_back("truth", shape.truth);
    if (!with_descriptors) return data;
    const FaceDescriptors values = face_descriptors(run, shape);
    for (std::size_t h = 0; h < values.size(); ++h) data.values.emplace_back(feature_names[h], values[h]);
    return data;
}

void export_vtk(const Comm& world, const FinishedRun& run, const std::vector<LabelledMesh>& shapes,
                const ExportOptions& options, const std::string& out) {
    std::vector<DrawnShape> outlines;
    for (const LabelledMesh& shape : shapes)
        outlines.push_back(
            {shape.number, "", picture_mesh(shape.mesh, std::vector<Color>(shape.part.size()))});
    const View front = agree_on_view(world, outlines, {"front", "auto"});
    agree(world, [&] {
        for (const LabelledMesh& shape : shapes) {
            const CellData data = cell_data(run, shape, options.descriptors);
            write_vtp(out + "/vtk/" + shape.name + ".vtp", shape.mesh, data);
            write_vtp(out + "/vtk/grid/" + shape.name + ".vtp",
                      on_grid(shape, static_cast<int>(run.shapes.size()), front), data);
        }
        if (!world.is_root()) return;
        std::vector<std::pair<std::string, std::string>> files;
        for (const FinishedShape& shape : run.shapes)
            files.emplace_back(shape.name, "grid/" + shape.name + ".vtp");
        write_vtm(out + "/vtk/collection.vtm", files);
        std::cout << out << "/vtk/collection.vtm" << std::endl;
    });
}

void export_obj(const Comm& world, const FinishedRun& run, const std::vector<LabelledMesh>& shapes,
                const std::string& out) {
    agree(world, [&] {
        for (const LabelledMesh& shape : shapes)
            write_part_obj(out + "/obj/" + shape.name + ".obj", "parts.mtl", shape.mesh, shape.part);
        if (!world.is_root()) return;
        write_part_materials(out + "/obj/parts.mtl", run.parts);
        std::cout << out << "/obj" << std::endl;
    });
}

/// Collective over the invocation's ranks.
void export_run(const ExportOptions& options, const Comm& world) {
    const FinishedRun run = read_run(world, options.input.folder);
    const std::vector<LabelledMesh> shapes = read_shapes(world, run, options.input);
    const std::string out = options.out.empty() ? options.input.folder : options.out;
    for (const std::string& format : options.formats) {
        agree(world, [&] {
            if (!world.is_root()) return;
            const fs::path folder = fs::path(out) / (format == "vtk" ? "vtk/grid" : "obj");
            std::error_code cause;
            fs::create_directories(folder, cause);
            if (cause)
                throw Error(ExitCode::output, folder.string() + ": cannot be made (" + cause.message() + ")");
        });
        format == "vtk" ? export_vtk(world, run, shapes, options, out) : export_obj(world, run, shapes, out);
    }
}

}  // namespace

Command add_export_command(CLI::App& parent) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App* app =
        parent.add_subcommand("export", "Write a finished run for ParaView or for modelling programs");
    app->add_option("RESULT", options->input.folder, "The folder that coseg run was given with --out")
        ->required();
    app->add_option("--to", options->formats,
                    "vtk (a VTP per shape with parts, patches and descriptors, and collection.vtm with all "
                    "of them in a "
                    "grid), obj (one material per part), or both with a comma")
        ->delimiter(',')
        ->capture_default_str()
        ->check(CLI::IsMember({"vtk", "obj"}));
    app->add_flag("--descriptors,!--no-descriptors", options->descriptors,
                  "Compute the descriptors again for vtk (on by default)");
    app->add_option("--truth", options->input.truth,
                    "Folder of known labels, NAME.seg: become the array truth");
    app->add_option("--meshes", options->input.meshes,
                    "Where the meshes are now, if not where the run found them: files, folders or @LIST")
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--out", options->out,
                    "Folder to write into: vtk/ and obj/ in it; RESULT itself if not given");
    app->footer("Example: mpirun -n 2 coseg export result --to vtk,obj");
    return {app, [options](const Invocation& invocation) { export_run(*options, invocation.world); }};
}

}  // namespace coseg
