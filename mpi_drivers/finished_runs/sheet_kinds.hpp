#pragma once
// The kinds of contact sheets: they differ in what colours the faces and in what the legend says.

#include <string>
#include <vector>

#include "io/data_files/name_file.hpp"
#include "mpi_drivers/finished_runs/finished_shapes.hpp"
#include "mpi_drivers/finished_runs/sheet_stage.hpp"
#include "mpi_drivers/finished_runs/shown_descriptors.hpp"

namespace coseg {

/// parts, patches, truth, errors and the names of the descriptors.
std::vector<std::string> sheet_kinds();

/// "20 shapes, 5 parts", and a swatch and the mean share of the area for each part.
SheetHeading parts_heading(const std::vector<double>& part_area, int shapes);

/// The colour of each face by its part, or by its patch.
std::vector<Color> colors_of(const std::vector<int>& labels);

/// What is known of the parts beside the run itself.
struct PartKey {
    std::vector<int> label_of_part;  ///< from agree_on_truth; empty: no truth is given
    LabelNames names;                ///< of the truth's labels, or of the parts if no truth is given
};

/// The shapes of this rank, drawn as `kind` asks, and the heading, which is on all ranks. Truth and errors
/// need label_of_part. A true label has the colour of the part that stands for it; labels for which no part
/// stands take the colours after those of the parts. Collective; throws AgreedError.
struct DrawnKind {
    std::vector<DrawnShape> shapes;
    SheetHeading heading;
};
DrawnKind drawn_kind(const Comm& comm, const FinishedRun& run, const std::vector<LabelledMesh>& shapes,
                     const std::string& kind, const PartKey& key);

}  // namespace coseg
