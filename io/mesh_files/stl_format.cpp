#include "io/mesh_files/stl_format.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/files/atomic_file.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/files/number_text.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/corner_welder.hpp"
#include "io/mesh_files/lost_digits.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/face_triangles.hpp"

namespace coseg {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

using Facet = std::array<Eigen::Vector3d, 3>;

/// Numbers the corners of facets. Facets with two equal corners wait until all others have their numbers.
class FacetCollector {
  public:
    /// Coordinates up to `negligible` count as 0.
    explicit FacetCollector(double negligible) : negligible_(negligible), welder_(negligible) {}

    /// False if there are more than a mesh may have.
    [[nodiscard]] bool add(const Facet& facet) {
        if (std::ssize(corners_) + 3 > most_corners) return false;
        const bool has_equal_corners = is_same_position(facet[0], facet[1], negligible_) ||
                                       is_same_position(facet[1], facet[2], negligible_) ||
                                       is_same_position(facet[2], facet[0], negligible_);
        if (has_equal_corners) waiting_.push_back({corners_.size(), facet});
        for (const Eigen::Vector3d& corner : facet)
            corners_.push_back(has_equal_corners ? -1 : welder_.number_of(corner));
        return true;
    }

    void expect(std::size_t facets) { corners_.reserve(3 * facets); }

    [[nodiscard]] std::int64_t facet_count() const { return std::ssize(corners_) / 3; }

    PolygonMesh finish() {
        for (const WaitingFacet& waiting : waiting_) {
            for (std::size_t k = 0; k < waiting.facet.size(); ++k)
                corners_[waiting.first_corner + k] = welder_.number_of(waiting.facet[k]);
        }
        PolygonMesh mesh;
        mesh.offsets.resize(corners_.size() / 3 + 1);
        for (std::size_t f = 0; f < mesh.offsets.size(); ++f) mesh.offsets[f] = static_cast<int>(3 * f);
        mesh.corners = std::move(corners_);
        mesh.vertices = welder_.take_vertices();
        return mesh;
    }

  private:
    struct WaitingFacet {
        std::size_t first_corner;
        Facet facet;
    };
    double negligible_;
    std::vector<int> corners_;
    std::vector<WaitingFacet> waiting_;
    CornerWelder welder_;
};

char lower_case_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view word, std::string_view lower_case) {
    return word.size() == lower_case.size() &&
           std::equal(word.begin(), word.end(), lower_case.begin(),
                      [](char a, char b) { return lower_case_letter(a) == b; });
}

bool begins_with(std::string_view word, std::string_view lower_case) {
    return same_word(word.substr(0, lower_case.size()), lower_case);
}

class StlTextReader {
  public:
    /// comment: as of TextCursor; the names of solids may have any sign, so that most files have none.
    StlTextReader(std::string_view bytes, const std::string& path, char comment, double negligible)
        : cursor_(bytes, path, comment), path_(path), facets_(negligible) {}

    PolygonMesh run() {
        bool is_inside = false;
        std::string_view word = cursor_.word_on_any_line();
        for (; !word.empty(); word = cursor_.word_on_any_line()) {
            if (begins_with(word, "solid")) {  // the one before it may lack its end
                pass_over_name();
                is_inside = true;
            } else if (is_inside && same_word(word, "color")) {
                cursor_.skip_line();
            } else if (is_inside && same_word(word, "facet")) {
                read_facet();
            } else if (is_inside && is_end_of(word, "solid")) {
                cursor_.skip_line();
                is_inside = false;
            } else {
                break;
            }
        }
        if (is_inside && !word.empty())
            cursor_.fail("an STL file has 'facet' or 'endsolid' here, not " + in_quotes(word));
        if (is_inside) warn("the file ends without 'endsolid'; it may be cut short");
        if (!word.empty())
            warn("the file goes on after 'endsolid'; what follows, from " + in_quotes(word) +
                 " on, is left out");
        return facets_.finish();
    }

    std::vector<std::string> take_warnings() { return std::move(warnings_); }

  private:
    /// Of the facet at hand.
    [[nodiscard]] std::string number() const { return std::to_string(facets_.facet_count()); }

    void warn(const std::string& sentence) {
        warnings_.push_back(path_ + ":" + std::to_string(cursor_.line()) + ": " + sentence);
    }

