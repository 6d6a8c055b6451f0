#include "io/mesh_files/vtk_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/files/text_cursor.hpp"
#include "io/files/xml_cursor.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "io/mesh_files/unusable_vertices.hpp"
#include "io/mesh_files/vtk_array.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

/// A part of the file with points of its own.
struct VtkPiece {
    std::int64_t points = 0;
    std::int64_t passed_over = 0;  ///< points and lines
    std::int64_t polygons = 0;
    std::int64_t strips = 0;
    std::map<std::string, VtkArray> arrays;  ///< "Points", "Polys/offsets"
};

struct VtkDocument {
    VtkEncoding encoding;
    std::vector<VtkPiece> pieces;
};

/// Takes the XML apart; arrays are not decoded yet.
class VtkDocumentReader {
  public:
    VtkDocumentReader(std::string_view bytes, const std::string& path) : cursor_(bytes, path) {}

    VtkDocument run() {
        while (const std::optional<XmlTag> tag = cursor_.next_tag()) {
            if (tags_in_array_ == 0) add_text(cursor_.text_before_tag());
            if (tag->begins) begin(*tag);
            if (tag->ends && end(*tag)) return std::move(document_);
            if (tag->begins && tag->name == "AppendedData") {
                add_appended(*tag);
                return std::move(document_);
            }
        }
        cursor_.fail("the file has no tag 'VTKFile'; export the mesh as VTP");
    }

  private:
    void begin(const XmlTag& tag) {
        if (tag.name == "VTKFile") begin_file(tag);
        if (tag.name == "Piece") begin_piece(tag);
        if (tag.name == "Points" || tag.name == "Polys" || tag.name == "Strips") section_ = tag.name;
        if (tags_in_array_ >= 0) ++tags_in_array_;
        if (tag.name == "DataArray" && !section_.empty()) begin_array(tag);
    }

    /// Whether the file ends there.
    bool end(const XmlTag& tag) {
        if (tag.name == section_) section_ = {};
        if (tags_in_array_ >= 0) --tags_in_array_;
        return tag.name == "VTKFile";
    }

    void begin_file(const XmlTag& tag) {
        saw_root_ = true;
        const std::string_view type = tag.attribute("type");
        if (type != "PolyData")
            cursor_.fail("the file holds " + in_quotes(type) +
                         ", of which only PolyData is read; extract the surface and save it as VTP");
        const std::string_view lengths = tag.attribute("header_type", "UInt32");
        const std::string_view order = tag.attribute("byte_order", "LittleEndian");
        if (lengths != "UInt32" && lengths != "UInt64") refuse("header_type", lengths);
        if (order != "LittleEndian" && order != "BigEndian") refuse("byte_order", order);
        document_.encoding.has_long_headers = lengths == "UInt64";
        document_.encoding.is_big_endian = order == "BigEndian";
        document_.encoding.compressor = tag.attribute("compressor");
    }

    [[noreturn]] void refuse(const std::string& what, std::string_view value) const {
        cursor_.fail("the " + what + " is " + in_quotes(value) + "; export the mesh again");
    }

    [[nodiscard]] std::int64_t count_of(const XmlTag& tag, const std::string& what) const {
        std::int64_t count = 0;
        const std::string_view text = tag.attribute(what, "0");
        if (!parse_integer(text, count) || count < 0 || count > most_vertices) refuse(what, text);
        return count;
    }

    void begin_piece(const XmlTag& tag) {
        if (!saw_root_) cursor_.fail("the file has no tag 'VTKFile'; export the mesh as VTP");
        document_.pieces.push_back({count_of(tag, "NumberOfPoints"),
                                    count_of(tag, "NumberOfVerts") + count_of(tag, "NumberOfLines"),
                                    count_of(tag, "NumberOfPolys"),
                                    count_of(tag, "NumberOfStrips"),
                                    {}});
    }

    void begin_array(const XmlTag& tag) {
        if (document_.pieces.empty()) cursor_.fail("an array stands in no 'Piece'; export the mesh again");
        const std::string_view name = tag.attribute("Name");
        const bool is_points = section_ == "Points";
        VtkArray array{is_points ? "of Points" : in_quotes(name) + " of " + section_,
                       std::string(tag.attribute("type")),
                       std::string(tag.attribute("format", "ascii")),
                       {},
                       std::string(tag.attribute("offset"))};
        const std::string key = is_points ? "Points" : section_ + "/" + std::string(name);
        array_ = &document_.pieces.back().arrays[key];
        *array_ = std::move(array);
        tags_in_array_ = 0;
    }

    /// Beside its numbers an array may hold tags, which have text of their own.
    void add_text(std::string_view text) {
        if (array_->text.find_first_not_of(" \t\r\n") == std::string_view::npos) array_->text = text;
    }

    void add_appended(const XmlTag& tag) {
        const std::string_view encoding = tag.attribute("encoding", "base64");
        if (encoding != "raw" && encoding != "base64") refuse("encoding of the appended data", encoding);
        const std::string_view rest = cursor_.rest();
        const std::size_t mark = rest.find_first_not_of(" \t\r\n");
        if (mark == std::string_view::npos || rest[mark] != '_')
            cursor_.fail("the appended data do not begin with '_'; export the mesh again");
        document_.encoding.has_base64_appended = encoding == "base64";
        document_.encoding.appended = rest.substr(mark + 1);
    }

