#include "mpi_drivers/results/report_stage.hpp"

#include <algorithm>
#include <filesystem>

#include "io/data_files/result_files.hpp"
#include "io/files/file_contents.hpp"
#include "io/folders/finished_run.hpp"
#include "io/reports/report_page.hpp"
#include "src/base/index.hpp"
#include "src/mesh/vertex_clustering.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

std::string packed_shape(const LabelledMesh& shape, const std::vector<bool>& is_wrong, int most_faces) {
    const PictureMesh picture = standing_picture(shape, std::vector<Color>(shape.part.size()));
    const ClusteredMesh coarse = clustered(picture.mesh, most_faces);
    std::vector<int> labels;
    std::vector<bool> wrong;
    for (const int triangle : coarse.triangle) {
        const auto face = static_cast<std::size_t>(picture.faces[at(triangle)]);
        labels.push_back(shape.part[face]);
        wrong.push_back(is_wrong[face]);
    }
    return packed_mesh(coarse.mesh, labels, wrong);
}

/// All ranks' shapes on the root, in the order of the run; elsewhere empty.
std::vector<PageShape> gathered(const Comm& comm, const std::vector<PageShape>& local) {
    std::vector<PageShape> shapes = gather_records(comm, local);
    std::sort(shapes.begin(), shapes.end(),
              [](const PageShape& a, const PageShape& b) { return a.number < b.number; });
    return shapes;
}

std::vector<DrawnShape> undrawn(const std::vector<LabelledMesh>& shapes) {
    std::vector<DrawnShape> drawn;
    for (const LabelledMesh& shape : shapes)
        drawn.push_back({shape.number, "", standing_picture(shape, std::vector<Color>(shape.part.size()))});
    return drawn;
}

std::optional<double> mean_accuracy(const std::vector<PageShape>& shapes) {
    double sum = 0.0;
    int count = 0;
    for (const PageShape& shape : shapes) {
        if (!shape.accuracy) continue;
        sum += *shape.accuracy;
        ++count;
    }
    return count > 0 ? std::optional<double>(sum / count) : std::nullopt;
}

}  // namespace

void write_html_report(const Comm& comm, const FinishedInput& input, const std::string& out,
                       const ViewChoice& choice) {
    const FinishedRun run = read_run(comm, input.folder);
    const std::vector<LabelledMesh> shapes = read_shapes(comm, run, input);
    std::vector<int> label_of_part;
    if (!input.truth.empty()) label_of_part = agree_on_truth(comm, shapes, run.parts);
    const int count = static_cast<int>(run.shapes.size());
    const int step = (count + report_most_shapes - 1) / report_most_shapes;
    const int most_faces = std::max(report_least_faces, report_face_budget / count);
    std::vector<PageShape> local;
    std::vector<DrawnShape> drawn;
    agree(comm, [&] {
        for (const LabelledMesh& shape : shapes) {
            const std::vector<bool> is_wrong = wrong_faces(shape, label_of_part);
            PageShape page{.number = shape.number, .packed = "", .accuracy = {}};
            if (shape.number % step == 0) page.packed = packed_shape(shape, is_wrong, most_faces);
            if (!shape.truth.empty()) page.accuracy = right_share(shape, is_wrong).value_or(0.0);
            local.push_back(std::move(page));
        }
        drawn = undrawn(shapes);
    });
    ReportPage page;
    page.view = agree_on_view(comm, drawn, choice);
    page.shapes = gathered(comm, local);
    page.accuracy = mean_accuracy(page.shapes);
    page.title =
        "coseg: " + std::to_string(run.shapes.size()) + " shapes, " + std::to_string(run.parts) + " parts";
    agree(comm, [&] {
        if (!comm.is_root()) return;
        page.report_json = read_regular_file(report_path(input.folder));
        const std::string sheet = input.folder + "/" + sheet_file(to_string(SheetColoring::parts));
        if (std::filesystem::exists(sheet)) page.sheet_png = read_regular_file(sheet);
        write_report_page(out + "/" + result_files::page, page);
    });
}

}  // namespace coseg
