#pragma once
// Pictures of shapes laid out in a grid, with a heading, a legend and names.

#include <optional>
#include <string>
#include <vector>

#include "src/pictures/image.hpp"

namespace coseg {

struct SheetTile {
    Image picture;        ///< all tiles of one size
    std::string caption;  ///< below it
};

struct LegendEntry {
    Color color{};
    std::string text;
};

struct ColorScaleBar {
    std::string low;  ///< what its ends stand for
    std::string high;
};

struct SheetHeading {
    std::string title;
    std::string subtitle;
    std::vector<LegendEntry> legend;     ///< wrapped over several lines where it is long
    std::optional<ColorScaleBar> scale;  ///< of src/pictures/color_scale.hpp
};

/// Columns of a grid of `count` tiles on a page somewhat wider than high.
int sheet_columns(int count);

/// The page. tiles: at least one.
Image contact_sheet(const std::vector<SheetTile>& tiles, const SheetHeading& heading, int columns);

}  // namespace coseg