    /// The name of a solid ends with its line, unless the first facet stands on the same line.
    void pass_over_name() {
        TextCursor before = cursor_;
        for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word()) {
            if (same_word(word, "facet") && same_word(TextCursor(cursor_).word(), "normal")) {
                cursor_ = before;
                return;
            }
            before = cursor_;
        }
    }

    /// "endloop", "end loop", and for a solid also with its name glued to it.
    bool is_end_of(std::string_view word, std::string_view what) {
        if (same_word(word, "end")) {
            const std::string_view next = cursor_.word();
            return same_word(next, what) || (what == "solid" && next.empty());
        }
        if (!begins_with(word, "end")) return false;
        word.remove_prefix(3);
        return what == "solid" ? begins_with(word, what) : same_word(word, what);
    }

    [[noreturn]] void fail_for(std::string_view word, std::string_view expected) const {
        if (word.empty()) cursor_.fail("the file ends inside facet " + number() + "; export the mesh again");
        cursor_.fail("facet " + number() + " has " + in_quotes(word) + " where '" + std::string(expected) +
                     "' should stand");
    }

    void expect(std::string_view lower_case) {
        const std::string_view word = cursor_.word_on_any_line();
        if (!same_word(word, lower_case)) fail_for(word, lower_case);
    }

    void expect_end_of(std::string_view what) {
        const std::string_view word = cursor_.word_on_any_line();
        if (!is_end_of(word, what)) fail_for(word, "end" + std::string(what));
    }

    void expect_loop(std::string_view word) {
        if (same_word(word, "outerloop")) return;
        if (!same_word(word, "outer")) fail_for(word, "outer loop");
        expect("loop");
    }

    void read_facet() {
        std::string_view word = cursor_.word_on_any_line();
        if (same_word(word, "normal")) {
            for (int k = 0; k < 3; ++k) word = cursor_.word_on_any_line();
            word = cursor_.word_on_any_line();
        }
        expect_loop(word);
        Facet facet;
        for (Eigen::Vector3d& corner : facet) {
            expect("vertex");
            for (int k = 0; k < 3; ++k) corner[k] = coordinate();
        }
        expect_end_of("loop");
        expect_end_of("facet");
        if (!facets_.add(facet)) cursor_.fail(too_many_corners);
    }

    double coordinate() {
        const std::string_view word = cursor_.word_on_any_line();
        double value = 0.0;
        if (word.empty()) fail_for(word, {});
        if (!parse_real(word, value))
            cursor_.fail("facet " + number() + " has a coordinate that is " + no_number(word));
        if (!is_usable_coordinate(value)) {
            cursor_.fail("facet " + number() +
                         " has a coordinate that is not finite or beyond 1e37; correct it");
        }
        return value;
    }

    TextCursor cursor_;
    const std::string& path_;
    FacetCollector facets_;
    std::vector<std::string> warnings_;
};

/// The caller has seen to it that the bytes of all facets are there.
PolygonMesh read_facets(std::string_view bytes, std::size_t facet_count, const std::string& path,
                        double negligible) {
    FacetCollector facets(negligible);
    facets.expect(facet_count);
    ByteCursor cursor(bytes, header_bytes, false);
    for (std::size_t f = 0; f < facet_count; ++f) {
        float value = 0.0F;
        for (int k = 0; k < 3; ++k) cursor.read(value);  // the normal
        Facet facet;
        for (Eigen::Vector3d& corner : facet) {
            for (int k = 0; k < 3; ++k) {
                cursor.read(value);
                corner[k] = value;
                if (is_usable_coordinate(value)) continue;
                throw Error(ExitCode::input,
                            path + ": facet " + std::to_string(f) +
                                " has a coordinate that is not finite or beyond 1e37; correct it");
            }
        }
        std::uint16_t attribute = 0;
        cursor.read(attribute);
        if (!facets.add(facet)) throw Error(ExitCode::input, path + ": " + too_many_corners);
    }
    return facets.finish();
}

std::size_t promised_facets(std::string_view bytes) {
    std::uint32_t facets = 0;
    ByteCursor(bytes, header_bytes - sizeof facets, false).read(facets);
    return facets;
}

/// What a program writes that cannot go back to the header when it knows the number, as into a pipe.
bool is_no_count(std::size_t promised) {
    return promised == 0 || promised == std::numeric_limits<std::uint32_t>::max();
}

