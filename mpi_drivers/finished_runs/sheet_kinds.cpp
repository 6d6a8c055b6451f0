#include "mpi_drivers/finished_runs/sheet_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "src/base/index.hpp"
#include "src/base/text.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/pictures/color_scale.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

constexpr Color wrong = {0xD8, 0x2C, 0x2C};
constexpr Color right = {0xC4, 0xCB, 0xD2};
constexpr Color without_truth = {0xF2, 0xE3, 0xB3};

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

DrawnShape drawn(const LabelledMesh& shape, const std::vector<Color>& colors,
                 const std::string& remark = "") {
    return {shape.number, shape.name + (remark.empty() ? "" : "  " + remark),
            standing_picture(shape, colors)};
}

/// Per label of the truth the part that stands for it; labels without one get numbers behind the parts.
std::vector<int> part_of_label(const std::vector<int>& label_of_part, int labels) {
    std::vector<int> parts(static_cast<std::size_t>(labels), -1);
    for (std::size_t p = 0; p < label_of_part.size(); ++p) {
        if (label_of_part[p] >= 0 && label_of_part[p] < labels)
            parts[at(label_of_part[p])] = static_cast<int>(p);
    }
    int next = static_cast<int>(label_of_part.size());
    for (int& part : parts) part = part < 0 ? next++ : part;
    return parts;
}

std::vector<Color> truth_colors(const LabelledMesh& shape, const std::vector<int>& label_of_part) {
    const int largest = shape.truth.empty() ? 0 : *std::max_element(shape.truth.begin(), shape.truth.end());
    const std::vector<int> parts = part_of_label(label_of_part, std::max(largest, 0) + 1);
    std::vector<Color> colors(static_cast<std::size_t>(shape.mesh.face_count()), without_truth);
    for (std::size_t f = 0; f < shape.truth.size(); ++f) {
        if (shape.truth[f] >= 0) colors[f] = part_color(parts[at(shape.truth[f])]);
    }
    return colors;
}

/// Labels that occur on any rank, ascending. Collective.
std::vector<int> labels_in_truth(const Comm& comm, const std::vector<LabelledMesh>& shapes) {
    std::set<int> local;
    for (const LabelledMesh& shape : shapes) local.insert(shape.truth.begin(), shape.truth.end());
    const std::vector<int> sent(local.lower_bound(0), local.end());
    const std::vector<int> all = all_gather(comm, std::span<const int>(sent));
    const std::set<int> distinct(all.begin(), all.end());
    return {distinct.begin(), distinct.end()};
}

/// "seat (label 1)", or "label 1" where it has no name.
std::string label_text(const LabelNames& names, int label) {
    const std::string number = "label " + std::to_string(label);
    const auto name = names.find(label);
    return name == names.end() ? number : name->second + " (" + number + ")";
}

/// A swatch for each part, then one for each label that no part stands for.
std::vector<LegendEntry> truth_legend(const PartKey& key, const std::vector<int>& labels) {
    std::vector<LegendEntry> legend;
    for (std::size_t p = 0; p < key.label_of_part.size(); ++p) {
        const int label = key.label_of_part[p];
        legend.push_back(
            {part_color(static_cast<int>(p)),
             (label < 0 ? "no label" : label_text(key.names, label)) + " as part " + std::to_string(p)});
    }
    const std::vector<int> parts = part_of_label(key.label_of_part, labels.empty() ? 0 : labels.back() + 1);
    const int count = static_cast<int>(key.label_of_part.size());
    for (const int label : labels) {
        const int part = parts[at(label)];
        if (part >= count) legend.push_back({part_color(part), label_text(key.names, label) + ", no part"});
    }
    return legend;
}

/// "part 0  42.0 %" becomes "part 0  seat  42.0 %".
void name_parts(std::vector<LegendEntry>& legend, const std::vector<double>& part_area, const PartKey& key) {
    for (std::size_t p = 0; p < legend.size(); ++p) {
        const int label = key.label_of_part.empty() ? static_cast<int>(p) : key.label_of_part[p];
        const auto name = key.names.find(label);
        const std::string middle = name == key.names.end() ? "" : name->second + "  ";
        legend[p].text = "part " + std::to_string(p) + "  " + middle + percent(part_area[p], 1);
    }
}

DrawnShape drawn_errors(const LabelledMesh& shape, const std::vector<int>& label_of_part) {
    std::vector<Color> colors(static_cast<std::size_t>(shape.mesh.face_count()), without_truth);
    if (shape.truth.empty()) return drawn(shape, colors);
    const std::vector<bool> is_wrong = wrong_faces(shape, label_of_part);
    for (std::size_t f = 0; f < colors.size(); ++f) {
        if (shape.truth[f] >= 0) colors[f] = is_wrong[f] ? wrong : right;
    }
    const std::optional<double> share = right_share(shape, is_wrong);
    return drawn(shape, colors, share ? percent(*share, 1) : "");
}

/// The value below which `share` of the values lie.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// Of one shape, or of all.
struct ValueRange {
    int shape = 0;
    double low = 0.0;
    double high = 0.0;
    static constexpr auto fields() {
        return std::tuple(field("shape", &ValueRange::shape), field("low", &ValueRange::low),
                          field("high", &ValueRange::high));
    }
};

