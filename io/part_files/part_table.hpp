#pragma once
// Writes the measures of all parts of all shapes as tables.

#include <string>
#include <tuple>
#include <vector>

#include "src/measures/part_measures.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// One part of one shape.
struct MeasuredPart {
    PartMeasures measures;
    std::vector<double> descriptors;  ///< means over the faces of the part, weighted by area
    static constexpr auto fields() {
        return std::tuple(inlined(&MeasuredPart::measures), field("descriptors", &MeasuredPart::descriptors));
    }
};

struct MeasuredShape {
    int number = 0;  ///< in the run
    std::string name;
    std::vector<MeasuredPart> parts;
    static constexpr auto fields() {
        return std::tuple(field("number", &MeasuredShape::number), field("name", &MeasuredShape::name),
                          field("parts", &MeasuredShape::parts));
    }
};

/// What the columns are called.
struct PartTableHeading {
    std::vector<std::string> parts;        ///< names of all parts of the run
    std::vector<std::string> descriptors;  ///< names; none if there are no means
};

/// Writes FOLDER/parts.csv, a row for each part of each shape, and FOLDER/parts.json with the same values
/// (docs/formats.md). Error(output) as atomic_file.hpp.
void write_part_tables(const std::string& folder, const PartTableHeading& heading,
                       const std::vector<MeasuredShape>& shapes);

}  // namespace coseg
