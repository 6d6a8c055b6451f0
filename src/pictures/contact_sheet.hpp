#pragma once
// Lays out pictures of shapes in a grid, with a heading, a legend and names.

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
    std::string low;  ///< the values that its ends stand for
    std::string high;
};

struct SheetHeading {
    std::string title;
    std::string subtitle;
    std::vector<LegendEntry> legend;     ///< wrapped over several lines where it is long
    std::optional<ColorScaleBar> scale;  ///< of src/pictures/color_scale.hpp
};

/// The number of columns with which `count` tiles fill a page somewhat wider than high.
int sheet_columns(int count);

/// The page of all tiles, of which there must be at least one.
Image contact_sheet(const std::vector<SheetTile>& tiles, const SheetHeading& heading, int columns);

}  // namespace coseg
