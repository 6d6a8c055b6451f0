#include "io/mesh_files/foreign_content.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/mesh_files/mesh_format.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "tests/support/errors.hpp"

namespace coseg {
namespace {

/// The whole literal, also behind a zero.
template <std::size_t N>
std::string with_zeros(const char (&literal)[N]) {
    return std::string(literal, N - 1);
}

/// What the sentence about such a file says it is, for every suffix.
void expect_named(const std::string& bytes, const std::string& what,
                  const std::vector<std::string_view>& own_formats = {}) {
    for (const MeshFormat& format : mesh_formats()) {
        if (format.read == nullptr || std::ranges::count(own_formats, format.name) > 0) continue;
        const std::string path = "a" + std::string(format.suffix);
        const test::Caught caught = test::error_of([&] { parse_mesh(bytes, path); });
        EXPECT_EQ(caught.code, ExitCode::input);
        EXPECT_TRUE(caught.sentence.starts_with(path + ": the file is " + what)) << caught.sentence;
    }
}

TEST(ForeignContent, FilesThatAreNoMeshes) {
    expect_named("", "empty");
    expect_named("version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n", "a Git LFS pointer");
    expect_named("/annex/objects/SHA256E-s1--0.off\n", "a git-annex pointer");
    expect_named("<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head></html>\n", "a web page");
    expect_named("\xEF\xBB\xBF\n <HTML>\n", "a web page");
    expect_named("<Error><Code>AccessDenied</Code></Error>", "text in XML or HTML");
    expect_named("{\"message\": \"Not Found\"}", "text in JSON");
    expect_named("{ OFF\n0 0 0\n}\n", "text in braces, perhaps of Geomview");
    expect_named("PK\x03\x04 something", "a ZIP archive");
    expect_named(with_zeros("\x1f\x8b\x08\x00 something"), "a gzip archive");
    expect_named(with_zeros("glTF\x02\x00\x00\x00"), "a binary glTF file", {"GLB", "glTF"});
    expect_named("{\"asset\": {\"version\": \"2.0\"}}", "a glTF file by its content", {"GLB", "glTF"});
    expect_named("# vtk DataFile Version 3.0\n", "a VTK file");
    expect_named("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "a VTK file in XML by its content",
                 {"VTP"});
    expect_named("<?xml version=\"1.0\"?>\n<COLLADA>", "an XML file");
    expect_named(std::string(500, '\0'), "nothing but zeros");
    expect_named(with_zeros("\xff\xfe\0\0v\0\0\0 \0\0\0"), "text in UTF-32");
}

TEST(ForeignContent, MeshesUnderAnotherSuffix) {
    expect_named("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "an OFF file", {"OFF"});
    expect_named("# x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "an OBJ file", {"OBJ"});
    expect_named("ply\nformat ascii 1.0\n", "a PLY file", {"PLY"});
    expect_named("solid x\nfacet normal 0 0 0\n", "an STL file", {"STL"});
}

TEST(ForeignContent, OwnFormatAndUnknownBytesAreNotNamed) {
    EXPECT_EQ(foreign_content("OFF\n3 1 0\n", "OFF"), std::nullopt);
    EXPECT_EQ(foreign_content("3 1 0\n", "OFF"), std::nullopt);
    EXPECT_EQ(foreign_content("\x01\x02\x03", "STL"), std::nullopt);
}

TEST(ForeignContent, MeshesInUtf16AreRead) {
    const std::string mesh = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const bool has_mark : {true, false}) {
        std::string little = has_mark ? "\xff\xfe" : "";
        std::string big = has_mark ? "\xfe\xff" : "";
        for (const char c : mesh) {
            little.append({c, '\0'});
            big.append({'\0', c});
        }
        EXPECT_EQ(parse_mesh(little, "a.off").mesh.face_count(), 1);
        EXPECT_EQ(parse_mesh(big, "a.off").mesh.face_count(), 1);
    }
}

}  // namespace
}  // namespace coseg
