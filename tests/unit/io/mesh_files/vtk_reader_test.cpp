#include "io/mesh_files/vtk_reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/mesh_files/mesh_reader.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/manifold.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

namespace fs = std::filesystem;

const fs::path corpus_folder =
    fs::path(__FILE__).parent_path().parent_path().parent_path().parent_path() / "corpus" / "mesh_files";

ParsedMesh read_from_corpus(const std::string& name) {
    return parse_mesh(test::content_of((corpus_folder / "read" / name).string()), name);
}

PolygonMesh pyramid() {
    return test::polygons_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}},
                             {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

/// vtk_*.vtp are as VTK 9.1 has written them.
TEST(VtkReader, EveryWayToWriteAnArrayGivesTheSameMesh) {
    for (const char* name :
         {"vtk_ascii.vtp", "vtk_zlib_base64.vtp", "vtk_zlib_raw.vtp", "vtk_big_endian_inline.vtp",
          "zlib_blocks.vtp", "inline_base64.vtp", "long_lengths_raw.vtp"}) {
        SCOPED_TRACE(name);
        const ParsedMesh parsed = read_from_corpus(name);
        EXPECT_EQ(parsed.mesh.vertices, pyramid().vertices);
        EXPECT_EQ(parsed.mesh.corners, pyramid().corners);
        EXPECT_EQ(parsed.mesh.offsets, pyramid().offsets);
        EXPECT_TRUE(parsed.warnings.empty());
    }
}

TEST(VtkReader, PiecesFollowOneAnother) {
    const PolygonMesh mesh = read_from_corpus("two_pieces.vtp").mesh;
    EXPECT_EQ(mesh.vertex_count(), 9);
    EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 4, 7, 10, 13, 16}));
    EXPECT_EQ(mesh.corners, (std::vector<int>{3, 2, 1, 0, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8}));
}

TEST(VtkReader, StripsAreTrianglesBehindThePolygonsAndLinesArePassedOver) {
    const ParsedMesh parsed = read_from_corpus("strips_and_lines.vtp");
    EXPECT_EQ(parsed.mesh.offsets, (std::vector<int>{0, 4, 7, 10}));
    // The strip 0 1 4 4 4 2 3: an odd corner turns its triangle.
    EXPECT_EQ(parsed.mesh.corners, (std::vector<int>{3, 2, 1, 0, 0, 1, 4, 4, 2, 3}));
    ASSERT_EQ(parsed.warnings.size(), 1U);
    EXPECT_EQ(parsed.warnings[0], "strips_and_lines.vtp: 1 point or line is passed over");
}

std::string document(const std::string& of_file, const std::string& points, const std::string& arrays) {
    return "<VTKFile type=\"PolyData\" " + of_file +
           "><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\">" +
           points + "</DataArray></Points><Polys>" + arrays + "</Polys></Piece></PolyData></VTKFile>";
}

constexpr const char* three_points = "0 0 0 1 0 0 0 1 0";
constexpr const char* triangle =
    "<DataArray type=\"UInt8\" Name=\"connectivity\">0 1 2</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\">3</DataArray>";

TEST(VtkReader, SentencesNameWhatIsWrong) {
    const auto sentence = [](const std::string& bytes) {
        const test::Caught caught = test::error_of([&] { parse_mesh(bytes, "a.vtp"); });
        EXPECT_EQ(caught.code, ExitCode::input);
        return caught.sentence;
    };
    const auto expect_says = [&](const std::string& bytes, const std::string& words) {
        EXPECT_NE(sentence(bytes).find(words), std::string::npos) << sentence(bytes);
    };
    EXPECT_EQ(read_vtp(document("", three_points, triangle), "a.vtp").mesh.face_count(), 1);
    expect_says(document("byte_order=\"Middle\"", three_points, triangle),
                "a.vtp:1: the byte_order is 'Middle'");
    expect_says(document("header_type=\"UInt8\"", three_points, triangle), "the header_type is 'UInt8'");
    expect_says(document("compressor=\"vtkLZMADataCompressor\"", three_points,
                         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">AAAA</DataArray>"),
                "'offsets' of Polys is compressed by 'vtkLZMADataCompressor', of which only "
                "vtkZLibDataCompressor is read");
    expect_says(document("", "0 0 0 1 0 0 0 1", triangle), "promises 3 points, but there are 8 coordinates");
    expect_says(document("", "0 0 0 1 0 0 0 1,5 0", triangle), "of Points has the value '1,5'");
    expect_says(document("", three_points, ""), "no array 'Polys/offsets'");
    expect_says("<VTKFile type=\"ImageData\"></VTKFile>", "the file holds 'ImageData'");
    expect_says("<VTKFile type=\"PolyData\">\n<Piece NumberOfPoints=3></VTKFile>",
                "a.vtp:2: the XML is damaged (not well-formed");
    expect_says("\n<!-- <VTKFile", "a.vtp:2: the XML is cut short");
}

TEST(VtkReader, CoordinatesThatHaveLostDigitsAreWarnedOf) {
    const std::string far = "4e6 0 0 4000000.25 0 0 4e6 0.25 0";
    EXPECT_TRUE(
        read_vtp(document("", far, triangle), "a.vtp").warnings.empty());  // text may have more digits
    std::string bytes = document("", "", triangle);
    const std::string mark = "<DataArray type=\"Float32\">";
    // 4e6, 4000000.25 and 0.25 in single precision, where the steps are 0.25.
    bytes.replace(bytes.find(mark), mark.size(),
                  "<DataArray type=\"Float32\" "
                  "format=\"binary\">JAAAAAAkdEoAAAAAAAAAAAEkdEoAAAAAAAAAAAAkdEoAAIA+AAAAAA==");
    const ParsedMesh parsed = read_vtp(bytes, "a.vtp");
    ASSERT_EQ(parsed.warnings.size(), 1U);
    EXPECT_TRUE(parsed.warnings[0].starts_with("a.vtp: ")) << parsed.warnings[0];
}

TEST(VtkReader, TextIsReadWhateverCompressesOtherArrays) {
    const std::string lz4 = "compressor=\"vtkLZ4DataCompressor\"";
    EXPECT_EQ(parse_mesh(document(lz4, three_points, triangle), "a.vtp").mesh.face_count(), 1);
}

}  // namespace
}  // namespace coseg
