#pragma once
// Writes DIR/report.html: one file that shows a run and needs no network.

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "src/pictures/picture_mesh.hpp"
#include "src/pictures/shape_view.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// A shape's triangles as the page reads them, in base64: little endian, uint32 vertices V and faces F, 3 V
/// uint16 coordinates over -1..1, padded to 4 bytes, 3 F corners (uint16, or uint32 if V > 65535), F uint16
/// labels with 0x8000 set where wrong. mesh: in the unit ball (src/pictures/picture_mesh.hpp).
std::string packed_mesh(const TriMesh& mesh, const std::vector<int>& labels,
                        const std::vector<bool>& is_wrong);

struct PageShape {
    int number = 0;                  ///< in the run
    std::string packed;              ///< packed_mesh; empty if the shape is in the table only
    std::optional<double> accuracy;  ///< 0..1, where the truth is known
    static constexpr auto fields() {
        return std::tuple(field("number", &PageShape::number), field("packed", &PageShape::packed),
                          field("accuracy", &PageShape::accuracy));
    }
};

struct ReportPage {
    std::string title;
    std::string report_json;  ///< the content of report.json
    std::string sheet_png;    ///< the content of contact_sheet.png; empty if there is none
    View view;
    std::optional<double> accuracy;  ///< mean over the shapes
    std::vector<PageShape> shapes;   ///< in the order of the report's
};

/// Whether the libraries that the page needs are built in.
bool can_write_report_page();

/// Writes the page whole or not at all. Throws Error(output) as atomic_file.hpp does, Error(internal) if the
/// libraries are not built in.
void write_report_page(const std::string& path, const ReportPage& page);

}  // namespace coseg
