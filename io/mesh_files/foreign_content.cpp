#include "io/mesh_files/foreign_content.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "io/files/text_cursor.hpp"

namespace coseg {

namespace {

struct Beginning {
    std::string_view bytes;  ///< in lower case
    std::string_view what;
};

constexpr std::string_view unpack = "; unpack it and give the meshes inside";
constexpr std::string_view convert = "; convert it to OFF, OBJ, PLY, STL, GLB or VTP";

constexpr std::array packed{Beginning{"pk\x03\x04", "a ZIP archive"},
                            Beginning{"\x1f\x8b", "a gzip archive"},
                            Beginning{"bzh", "a bzip2 archive"},
                            Beginning{"\xfd\x37zxz", "an xz archive"},
                            Beginning{"7z\xbc\xaf", "a 7z archive"},
                            Beginning{"rar!", "a RAR archive"},
                            Beginning{"\x28\xb5\x2f\xfd", "a Zstandard archive"}};

constexpr std::array other_formats{
    Beginning{"kaydara fbx", "an FBX file"},   Beginning{"; fbx", "an FBX file"},
    Beginning{"#vrml", "a VRML file"},         Beginning{"#inventor", "an Open Inventor file"},
    Beginning{"# vtk datafile", "a VTK file"}, Beginning{"iso-10303-21", "a STEP file"},
    Beginning{"blender", "a Blender file"},    Beginning{"meshversionformatted", "a Medit file"},
    Beginning{"$meshformat", "a Gmsh file"},   Beginning{"\x89hdf", "an HDF5 file"},
    Beginning{"matlab ", "a MATLAB file"},     Beginning{"%pdf", "a PDF document"},
    Beginning{"\x89png", "a PNG picture"},     Beginning{"\xff\xd8\xff", "a JPEG picture"},
    Beginning{"gif8", "a GIF picture"},        Beginning{"\x7f\x65lf", "a program"},
    Beginning{"<?xml", "an XML file"}};

constexpr std::array<std::string_view, 4> web_pages{"<!doctype html", "<html", "<head", "<!--"};

/// Words with which OBJ files begin, comments apart.
constexpr std::array<std::string_view, 7> obj_words{"v", "vn", "vt", "o", "g", "mtllib", "usemtl"};

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

/// Every glTF file in JSON has an object of this name.
bool is_gltf_text(std::string_view bytes) { return bytes.find("\"asset\"") != std::string_view::npos; }

/// An object of JSON begins with a name in quotation marks or is empty. Geomview writes objects in braces
/// too.
std::optional<std::string> in_braces(std::string_view bytes, std::string_view beginning) {
    if (!beginning.starts_with("{") || is_gltf_text(bytes)) return std::nullopt;
    const std::size_t next = beginning.find_first_not_of(" \t\r\n", 1);
    if (next == std::string_view::npos || beginning[next] == '"' || beginning[next] == '}')
        return "text in JSON, perhaps of a server; download the mesh again, or convert it";
    return "text in braces, perhaps of Geomview; keep what stands between them, the mesh";
}

/// Readers of either glTF format take both forms.
std::optional<std::string> other_gltf(std::string_view bytes, std::string_view beginning,
                                      std::string_view format) {
    if (format == "GLB" || format == "glTF") return std::nullopt;
    if (bytes.starts_with("glTF")) return "a binary glTF file by its content; give it the suffix .glb";
    if (beginning.starts_with("{") && is_gltf_text(bytes))
        return "a glTF file by its content; give it the suffix .gltf";
    return std::nullopt;
}

/// Every XML file of VTK has a tag of this name, behind the declaration of XML if there is one.
bool is_vtk_xml(std::string_view beginning) { return beginning.find("<vtkfile") != std::string_view::npos; }

std::optional<std::string> not_a_mesh(std::string_view bytes, std::string_view beginning) {
    if (beginning.starts_with("version https://git-lfs"))
        return "a Git LFS pointer, not the mesh itself; fetch the mesh with 'git lfs pull'";
    if (beginning.substr(0, beginning.find('\n')).find("/annex/objects/") != std::string_view::npos)
        return "a git-annex pointer, not the mesh itself; fetch the mesh with 'git annex get'";
    if (std::any_of(web_pages.begin(), web_pages.end(),
                    [&](std::string_view page) { return beginning.starts_with(page); }))
        return "a web page, not a mesh; download the mesh again";
    if (bytes.starts_with(std::string_view("\xff\xfe\0\0", 4)) ||
        bytes.starts_with(std::string_view("\0\0\xfe\xff", 4)))
        return "text in UTF-32; save it as UTF-8";
    if (!bytes.empty() && bytes.find_first_not_of('\0') == std::string_view::npos)
        return "nothing but zeros, as after a copy that was cut short; copy the mesh again";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> foreign_content(std::string_view bytes, std::string_view format) {
    const std::size_t first = bytes.find_first_not_of("\xef\xbb\xbf \t\r\n");
    const std::string beginning = lower_case_beginning(bytes.substr(std::min(first, bytes.size())));
    if (beginning.starts_with("<") && is_vtk_xml(beginning)) {
        if (format == "VTP") return std::nullopt;
        return "a VTK file in XML by its content; if it is PolyData, give it the suffix .vtp";
    }
    if (std::optional<std::string> what = not_a_mesh(bytes, beginning)) return what;
    if (std::optional<std::string> what = named(beginning, packed, unpack)) return what;
    if (std::optional<std::string> what = named(beginning, other_formats, convert)) return what;
    if (beginning.starts_with("<")) return "text in XML or HTML, not a mesh; download the mesh again";
    if (std::optional<std::string> what = other_gltf(bytes, beginning, format)) return what;
    if (std::optional<std::string> what = in_braces(bytes, beginning)) return what;
    const std::string_view found = mesh_format_of(bytes);
    if (found.empty() || found == format) return std::nullopt;
    const std::string article = found == "PLY" ? "a " : "an ";
    return article + std::string(found) + " file by its content; give it the suffix of that format";
}

}  // namespace coseg