    XmlCursor cursor_;
    VtkDocument document_;
    std::string section_;
    VtkArray* array_ = nullptr;
    int tags_in_array_ = -1;  ///< that are open; -1 outside of arrays
    bool saw_root_ = false;
};

/// The polygons of all pieces.
class VtkCollector {
  public:
    VtkCollector(const VtkEncoding& encoding, const std::string& path) : encoding_(encoding), path_(path) {
        mesh_.offsets.push_back(0);
    }

    void add(const VtkPiece& piece) {
        const std::int64_t first = mesh_.vertex_count();
        if (piece.polygons + piece.strips > 0 || piece.points > 0) add_points(piece);
        if (piece.polygons > 0) add_cells(piece, "Polys", piece.polygons, first);
        if (piece.strips > 0) add_cells(piece, "Strips", piece.strips, first);
        passed_over_ += piece.passed_over;
    }

    ParsedMesh finish() {
        ParsedMesh parsed = unusable_.left_out_of({std::move(mesh_), {}}, path_);
        if (passed_over_ > 0)
            parsed.warnings.push_back(path_ + ": " +
                                      with_unit(passed_over_, "point or line is", "points or lines are") +
                                      " passed over");
        const std::optional<std::string> lost =
            has_single_precision_ ? lost_digits(parsed.mesh) : std::nullopt;
        if (lost) parsed.warnings.push_back(path_ + ": " + *lost);
        return parsed;
    }

  private:
    [[noreturn]] void fail(const std::string& sentence) const {
        throw Error(ExitCode::input, path_ + ": " + sentence);
    }

    [[nodiscard]] const VtkArray& array_of(const VtkPiece& piece, const std::string& key) const {
        const auto found = piece.arrays.find(key);
        if (found != piece.arrays.end()) return found->second;
        fail("the file has no array '" + key + "'; export the mesh again");
    }

    void add_points(const VtkPiece& piece) {
        const VtkArray& array = array_of(piece, "Points");
        const std::vector<double> values = vtk_reals(array, encoding_, path_);
        if (values.size() != 3 * at(piece.points))
            fail("the file promises " + with_unit(piece.points, "point", "points") + ", but there are " +
                 std::to_string(values.size()) + " coordinates; export the mesh again");
        if (mesh_.vertex_count() + piece.points > most_vertices) fail(too_many_vertices);
        has_single_precision_ |= array.type == "Float32" && array.format != "ascii";
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (k % 3 == 0) mesh_.vertices.emplace_back();
            mesh_.vertices.back()[static_cast<Eigen::Index>(k % 3)] = values[k];
            if (!is_usable_coordinate(values[k])) unusable_.add(mesh_.vertex_count() - 1, values[k], 0);
        }
    }

    /// Cell k of a section has the corners from the end of the one before it to offsets[k].
    void add_cells(const VtkPiece& piece, const std::string& section, std::int64_t count,
                   std::int64_t first_vertex) {
        const std::vector<std::int64_t> ends =
            vtk_integers(array_of(piece, section + "/offsets"), encoding_, path_);
        const std::vector<std::int64_t> corners =
            vtk_integers(array_of(piece, section + "/connectivity"), encoding_, path_);
        if (std::ssize(ends) != count)
            fail("the file promises " + std::to_string(count) + " " + section + ", but there are " +
                 std::to_string(ends.size()) + "; export the mesh again");
        if (ends.front() < 0 || !std::is_sorted(ends.begin(), ends.end()) ||
            ends.back() != std::ssize(corners))
            fail("the offsets of " + section + " do not ascend to the number of corners, which is " +
                 std::to_string(corners.size()) + "; export the mesh again");
        std::int64_t begin = 0;
        for (const std::int64_t end : ends) {
            cell_.clear();
            for (; begin < end; ++begin) cell_.push_back(vertex_of(corners[at(begin)], piece, first_vertex));
            if (section == "Polys")
                add_face(cell_);
            else
                add_strip();
        }
    }

    [[nodiscard]] int vertex_of(std::int64_t index, const VtkPiece& piece, std::int64_t first_vertex) const {
        if (index < 0 || index >= piece.points)
            fail(bad_index(std::ssize(mesh_.offsets) - 1, index, piece.points));
        return static_cast<int>(first_vertex + index);
    }

    void add_face(const std::vector<int>& corners) {
        if (mesh_.corners.size() + corners.size() > at(most_corners)) fail(too_many_corners);
        mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
        mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
    }

    /// Every corner makes a triangle with the two before it, every other one turned.
    void add_strip() {
        for (std::size_t k = 2; k < cell_.size(); ++k) {
            const int a = cell_[k % 2 == 0 ? k - 2 : k - 1];
            const int b = cell_[k % 2 == 0 ? k - 1 : k - 2];
            if (a != b && cell_[k] != a && cell_[k] != b) add_face({a, b, cell_[k]});
        }
    }

    const VtkEncoding& encoding_;
    const std::string& path_;
    PolygonMesh mesh_;
    UnusableVertices unusable_;
    std::vector<int> cell_;  ///< corners of the cell at work
    std::int64_t passed_over_ = 0;
    bool has_single_precision_ = false;
};

}  // namespace

ParsedMesh read_vtp(std::string_view bytes, const std::string& path) {
    const VtkDocument document = VtkDocumentReader(bytes, path).run();
    VtkCollector collector(document.encoding, path);
    for (const VtkPiece& piece : document.pieces) collector.add(piece);
    return collector.finish();
}

}  // namespace coseg
