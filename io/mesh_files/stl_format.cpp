#include "io/mesh_files/stl_format.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/corner_welder.hpp"
#include "io/mesh_files/mesh_limits.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

using Facet = std::array<Eigen::Vector3f, 3>;

/// Numbers the corners of facets. Facets with two equal corners wait until all others have their numbers.
class FacetCollector {
  public:
    /// False if there are more than a mesh may have.
    [[nodiscard]] bool add(const Facet& facet) {
        if (std::ssize(corners_) + 3 > most_corners) return false;
        const bool has_equal_corners = is_same_position(facet[0], facet[1]) ||
                                       is_same_position(facet[1], facet[2]) ||
                                       is_same_position(facet[2], facet[0]);
        if (has_equal_corners) waiting_.push_back({corners_.size(), facet});
        for (const Eigen::Vector3f& corner : facet)
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

/// An ASCII file's digits, rounded as a binary file would hold them, so that a mesh has the same labels from
/// either kind of file. A mesh that lies far from the origin loses digits by it, from which a binary file
/// could not save it.
float in_single_precision(double value) { return static_cast<float>(value); }

class StlTextReader {
  public:
    StlTextReader(std::string_view bytes, const std::string& path) : cursor_(bytes, path, 0) {}

    PolygonMesh run() {
        bool is_inside = false;
        while (cursor_.next_line()) {
            const std::string_view keyword = cursor_.word();
            if (!is_inside && same_word(keyword, "solid")) {
                is_inside = true;
            } else if (is_inside && same_word(keyword, "endsolid")) {
                is_inside = false;
            } else if (is_inside && same_word(keyword, "facet")) {
                read_facet();
            } else {
                cursor_.fail("an STL file has 'facet' or 'endsolid' here, not " + in_quotes(keyword));
            }
        }
        if (is_inside)
            cursor_.fail("the file ends after " + number() +
                         " facets without 'endsolid'; export the mesh again");
        return facets_.finish();
    }

  private:
    /// Of the facet at hand.
    [[nodiscard]] std::string number() const { return std::to_string(facets_.facet_count()); }

    void expect(std::string_view lower_case) {
        const std::string_view word = cursor_.word_on_any_line();
        if (same_word(word, lower_case)) return;
        cursor_.fail("facet " + number() + " has " + in_quotes(word) + " where '" + std::string(lower_case) +
                     "' should stand");
    }

    void read_facet() {
        expect("normal");
        for (int k = 0; k < 3; ++k) {
            if (cursor_.word_on_any_line().empty()) cursor_.fail("the file ends inside facet " + number());
        }
        expect("outer");
        expect("loop");
        Facet facet;
        for (Eigen::Vector3f& corner : facet) {
            expect("vertex");
            for (int k = 0; k < 3; ++k) corner[k] = in_single_precision(coordinate());
        }
        expect("endloop");
        expect("endfacet");
        if (!facets_.add(facet)) cursor_.fail(too_many_corners);
    }

    double coordinate() {
        const std::string_view word = cursor_.word_on_any_line();
        double value = 0.0;
        if (!parse_real(word, value))
            cursor_.fail("facet " + number() + " has " + in_quotes(word) +
                         " where a coordinate should stand");
        if (!is_usable_coordinate(value)) {
            cursor_.fail("facet " + number() +
                         " has a coordinate that is not finite or beyond 1e37; correct it");
        }
        return value;
    }

    TextCursor cursor_;
    FacetCollector facets_;
};

/// The caller has seen to it that the bytes of all facets are there.
PolygonMesh read_binary(std::string_view bytes, std::uint32_t facet_count, const std::string& path) {
    FacetCollector facets;
    facets.expect(facet_count);
    ByteCursor cursor(bytes, header_bytes, false);
    for (std::uint32_t f = 0; f < facet_count; ++f) {
        Eigen::Vector3f normal;
        for (float& value : normal.reshaped()) cursor.read(value);
        Facet facet;
        facet.fill(Eigen::Vector3f::Zero());
        for (Eigen::Vector3f& corner : facet) {
            for (float& value : corner.reshaped()) {
                cursor.read(value);
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

std::uint32_t promised_facets(std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() >= header_bytes) ByteCursor(bytes, header_bytes - sizeof facets, false).read(facets);
    return facets;
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes, const std::string& path) {
    if (bytes.empty()) throw Error(ExitCode::input, path + ": the file is empty; export the mesh again");
    const std::uint32_t facets = promised_facets(bytes);
    const std::size_t needed = header_bytes + facet_bytes * static_cast<std::size_t>(facets);
    // Some exporters begin binary files with "solid" too: the size decides first.
    const bool fits = bytes.size() >= header_bytes && bytes.size() == needed;
    const bool says_solid = same_word(TextCursor(bytes, path, 0).word_on_any_line(), "solid");
    if (!fits && says_solid) return StlTextReader(bytes, path).run();
    if (bytes.size() < header_bytes)
        throw Error(ExitCode::input, path + ": is too short for an STL file; export the mesh again");
    if (bytes.size() < needed) {
        throw Error(ExitCode::input, path + ": the file ends after " +
                                         std::to_string((bytes.size() - header_bytes) / facet_bytes) +
                                         " of the " + std::to_string(facets) +
                                         " facets its header promises; export the mesh again");
    }
    return read_binary(bytes, facets, path);
}

}  // namespace coseg
