#include "mpi_drivers/results/picture_stage.hpp"

#include <algorithm>

#include "mpi_drivers/finished_runs/sheet_kinds.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "src/base/index.hpp"
#include "src/mesh/turned_polygons.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

std::vector<double> mean_part_area(const Comm& comm, const std::vector<MeshLabels>& labels,
                                   std::size_t meshes, std::size_t parts) {
    ExactSum shares(parts);
    for (const MeshLabels& mesh : labels) {
        for (std::size_t p = 0; p < parts; ++p) shares.add_scalar(p, std::min(mesh.part_area[p], 1.0));
    }
    shares.reduce(comm);
    std::vector<double> mean = shares.scalars();
    for (double& share : mean) share /= static_cast<double>(meshes);
    return mean;
}

PolygonMesh standing(const RunOutcome& outcome, const MeshDescription& mesh) {
    if (outcome.alignment == nullptr || !outcome.alignment->applied()) return mesh.input;
    return turned(mesh.input, outcome.alignment->shapes[at(mesh.mesh)].rotation);
}

}  // namespace

void write_run_sheet(const Comm& comm, const std::string& folder, const RunOutcome& outcome,
                     const ViewChoice& choice) {
    const Collection& collection = outcome.collection;
    const std::vector<MeshLabels>& labels = outcome.labels;
    std::vector<DrawnShape> shapes;
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            shapes.push_back({mesh.mesh, collection.meshes[at(mesh.mesh)].name,
                              picture_mesh(standing(outcome, mesh), colors_of(labels[k].part))});
        }
    });
    const std::vector<double> part_area =
        mean_part_area(comm, labels, collection.meshes.size(), static_cast<std::size_t>(outcome.parts));
    const int count = static_cast<int>(collection.meshes.size());
    const View view = agree_on_view(comm, shapes, choice);
    write_sheets(comm, folder, {to_string(SheetColoring::parts), parts_heading(part_area, count), view},
                 shapes, count);
}

}  // namespace coseg
