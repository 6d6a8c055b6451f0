#include "mpi_drivers/finished_runs/border_export.hpp"

#include <algorithm>
#include <cmath>

#include "io/part_files/border_file.hpp"
#include "io/part_files/part_table.hpp"
#include "mpi_drivers/finished_runs/shape_parts.hpp"
#include "mpi_drivers/finished_runs/shown_descriptors.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/moderate_scale.hpp"
#include "src/mesh/polygon_area.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

/// The mean of each descriptor over the faces of a part, weighted by area; 0 for a part without area.
std::vector<double> descriptor_means(const LabelledMesh& shape, int part, const std::vector<double>& areas,
                                     const std::vector<std::vector<double>>& values) {
    std::vector<double> means(values.size(), 0.0);
    double total = 0.0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        if (shape.part[f] != part) continue;
        total += areas[f];
        for (std::size_t k = 0; k < values.size(); ++k) means[k] += areas[f] * values[k][f];
    }
    for (double& mean : means) mean = total > 0.0 ? mean / total : 0.0;
    return means;
}

/// Measures are in the units of the files, whose squares and cubes doubles must hold.
void refuse_extreme(const LabelledMesh& shape) {
    const int exponent = extreme_exponent(shape.mesh);
    if (exponent == 0) return;
    throw Error(ExitCode::input, shape.path + ": its largest coordinate is about 1e" +
                                     std::to_string(std::lround(exponent * std::log10(2.0))) +
                                     ", of which no areas and volumes can be measured; scale the mesh and "
                                     "run coseg run again");
}

MeasuredShape write_and_measure(const BorderExport& task, const LabelledMesh& shape) {
    const PartSurface surface = part_surface(shape);
    const std::vector<BorderCurve> curves = part_borders(surface.mesh, surface.part);
    write_border_lines(task.folder + "/" + shape.name + ".obj", surface.mesh, curves, task.part_names);
    write_border_vtp(task.folder + "/" + shape.name + ".vtp", surface.mesh, curves);
    std::vector<std::vector<double>> values;
    if (!task.descriptors.empty()) values = shown_descriptors(task.run, shape, task.descriptors);
    const std::vector<double> areas = polygon_areas(shape.mesh);
    MeasuredShape measured{shape.number, shape.name, {}};
    for (PartMeasures& measured_part : part_measures(surface.mesh, surface.part, curves)) {
        const int part = measured_part.part;
        measured.parts.push_back({std::move(measured_part), descriptor_means(shape, part, areas, values)});
    }
    return measured;
}

}  // namespace

void export_borders(const Comm& comm, const BorderExport& task) {
    std::vector<MeasuredShape> measured;
    agree(comm, [&] {
        for (const LabelledMesh& shape : task.shapes) refuse_extreme(shape);
        for (const LabelledMesh& shape : task.shapes) measured.push_back(write_and_measure(task, shape));
    });
    std::vector<MeasuredShape> all = gather_records(comm, measured);
    agree(comm, [&] {
        if (!comm.is_root()) return;
        std::sort(all.begin(), all.end(),
                  [](const MeasuredShape& a, const MeasuredShape& b) { return a.number < b.number; });
        PartTableHeading heading{task.part_names, {}};
        for (const int row : task.descriptors)
            heading.descriptors.push_back(descriptor_table()[at(row)].name);
        write_part_tables(task.folder, heading, all);
    });
}

}  // namespace coseg
