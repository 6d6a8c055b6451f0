#include "mpi_drivers/finished_runs/sheet_stage.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "io/data_files/result_files.hpp"
#include "io/reports/png_writer.hpp"
#include "src/base/index.hpp"
#include "src/parallel/exact_sum.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/pictures/shape_picture.hpp"

namespace coseg {

namespace {

constexpr int looked_at = 48;  // shapes that a view is chosen from
constexpr int thumbnail = 112;

int tile_size(int shapes) {
    if (shapes <= 12) return 360;
    return shapes <= 24 ? 300 : 220;
}

UpAxis agreed_up(const Comm& comm, const std::vector<const DrawnShape*>& looked) {
    ExactSum shares(5);
    for (const DrawnShape* shape : looked) {
        const Eigen::Vector3d share = standing_shares(shape->picture.mesh);
        for (int axis = 0; axis < 3; ++axis) shares.add_scalar(static_cast<std::size_t>(axis), share[axis]);
        shares.add_scalar(3, mirror_differences(shape->picture.mesh).y());
        shares.add_scalar(4, 1.0);
    }
    shares.reduce(comm);
    const std::vector<double>& sums = shares.scalars();
    // Most files have y up, but y is the breadth rather than the height where the shapes are alike to both
    // sides.
    constexpr double alike = 0.04;
    const double preference = sums[3] >= alike * sums[4] ? 0.65 : 1.0;
    if (sums[1] >= preference * std::max(sums[0], sums[2])) return UpAxis::y;
    return sums[2] >= sums[0] ? UpAxis::z : UpAxis::x;
}

UpAxis chosen_up(const Comm& comm, const std::vector<const DrawnShape*>& looked, UpChoice choice) {
    switch (choice) {
        case UpChoice::automatic:
            break;
        case UpChoice::x:
            return UpAxis::x;
        case UpChoice::y:
            return UpAxis::y;
        case UpChoice::z:
            return UpAxis::z;
    }
    return agreed_up(comm, looked);
}

View agreed_widest(const Comm& comm, const std::vector<const DrawnShape*>& looked, UpAxis up) {
    const std::vector<View> views = candidate_views({up});
    ExactSum shares(views.size());
    for (const DrawnShape* shape : looked) {
        const std::vector<double> areas = outline_areas(shape->picture.mesh, views);
        const double largest = *std::max_element(areas.begin(), areas.end());
        for (std::size_t v = 0; v < views.size() && largest > 0.0; ++v)
            shares.add_scalar(v, areas[v] / largest);
    }
    shares.reduce(comm);
    const std::vector<double>& sums = shares.scalars();
    const double nearly = 0.98 * *std::max_element(sums.begin(), sums.end());
    std::size_t first = 0;
    while (sums[first] < nearly) ++first;
    return views[first];
}

/// The picture of the shape of this number.
struct NumberedTile {
    int number = 0;
    std::string caption;
    std::vector<std::uint8_t> pixels;
    static constexpr auto fields() {
        return std::tuple(field("number", &NumberedTile::number), field("caption", &NumberedTile::caption),
                          field("pixels", &NumberedTile::pixels));
    }
};

/// Pictures of one page on the root, in the order of the shapes; elsewhere empty.
std::vector<SheetTile> gathered_tiles(const Comm& comm, const std::vector<NumberedTile>& local, int size) {
    std::vector<NumberedTile> all = gather_records(comm, local);
    std::sort(all.begin(), all.end(),
              [](const NumberedTile& a, const NumberedTile& b) { return a.number < b.number; });
    std::vector<SheetTile> tiles;
    for (NumberedTile& tile : all) {
        tiles.push_back({Image(size, size, picture_background), std::move(tile.caption)});
        tiles.back().picture.bytes = std::move(tile.pixels);
    }
    return tiles;
}

/// Shapes begin..end-1, drawn where they are, on the root.
std::vector<SheetTile> drawn_page(const Comm& comm, const SheetRequest& request,
                                  const std::vector<DrawnShape>& shapes_local, int begin, int end, int size) {
    std::vector<NumberedTile> tiles;
    agree(comm, [&] {
        PictureOptions options;
        options.size = size;
        for (const DrawnShape& shape : shapes_local) {
            if (shape.number < begin || shape.number >= end) continue;
            Image picture = shape_picture(shape.picture, request.view, options);
            tiles.push_back({shape.number, shape.caption, std::move(picture.bytes)});
        }
    });
    return gathered_tiles(comm, tiles, size);
}

std::string page_file(const std::string& kind, int page) {
    return std::string(result_files::sheet_pages.folder) + "/" + kind + "_" + std::to_string(page + 1) +
           result_files::sheet_pages.suffix;
}

SheetHeading page_heading(const SheetRequest& request, int page, int pages) {
    SheetHeading heading = request.heading;
    heading.subtitle += ", page " + std::to_string(page + 1) + " of " + std::to_string(pages);
    return heading;
}

}  // namespace

View agree_on_view(const Comm& comm, const std::vector<DrawnShape>& shapes_local, const ViewChoice& choice) {
    std::vector<const DrawnShape*> looked;
    const std::int64_t count = all_sum(comm, static_cast<std::int64_t>(shapes_local.size()));
    const auto stride = static_cast<int>((count + looked_at - 1) / looked_at);
    for (const DrawnShape& shape : shapes_local) {
        if (shape.number % stride == 0 && shape.picture.mesh.face_count() > 0) looked.push_back(&shape);
    }
    const UpAxis up = chosen_up(comm, looked, choice.up);
    if (choice.view == widest_view) return agreed_widest(comm, looked, up);
    const std::optional<View> view = named_view(choice.view, up);
    if (view) return *view;
    throw AgreedError(ExitCode::usage,
                      "--view: '" + choice.view +
                          "' is not a view; take auto, front, back, left, right, top, bottom, "
                          "corner, or AZIMUTH,ELEVATION in degrees");
}

std::string sheet_file(const std::string& kind) {
    const std::string mark = kind == name_of(SheetColoring::parts) ? "" : "_" + kind;
    return result_files::sheet + mark + result_files::picture_suffix;
}

std::vector<std::string> write_sheets(const Comm& comm, const std::string& folder,
                                      const SheetRequest& request,
                                      const std::vector<DrawnShape>& shapes_local, int shape_count) {
    const int pages = (shape_count + shapes_a_page - 1) / shapes_a_page;
    const int size = tile_size(shape_count);
    const int index_step = (shape_count + shapes_an_index - 1) / shapes_an_index;
    std::vector<std::string> written;
    std::vector<SheetTile> thumbnails;
    const auto put = [&](const std::string& file, const std::vector<SheetTile>& tiles,
                         const SheetHeading& heading, int columns) {
        write_png(folder + "/" + file, contact_sheet(tiles, heading, columns));
        written.push_back(file);
    };
    for (int page = 0; page < pages; ++page) {
        const int begin = page * shapes_a_page;
        const int end = std::min(shape_count, begin + shapes_a_page);
        const std::vector<SheetTile> tiles = drawn_page(comm, request, shapes_local, begin, end, size);
        agree(comm, [&] {
            if (!comm.is_root()) return;
            if (pages == 1) {
                put(sheet_file(request.kind), tiles, request.heading, sheet_columns(end - begin));
                return;
            }
            std::filesystem::create_directories(folder + "/" + result_files::sheet_pages.folder);
            put(page_file(request.kind, page), tiles, page_heading(request, page, pages), 10);
            for (std::size_t k = 0; k < tiles.size(); ++k) {
                if ((begin + static_cast<int>(k)) % index_step != 0) continue;
                thumbnails.push_back({shrunk(tiles[k].picture, thumbnail, thumbnail), tiles[k].caption});
            }
        });
    }
    if (pages > 1) {
        agree(comm, [&] {
            if (!comm.is_root()) return;
            SheetHeading heading = request.heading;
            heading.subtitle +=
                ", " + std::to_string(pages) + " pages in " + result_files::sheet_pages.folder + "/";
            if (index_step > 1) heading.subtitle += ", here 1 in " + std::to_string(index_step);
            put(sheet_file(request.kind), thumbnails, heading,
                sheet_columns(static_cast<int>(thumbnails.size())));
        });
    }
    return written;
}

}  // namespace coseg