ParsedMesh read_binary(std::string_view bytes, const std::string& path) {
    const std::size_t promised = promised_facets(bytes);
    const std::size_t behind_header = bytes.size() - header_bytes;
    const std::size_t whole_facets = behind_header / facet_bytes;
    const std::size_t facets = is_no_count(promised) ? whole_facets : promised;
    if (facets > whole_facets) {
        throw Error(ExitCode::input, path + ": the file ends after " + std::to_string(whole_facets) +
                                         " of the " + std::to_string(promised) +
                                         " facets its header promises; export the mesh again");
    }
    ParsedMesh parsed{
        read_welded([&](double negligible) { return read_facets(bytes, facets, path, negligible); }), {}};
    if (facets != promised) {
        parsed.warnings.push_back(path + ": the header says " + std::to_string(promised) +
                                  " facets; by the size of the file there are " + std::to_string(facets));
    }
    if (const std::size_t left = behind_header - facet_bytes * facets; left > 0) {
        parsed.warnings.push_back(path + ": " + std::to_string(left) + (left == 1 ? " byte" : " bytes") +
                                  " behind the last facet cannot be understood and are left out");
    }
    if (const std::optional<std::string> lost = lost_digits(parsed.mesh))
        parsed.warnings.push_back(path + ": " + *lost);
    return parsed;
}

bool has_no_control_characters(std::string_view bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](char c) {
        return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r');
    });
}

/// Whether the bytes are text as far as the first facets of a binary file would reach, where zeros stand. The
/// name of a solid may hold anything, if a facet in words follows it.
bool is_text(std::string_view bytes) {
    constexpr std::size_t looked_at = header_bytes + 4 * facet_bytes;
    std::string_view beginning = bytes.substr(0, looked_at);
    if (has_no_control_characters(beginning)) return true;
    beginning.remove_prefix(std::min(beginning.find_first_of("\r\n"), beginning.size()));
    return has_no_control_characters(beginning) &&
           begins_with(TextCursor(beginning, {}, 0).word_on_any_line(), "facet");
}

ParsedMesh read_text(std::string_view bytes, const std::string& path, char comment) {
    ParsedMesh parsed;
    parsed.mesh = read_welded([&](double negligible) {
        StlTextReader reader(bytes, path, comment, negligible);
        PolygonMesh mesh = reader.run();
        parsed.warnings = reader.take_warnings();
        return mesh;
    });
    return parsed;
}

/// Of length 1; 0 for a facet without area.
Eigen::Vector3d normal_of(const Facet& facet) {
    const Eigen::Vector3d u = (facet[1] - facet[0]).stableNormalized();
    return u.cross((facet[2] - facet[0]).stableNormalized()).stableNormalized();
}

std::string facet_bytes_of(const std::vector<Facet>& facets) {
    std::string bytes(header_bytes - sizeof(std::uint32_t), ' ');
    append_little_endian(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const Facet& facet : facets) {
        for (const double value : normal_of(facet)) append_little_endian(bytes, static_cast<float>(value));
        for (const Eigen::Vector3d& corner : facet) {
            for (const double value : corner) append_little_endian(bytes, static_cast<float>(value));
        }
        append_little_endian(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string facet_text(const std::vector<Facet>& facets) {
    std::string text = "solid coseg\n";
    for (const Facet& facet : facets) {
        text += "facet normal ";
        append_point(text, normal_of(facet));
        text += "outer loop\n";
        for (const Eigen::Vector3d& corner : facet) {
            text += "vertex ";
            append_point(text, corner);
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid coseg\n";
}

}  // namespace

ParsedMesh read_stl(std::string_view bytes, const std::string& path) {
    if (bytes.empty()) throw Error(ExitCode::input, path + ": the file is empty; export the mesh again");
    // Some exporters begin binary files with "solid" too, and a header may be text: the size decides first.
    if (bytes.size() >= header_bytes && bytes.size() == header_bytes + facet_bytes * promised_facets(bytes))
        return read_binary(bytes, path);
    if (is_text(bytes)) {
        const std::string_view first = TextCursor(bytes, path, 0).word_on_any_line();
        const char comment = first.starts_with('#') ? '#' : '\0';
        if (comment != 0 || begins_with(first, "solid")) return read_text(bytes, path, comment);
        throw Error(ExitCode::input, path + ": the file is text, but begins with " + in_quotes(first) +
                                         " and not with 'solid' as an STL file does; export the mesh again");
    }
    if (bytes.size() < header_bytes)
        throw Error(ExitCode::input, path + ": is too short for an STL file; export the mesh again");
    return read_binary(bytes, path);
}

void write_stl(const std::string& path, const PolygonMesh& mesh, const FaceArrays& arrays) {
    parts_of(arrays, mesh.face_count(), path);
    std::vector<Facet> facets;
    for (const FaceTriangle& triangle : face_triangles(mesh)) {
        const auto corner = [&](std::size_t k) { return mesh.vertices[at(triangle.vertices[k])]; };
        facets.push_back({corner(0), corner(1), corner(2)});
    }
    write_file(path, lost_digits(mesh) ? facet_text(facets) : facet_bytes_of(facets));
}

}  // namespace coseg
