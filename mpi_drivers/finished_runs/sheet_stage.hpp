#pragma once
// Makes contact sheets: every rank draws its own shapes, and rank 0 lays them out and writes PNG files.

#include <string>
#include <vector>

#include "src/base/enum_names.hpp"
#include "src/parallel/comm.hpp"
#include "src/pictures/contact_sheet.hpp"
#include "src/pictures/picture_mesh.hpp"
#include "src/pictures/shape_view.hpp"

namespace coseg {

/// Up to this number of shapes a collection fits on one page. Beyond it, contact_sheet.png is an index of
/// thumbnails.
inline constexpr int shapes_a_page = 60;
/// The index shows at most this number of shapes: of a larger collection every second, third ... shape.
inline constexpr int shapes_an_index = 1500;

/// What faces are coloured by, beside the descriptors.
enum class SheetColoring { parts, patches, truth, errors };
constexpr std::array<EnumName<SheetColoring>, 4> enum_names(SheetColoring /*type*/) {
    return {{{SheetColoring::parts, "parts"},
             {SheetColoring::patches, "patches"},
             {SheetColoring::truth, "truth"},
             {SheetColoring::errors, "errors"}}};
}

struct DrawnShape {
    int number = 0;  ///< in the collection
    std::string caption;
    PictureMesh picture;
};

/// Finds one view for the whole collection. With auto, the up axis is the one on which the shapes stand best
/// (y where it is as good as another), and of the candidates the view is taken that shows the largest
/// outlines, where each shape has the same weight. shapes_local are those of this rank. Collective; the
/// result is the same on any number of ranks. Throws AgreedError(usage) for an unknown name.
View agree_on_view(const Comm& comm, const std::vector<DrawnShape>& shapes_local, const ViewChoice& choice);

struct SheetRequest {
    std::string kind;  ///< name of a colouring or a descriptor: part of the files' names, but for parts
    SheetHeading heading;
    View view;
};

/// The file of `kind` in a folder of results: contact_sheet.png for parts, else contact_sheet_KIND.png.
std::string sheet_file(const std::string& kind);

/// Writes FOLDER/contact_sheet[_KIND].png. It shows all shapes if there are at most shapes_a_page; else it is
/// an index of thumbnails beside FOLDER/sheets/KIND_1.png, ... Returns the files' names on rank 0.
/// shapes_local are those of this rank, ascending by number; shape_count is that of all ranks. The files have
/// the same bytes on any number of ranks. Collective; throws AgreedError.
std::vector<std::string> write_sheets(const Comm& comm, const std::string& folder,
                                      const SheetRequest& request,
                                      const std::vector<DrawnShape>& shapes_local, int shape_count);

}  // namespace coseg