/// The mean over shapes of each shape's 2nd and 98th percentile, summed in the order of the shapes.
ValueRange agreed_range(const Comm& comm, const std::vector<LabelledMesh>& shapes,
                        const std::vector<std::vector<double>>& values, std::size_t total) {
    std::vector<ValueRange> ranges;
    for (std::size_t k = 0; k < shapes.size(); ++k)
        ranges.push_back({shapes[k].number, quantile(values[k], 0.02), quantile(values[k], 0.98)});
    ranges = all_gather_records(comm, ranges);
    std::sort(ranges.begin(), ranges.end(),
              [](const ValueRange& a, const ValueRange& b) { return a.shape < b.shape; });
    ValueRange mean;
    for (const ValueRange& range : ranges) {
        mean.low += range.low / static_cast<double>(total);
        mean.high += range.high / static_cast<double>(total);
    }
    return mean;
}

std::string as_words(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

DrawnKind drawn_descriptor(const Comm& comm, const FinishedRun& run, const std::vector<LabelledMesh>& shapes,
                           int row) {
    std::vector<std::vector<double>> values;
    agree(comm, [&] {
        for (const LabelledMesh& shape : shapes)
            values.push_back(shown_descriptors(run, shape, {row}).front());
    });
    const ValueRange range = agreed_range(comm, shapes, values, run.shapes.size());
    DrawnKind kind;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        std::vector<Color> colors;
        for (const double value : values[k]) colors.push_back(scale_color(value, range.low, range.high));
        kind.shapes.push_back(drawn(shapes[k], colors));
    }
    kind.heading = {.title = as_words(descriptor_table()[at(row)].name),
                    .subtitle = counted(run.shapes.size(), "shape", "shapes"),
                    .legend = {},
                    .scale = ColorScaleBar{significant(range.low), significant(range.high)}};
    return kind;
}

}  // namespace

std::vector<std::string> sheet_kinds() {
    std::vector<std::string> kinds = names_of<SheetColoring>();
    const std::vector<std::string> descriptors = descriptor_names();
    kinds.insert(kinds.end(), descriptors.begin(), descriptors.end());
    return kinds;
}

SheetHeading parts_heading(const std::vector<double>& part_area, int shapes) {
    SheetHeading heading;
    heading.title = counted(part_area.size(), "part", "parts");
    heading.subtitle = counted(static_cast<std::size_t>(shapes), "shape", "shapes");
    for (std::size_t p = 0; p < part_area.size(); ++p) {
        heading.legend.push_back(
            {part_color(static_cast<int>(p)), "part " + std::to_string(p) + "  " + percent(part_area[p], 1)});
    }
    return heading;
}

std::vector<Color> colors_of(const std::vector<int>& labels) {
    std::vector<Color> colors;
    colors.reserve(labels.size());
    for (const int label : labels) colors.push_back(part_color(label));
    return colors;
}

namespace {

/// Collective for the truth, whose labels the legend lists.
SheetHeading coloring_heading(const Comm& comm, const FinishedRun& run,
                              const std::vector<LabelledMesh>& shapes, SheetColoring coloring,
                              const PartKey& key) {
    SheetHeading heading = parts_heading(run.part_area, static_cast<int>(run.shapes.size()));
    if (coloring == SheetColoring::parts) {
        name_parts(heading.legend, run.part_area, key);
        return heading;
    }
    heading.title = to_string(coloring);
    heading.legend.clear();
    if (coloring == SheetColoring::truth) heading.legend = truth_legend(key, labels_in_truth(comm, shapes));
    if (coloring == SheetColoring::errors)
        heading.legend = {{right, "right"}, {wrong, "wrong"}, {without_truth, "no truth"}};
    return heading;
}

DrawnShape drawn_coloring(const LabelledMesh& shape, SheetColoring coloring,
                          const std::vector<int>& label_of_part) {
    switch (coloring) {
        case SheetColoring::parts:
            break;
        case SheetColoring::patches:
            return drawn(shape, colors_of(shape.patch));
        case SheetColoring::truth:
            return drawn(shape, truth_colors(shape, label_of_part));
        case SheetColoring::errors:
            return drawn_errors(shape, label_of_part);
    }
    return drawn(shape, colors_of(shape.part));
}

}  // namespace

DrawnKind drawn_kind(const Comm& comm, const FinishedRun& run, const std::vector<LabelledMesh>& shapes,
                     const std::string& kind, const PartKey& key) {
    const std::optional<SheetColoring> coloring = named<SheetColoring>(kind);
    if (!coloring) {
        const std::vector<std::string> descriptors = descriptor_names();
        const auto row = std::find(descriptors.begin(), descriptors.end(), kind);
        return drawn_descriptor(comm, run, shapes, static_cast<int>(row - descriptors.begin()));
    }
    DrawnKind result;
    result.heading = coloring_heading(comm, run, shapes, *coloring, key);
    agree(comm, [&] {
        for (const LabelledMesh& shape : shapes)
            result.shapes.push_back(drawn_coloring(shape, *coloring, key.label_of_part));
    });
    return result;
}

}  // namespace coseg
