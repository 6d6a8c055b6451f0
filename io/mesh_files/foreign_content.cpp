#include "io/mesh_files/foreign_content.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "io/files/text_cursor.hpp"

namespace coseg {

namespace {

using std::string_view_literals::operator""sv;

struct Beginning {
    std::string_view bytes;  ///< in lower case
    std::string_view what;
};

constexpr std::string_view unpack = "; unpack it and give the meshes inside";
constexpr std::string_view convert = "; convert it to OFF, OBJ, PLY or STL";

constexpr std::array packed{Beginning{"pk\x03\x04"sv, "a ZIP archive"},
                            Beginning{"\x1f\x8b"sv, "a gzip archive"},
                            Beginning{"bzh"sv, "a bzip2 archive"},
                            Beginning{"\xfd\x37zxz"sv, "an xz archive"},
                            Beginning{"7z\xbc\xaf"sv, "a 7z archive"},
                            Beginning{"rar!"sv, "a RAR archive"},
                            Beginning{"\x28\xb5\x2f\xfd"sv, "a Zstandard archive"}};

constexpr std::array other_formats{Beginning{"gltf"sv, "a binary glTF file"},
                                   Beginning{"kaydara fbx"sv, "an FBX file"},
                                   Beginning{"; fbx"sv, "an FBX file"},
                                   Beginning{"#vrml"sv, "a VRML file"},
                                   Beginning{"#inventor"sv, "an Open Inventor file"},
                                   Beginning{"# vtk datafile"sv, "a VTK file"},
                                   Beginning{"iso-10303-21"sv, "a STEP file"},
                                   Beginning{"blender"sv, "a Blender file"},
                                   Beginning{"meshversionformatted"sv, "a Medit file"},
                                   Beginning{"$meshformat"sv, "a Gmsh file"},
                                   Beginning{"\x89hdf"sv, "an HDF5 file"},
                                   Beginning{"matlab "sv, "a MATLAB file"},
                                   Beginning{"%pdf"sv, "a PDF document"},
                                   Beginning{"\x89png"sv, "a PNG picture"},
                                   Beginning{"\xff\xd8\xff"sv, "a JPEG picture"},
                                   Beginning{"gif8"sv, "a GIF picture"},
                                   Beginning{"\x7f\x65lf"sv, "a program"},
                                   Beginning{"<?xml"sv, "an XML file"}};

constexpr std::array web_pages{"<!doctype html"sv, "<html"sv, "<head"sv, "<!--"sv};

/// Words with which OBJ files begin, comments apart.
constexpr std::array obj_words{"v"sv, "vn"sv, "vt"sv, "o"sv, "g"sv, "mtllib"sv, "usemtl"sv};

std::string lower_case_beginning(std::string_view bytes) {
    constexpr std::size_t looked_at = 512;
    std::string beginning(bytes.substr(0, looked_at));
    for (char& c : beginning) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return beginning;
}

template <std::size_t N>
std::optional<std::string> named(std::string_view beginning, const std::array<Beginning, N>& known,
                                 std::string_view advice) {
    for (const Beginning& one : known) {
        if (beginning.starts_with(one.bytes)) return std::string(one.what).append(advice);
    }
    return std::nullopt;
}

/// The name of the mesh format as which the text begins; empty if it is none.
std::string_view mesh_format_of(std::string_view bytes) {
    const std::string_view first = TextCursor(bytes, "", '#').word_on_any_line();
    const std::string word = lower_case_beginning(first);
    if (word == "ply") return "PLY";
    if (word == "solid" || word == "facet") return "STL";
    if (word.size() <= 9 && word.ends_with("off")) return "OFF";
    if (std::find(obj_words.begin(), obj_words.end(), word) != obj_words.end()) return "OBJ";
    return {};
}

std::optional<std::string> not_a_mesh(std::string_view bytes, std::string_view beginning) {
    if (beginning.starts_with("version https://git-lfs"))
        return "a Git LFS pointer, not the mesh itself; fetch the mesh with 'git lfs pull'";
    if (beginning.substr(0, beginning.find('\n')).find("/annex/objects/") != std::string_view::npos)
        return "a git-annex pointer, not the mesh itself; fetch the mesh with 'git annex get'";
    if (std::any_of(web_pages.begin(), web_pages.end(),
                    [&](std::string_view page) { return beginning.starts_with(page); }))
        return "a web page, not a mesh; download the mesh again";
    if (bytes.starts_with("\xff\xfe\0\0"sv) || bytes.starts_with("\0\0\xfe\xff"sv))
        return "text in UTF-32; save it as UTF-8";
    if (!bytes.empty() && bytes.find_first_not_of('\0') == std::string_view::npos)
        return "nothing but zeros, as after a copy that was cut short; copy the mesh again";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> foreign_content(std::string_view bytes, std::string_view format) {
    const std::size_t first = bytes.find_first_not_of("\xef\xbb\xbf \t\r\n");
    const std::string beginning = lower_case_beginning(bytes.substr(std::min(first, bytes.size())));
    if (std::optional<std::string> what = not_a_mesh(bytes, beginning)) return what;
    if (std::optional<std::string> what = named(beginning, packed, unpack)) return what;
    if (std::optional<std::string> what = named(beginning, other_formats, convert)) return what;
    const std::string_view found = mesh_format_of(bytes);
    if (found.empty() || found == format) return std::nullopt;
    const std::string article = found == "PLY" ? "a " : "an ";
    return article + std::string(found) + " file by its content; give it the suffix of that format";
}

}  // namespace coseg
