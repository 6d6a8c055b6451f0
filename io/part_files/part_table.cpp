#include "io/part_files/part_table.hpp"

#include <charconv>

#include "io/files/atomic_file.hpp"
#include "io/reports/record_json.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// One row of a table of values with commas between them. Source: RFC 4180.
class CsvRow {
  public:
    void add(std::string_view value) {
        begin_value();
        if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
            text_ += value;
            return;
        }
        text_ += '"';
        for (const char c : value) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
        text_ += '"';
    }
    void add(double value) {
        char digits[32];
        begin_value();
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    }
    void add(const Eigen::Vector3d& values) {
        for (const double value : values) add(value);
    }
    void add_nothing() { begin_value(); }
    [[nodiscard]] std::string line() const { return text_ + "\n"; }

  private:
    void begin_value() {
        if (!is_first_) text_ += ',';
        is_first_ = false;
    }
    std::string text_;
    bool is_first_ = true;
};

std::string csv_heading(const PartTableHeading& heading) {
    CsvRow row;
    for (const char* name : {"shape", "part", "name", "area", "share", "pieces", "volume", "centroid_x",
                             "centroid_y", "centroid_z", "box_center_x", "box_center_y", "box_center_z",
                             "box_size_1", "box_size_2", "box_size_3"})
        row.add(name);
    for (const char* axis : {"1", "2", "3"}) {
        for (const char* component : {"x", "y", "z"})
            row.add(std::string("box_axis_") + axis + "_" + component);
    }
    for (std::size_t part = 0; part < heading.parts.size(); ++part) row.add("border_" + std::to_string(part));
    for (const std::string& descriptor : heading.descriptors) row.add(descriptor);
    return row.line();
}

std::string csv_line(const PartTableHeading& heading, const MeasuredShape& shape, const MeasuredPart& part) {
    const PartMeasures& measures = part.measures;
    CsvRow row;
    row.add(shape.name);
    row.add(std::to_string(measures.part));
    row.add(heading.parts[at(measures.part)]);
    row.add(measures.area);
    row.add(measures.share);
    row.add(std::to_string(measures.pieces));
    if (measures.volume)
        row.add(*measures.volume);
    else
        row.add_nothing();
    row.add(measures.centroid);
    row.add(measures.box.center);
    row.add(measures.box.sizes);
    for (int k = 0; k < 3; ++k) row.add(Eigen::Vector3d(measures.box.axes.col(k)));
    std::vector<double> borders(heading.parts.size(), 0.0);
    for (const auto& [other, length] : measures.borders) borders[at(other)] = length;
    for (const double length : borders) row.add(length);
    for (const double mean : part.descriptors) row.add(mean);
    return row.line();
}

void set_text(JsonPlace object, const std::string& key, const std::string& text) {
    object.member(key).set(text);
    if (const std::optional<std::string> bytes = hex_unless_utf8(text))
        object.member(key + "_bytes").set(*bytes);
}

void set_part(JsonPlace place, const PartTableHeading& heading, const MeasuredPart& part) {
    const PartMeasures& measures = part.measures;
    place.set_object();
    set_json(place.member("part"), measures.part);
    set_text(place, "name", heading.parts[at(measures.part)]);
    set_json(place.member("area"), measures.area);
    set_json(place.member("share"), measures.share);
    set_json(place.member("pieces"), measures.pieces);
    set_json(place.member("volume"), measures.volume);
    set_json(place.member("centroid"), measures.centroid);
    set_json(place.member("box"), measures.box);
    place.member("borders").set_array();
    for (const auto& [other, length] : measures.borders) {
        const JsonPlace border = place.member("borders").element();
        border.set_object();
        set_json(border.member("with"), other);
        set_json(border.member("length"), length);
    }
    place.member("descriptors").set_object();
    for (std::size_t k = 0; k < part.descriptors.size(); ++k)
        set_json(place.member("descriptors").member(heading.descriptors[k]), part.descriptors[k]);
}

}  // namespace

void write_part_tables(const std::string& folder, const PartTableHeading& heading,
                       const std::vector<MeasuredShape>& shapes) {
    std::string csv = csv_heading(heading);
    JsonTree tree;
    tree.root().set_object();
    tree.root().member("format").set("coseg parts 1");
    tree.root().member("shapes").set_array();
    for (const MeasuredShape& shape : shapes) {
        const JsonPlace entry = tree.root().member("shapes").element();
        entry.set_object();
        set_text(entry, "name", shape.name);
        entry.member("parts").set_array();
        for (const MeasuredPart& part : shape.parts) {
            csv += csv_line(heading, shape, part);
            set_part(entry.member("parts").element(), heading, part);
        }
    }
    write_file(folder + "/parts.csv", csv);
    write_file(folder + "/parts.json", tree.pretty());
}

}  // namespace coseg
