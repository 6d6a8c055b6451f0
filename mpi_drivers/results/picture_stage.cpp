#include "mpi_drivers/results/picture_stage.hpp"

#include <algorithm>

#include "mpi_drivers/finished_runs/sheet_kinds.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "src/base/index.hpp"
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

}  // namespace

void write_run_sheet(const Comm& comm, const std::string& folder, const Collection& collection,
                     const std::vector<MeshLabels>& labels, int parts, const ViewChoice& choice) {
    std::vector<DrawnShape> shapes;
    agree(comm, [&] {
        for (std::size_t k = 0; k < labels.size(); ++k) {
            const MeshDescription& mesh = collection.local[k];
            shapes.push_back({mesh.mesh, collection.meshes[at(mesh.mesh)].name,
                              picture_mesh(mesh.input, colors_of(labels[k].part))});
        }
    });
    const std::vector<double> part_area =
        mean_part_area(comm, labels, collection.meshes.size(), static_cast<std::size_t>(parts));
    const int count = static_cast<int>(collection.meshes.size());
    const View view = agree_on_view(comm, shapes, choice);
    write_sheets(comm, folder, {to_string(SheetColoring::parts), parts_heading(part_area, count), view},
                 shapes, count);
}

}  // namespace coseg
