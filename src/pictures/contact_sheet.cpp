#include "src/pictures/contact_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/index.hpp"
#include "src/pictures/color_scale.hpp"
#include "src/pictures/lettering.hpp"
#include "src/pictures/shape_picture.hpp"

namespace coseg {

namespace {

constexpr Color ink = {0x25, 0x27, 0x2B};
constexpr Color faint_ink = {0x6A, 0x6E, 0x75};
constexpr int border = 28;
constexpr int gutter = 12;
constexpr int title_height = 18;
constexpr int text_height = 11;
constexpr int legend_line = 26;
constexpr int swatch = 15;
constexpr int bar_width = 220;

int as_int(double value) { return static_cast<int>(std::lround(value)); }

/// Small tiles have small captions.
int caption_height(int tile) { return tile >= 200 ? text_height : 8; }

struct PlacedEntry {
    const LegendEntry* entry;
    int x;
    int y;  // of the line's middle
};

int entry_width(const LegendEntry& entry) {
    return swatch + 8 + as_int(text_width(entry.text, text_height)) + 22;
}

std::vector<PlacedEntry> placed_legend(const std::vector<LegendEntry>& legend, int width, int top) {
    std::vector<PlacedEntry> placed;
    int x = border;
    int y = top + legend_line / 2;
    for (const LegendEntry& entry : legend) {
        if (x > border && x + entry_width(entry) > width - border) {
            x = border;
            y += legend_line;
        }
        placed.push_back({&entry, x, y});
        x += entry_width(entry);
    }
    return placed;
}

void draw_legend(Image& page, const std::vector<PlacedEntry>& placed) {
    for (const PlacedEntry& p : placed) {
        fill_rectangle(page, p.x, p.y - swatch / 2, swatch, swatch, p.entry->color);
        draw_text(page, p.x + swatch + 8, p.y + 0.5 * text_height, p.entry->text, text_height, ink);
    }
}

void draw_scale(Image& page, const ColorScaleBar& scale, int top) {
    const int middle = top + legend_line / 2;
    draw_text(page, border, middle + 0.5 * text_height, scale.low, text_height, ink);
    const int left = border + as_int(text_width(scale.low, text_height)) + 12;
    for (int x = 0; x < bar_width; ++x)
        fill_rectangle(page, left + x, middle - swatch / 2, 1, swatch, scale_color(x, 0.0, bar_width - 1.0));
    draw_text(page, left + bar_width + 12, middle + 0.5 * text_height, scale.high, text_height, ink);
}

void draw_caption(Image& page, const std::string& caption, int left, int top, int tile) {
    const int height = caption_height(tile);
    const std::string text = shortened_text(caption, height, tile - 4);
    draw_text(page, left + 0.5 * (tile - text_width(text, height)), top + height, text, height, faint_ink);
}

}  // namespace

int sheet_columns(int count) {
    const int columns = as_int(std::ceil(std::sqrt(1.3 * count)));
    const int rows = (count + columns - 1) / columns;
    return (count + rows - 1) / rows;  // the fewest that need no more rows, so that the last is full
}

Image contact_sheet(const std::vector<SheetTile>& tiles, const SheetHeading& heading, int columns) {
    const int tile = tiles.front().picture.width;
    const int count = static_cast<int>(tiles.size());
    const int rows = (count + columns - 1) / columns;
    const int cell = tile + caption_height(tile) + 2 * gutter;
    const int grid_width = columns * tile + (columns - 1) * gutter;
    const int width = std::max(grid_width + 2 * border, 640);

    const int legend_top = border + title_height + 14;
    const std::vector<PlacedEntry> legend = placed_legend(heading.legend, width, legend_top);
    int top = legend_top;
    if (!legend.empty()) top = legend.back().y + legend_line / 2;
    const int scale_top = top;
    if (heading.scale) top += legend_line;
    top += gutter;

    Image page(width, top + rows * cell + border / 2, picture_background);
    draw_text(page, border, border + title_height, heading.title, title_height, ink);
    const double after_title = border + text_width(heading.title, title_height) + 20;
    draw_text(page, after_title, border + title_height, heading.subtitle, text_height, faint_ink);
    draw_legend(page, legend);
    if (heading.scale) draw_scale(page, *heading.scale, scale_top);
    for (int k = 0; k < count; ++k) {
        const int left = (width - grid_width) / 2 + (k % columns) * (tile + gutter);
        const int cell_top = top + (k / columns) * cell;
        const SheetTile& shape = tiles[at(k)];
        paste(page, shape.picture, left, cell_top);
        draw_caption(page, shape.caption, left, cell_top + tile + 4, tile);
    }
    return page;
}

}  // namespace coseg
