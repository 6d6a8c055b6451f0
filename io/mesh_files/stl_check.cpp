#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "io/mesh_files/mesh_check.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

using Triangle = std::array<Eigen::Vector3f, 3>;

bool same_word(std::string_view word, std::string_view lower_case) {
    return word.size() == lower_case.size() &&
           std::equal(word.begin(), word.end(), lower_case.begin(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// OpenMesh takes corners for equal where coordinates differ by no more than the smallest normal float.
void add_facet(CheckedMesh& mesh, const Triangle& corners) {
    const auto equal = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
        return ((a - b).cwiseAbs().array() <= std::numeric_limits<float>::min()).all();
    };
    const bool is_kept =
        !equal(corners[0], corners[1]) && !equal(corners[1], corners[2]) && !equal(corners[2], corners[0]);
    if (is_kept) {
        mesh.plain.append(12, '\0');
        for (const Eigen::Vector3f& p : corners) {
            for (int k = 0; k < 3; ++k) append_little_endian(mesh.plain, p[k]);
        }
        mesh.plain.append(2, '\0');
    } else {
        LeftOutFace left_out{mesh.face_count, {}, {}};
        for (const Eigen::Vector3f& p : corners) left_out.points.emplace_back(p.cast<double>());
        mesh.left_out.push_back(std::move(left_out));
    }
    ++mesh.face_count;
}

class StlTextCheck {
  public:
    StlTextCheck(std::string_view bytes, const std::string& path, CheckedMesh& mesh)
        : cursor_(bytes, path, 0), mesh_(mesh) {}

    void run() {
        bool is_inside = false;
        while (cursor_.next_line()) {
            const std::string_view keyword = cursor_.word();
            if (!is_inside && same_word(keyword, "solid")) {
                is_inside = true;
            } else if (is_inside && same_word(keyword, "endsolid")) {
                is_inside = false;
            } else if (is_inside && same_word(keyword, "facet")) {
                check_facet();
            } else {
                cursor_.fail("an STL file has 'facet' or 'endsolid' here, not " + quoted(keyword));
            }
        }
        if (is_inside) {
            cursor_.fail("the file ends after " + std::to_string(mesh_.face_count) +
                         " facets without 'endsolid'; export the mesh again");
        }
    }

  private:
    void expect(std::string_view lower_case) {
        const std::string_view word = cursor_.word_on_any_line();
        if (same_word(word, lower_case)) return;
        cursor_.fail("facet " + std::to_string(mesh_.face_count) + " has " + quoted(word) + " where '" +
                     std::string(lower_case) + "' should stand");
    }

    void check_facet() {
        expect("normal");
        for (int k = 0; k < 3; ++k) {
            if (cursor_.word_on_any_line().empty())
                cursor_.fail("the file ends inside facet " + std::to_string(mesh_.face_count));
        }
        expect("outer");
        expect("loop");
        Triangle corners;
        for (Eigen::Vector3f& corner : corners) {
            expect("vertex");
            for (int k = 0; k < 3; ++k) corner[k] = coordinate();
        }
        expect("endloop");
        expect("endfacet");
        add_facet(mesh_, corners);
    }

    float coordinate() {
        const std::string_view word = cursor_.word_on_any_line();
        double value = 0.0;
        if (!parse_real(word, value)) {
            cursor_.fail("facet " + std::to_string(mesh_.face_count) + " has " + quoted(word) +
                         " where a coordinate should stand");
        }
        const std::string wrong = bad_coordinate(0, value);
        if (!wrong.empty()) {
            cursor_.fail("facet " + std::to_string(mesh_.face_count) +
                         " has a coordinate that is not finite or beyond 1e37; correct it");
        }
        return static_cast<float>(value);
    }

    TextCursor cursor_;
    CheckedMesh& mesh_;
};

void check_binary(std::string_view bytes, std::uint32_t facets, const std::string& path, CheckedMesh& mesh) {
    ByteCursor cursor(bytes, header_bytes, false);
    for (std::uint32_t f = 0; f < facets; ++f) {
        Eigen::Vector3f normal;
        Triangle corners;
        for (int k = 0; k < 3; ++k) cursor.read(normal[k]);
        for (Eigen::Vector3f& corner : corners) {
            for (int k = 0; k < 3; ++k) {
                cursor.read(corner[k]);
                if (bad_coordinate(f, corner[k]).empty()) continue;
                throw Error(ExitCode::input,
                            path + ": facet " + std::to_string(f) +
                                " has a coordinate that is not finite or beyond 1e37; correct it");
            }
        }
        std::uint16_t attribute = 0;
        cursor.read(attribute);
        add_facet(mesh, corners);
    }
}

std::uint32_t promised_facets(std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() >= header_bytes) ByteCursor(bytes, header_bytes - sizeof facets, false).read(facets);
    return facets;
}

}  // namespace

CheckedMesh check_stl(std::string_view bytes, const std::string& path) {
    if (bytes.empty()) throw Error(ExitCode::input, path + ": the file is empty; export the mesh again");
    CheckedMesh mesh;
    mesh.extension = "stl";
    mesh.is_binary = true;
    const std::uint32_t facets = promised_facets(bytes);
    const std::size_t needed = header_bytes + facet_bytes * static_cast<std::size_t>(facets);
    // Some exporters begin binary files with "solid" too: the size decides first.
    const bool fits = bytes.size() >= header_bytes && bytes.size() == needed;
    const bool says_solid = same_word(TextCursor(bytes, path, 0).word_on_any_line(), "solid");
    mesh.plain.assign(header_bytes, '\0');
    if (!fits && says_solid) {
        StlTextCheck(bytes, path, mesh).run();
    } else if (bytes.size() < header_bytes) {
        throw Error(ExitCode::input, path + ": is too short for an STL file; export the mesh again");
    } else if (bytes.size() < needed) {
        throw Error(ExitCode::input, path + ": the file ends after " +
                                         std::to_string((bytes.size() - header_bytes) / facet_bytes) +
                                         " of the " + std::to_string(facets) +
                                         " facets its header promises; export the mesh again");
    } else {
        check_binary(bytes, facets, path, mesh);
    }
    std::string count;
    append_little_endian(
        count, static_cast<std::uint32_t>(static_cast<std::size_t>(mesh.face_count) - mesh.left_out.size()));
    mesh.plain.replace(header_bytes - count.size(), count.size(), count);
    return mesh;
}

}  // namespace coseg
