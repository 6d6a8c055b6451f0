#include "io/mesh_files/mesh_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "io/mesh_files/off_format.hpp"
#include "src/base/error.hpp"
#include "src/base/seeded_random.hpp"
#include "src/repair/mesh_repair.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::error_of;
using test::TemporaryFolder;

const char* const pyramid_off =
    "OFF\n5 5 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 0.7\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

const char* const pyramid_obj =
    "# a pyramid\nmtllib none.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0.7\nvt 0 0\nvn 0 "
    "0 1\n"
    "usemtl red\ns off\nf 4 3 2 1\nf 1/1/1 2/1/1 5/1/1\nf 2//1 3//1 5//1\nf -3 -2 -1\nf 4/1 1/1 5/1\n";

const char* const pyramid_ply =
    "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement vertex 5\nproperty float x\nproperty "
    "float y\n"
    "property float z\nproperty uchar red\nelement face 5\nproperty list uchar int vertex_indices\nproperty "
    "uchar red\n"
    "end_header\n0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n0.5 0.5 0.7 9\n4 3 2 1 0 7\n3 0 1 4 7\n3 1 2 4 7\n3 2 3 "
    "4 7\n3 3 0 4 7\n";

const char* const triangle_stl =
    "solid t\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  "
    "endloop\n endfacet\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 1 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n "
    "endfacet\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 1 0 0\n   vertex 1 1 0\n   vertex 0 1 0\n  endloop\n "
    "endfacet\nendsolid t\n";

template <typename T>
void put(std::string& bytes, T value, bool big_endian = false) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// The pyramid with double coordinates, 16-bit indices and a list before the corners, which other readers
/// misread.
std::string pyramid_binary_ply(bool big_endian) {
    std::string bytes =
        std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement tag 2\nproperty list ushort float numbers\nelement vertex 5\nproperty uchar flag\n"
        "property double x\nproperty double y\nproperty double z\nelement face 5\n"
        "property list uchar short extra\nproperty list uint ushort vertex_index\nend_header\n";
    for (int tag = 0; tag < 2; ++tag) {
        put(bytes, static_cast<std::uint16_t>(tag), big_endian);
        for (int k = 0; k < tag; ++k) put(bytes, 1.5F, big_endian);
    }
    const double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.7}};
    for (const auto& point : points) {
        put(bytes, std::uint8_t{3});
        for (const double x : point) put(bytes, x, big_endian);
    }
    const std::vector<std::vector<int>> faces{{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    for (const auto& face : faces) {
        put(bytes, std::uint8_t{1});
        put(bytes, std::int16_t{-5}, big_endian);
        put(bytes, static_cast<std::uint32_t>(face.size()), big_endian);
        for (const int corner : face) put(bytes, static_cast<std::uint16_t>(corner), big_endian);
    }
    return bytes;
}

using Facet = std::array<Eigen::Vector3f, 3>;

std::string binary_stl_of(const std::vector<Facet>& facets) {
    std::string bytes(80, 's');
    put(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const Facet& facet : facets) {
        for (int k = 0; k < 3; ++k) put(bytes, 0.0F);
        for (const Eigen::Vector3f& corner : facet) {
            for (const float value : corner) put(bytes, value);
        }
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string binary_stl(const TriMesh& mesh) {
    std::vector<Facet> facets;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto corner = [&](int k) {
            return Eigen::Vector3f(mesh.vertices.col(mesh.faces(k, f)).cast<float>());
        };
        facets.push_back({corner(0), corner(1), corner(2)});
    }
    return binary_stl_of(facets);
}

void expect_pyramid(const PolygonMesh& mesh) {
    EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 4, 7, 10, 13, 16}));
    EXPECT_EQ(mesh.corners, (std::vector<int>{3, 2, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}));
    ASSERT_EQ(mesh.vertex_count(), 5);
    EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(1, 1, 0));
    EXPECT_EQ(mesh.vertices[4], Eigen::Vector3d(0.5, 0.5, 0.7));  // 0.7 is no float: coordinates stay double
}

TEST(MeshReader, EveryFormatGivesTheSamePyramid) {
    const TemporaryFolder folder;
    expect_pyramid(read_mesh(folder.file("p.off", pyramid_off)));
    expect_pyramid(read_mesh(folder.file("p.OBJ", pyramid_obj)));
    expect_pyramid(read_mesh(folder.file("p.ply", pyramid_ply)));
    expect_pyramid(read_mesh(folder.file("l.ply", pyramid_binary_ply(false))));
    expect_pyramid(read_mesh(folder.file("b.ply", pyramid_binary_ply(true))));
}

TEST(MeshReader, OffVariants) {
    const TemporaryFolder folder;
    const std::string body = pyramid_off + 4;
    const std::string counts = "5 5 8\n";
    const std::string items = body.substr(counts.size());
    expect_pyramid(read_mesh(folder.file("1.off", "# first\n\n  OFF # here\n\n# more\n5 5 8\n" + items)));
    expect_pyramid(read_mesh(folder.file("2.off", "OFF 5 5 8\n" + items)));
    expect_pyramid(read_mesh(folder.file("3.off", "OFF5 5 8\n" + items)));
    expect_pyramid(read_mesh(folder.file("4.off", "OFF\n5 5\n" + items)));
    std::string crlf = pyramid_off;
    for (std::size_t i = crlf.find('\n'); i != std::string::npos; i = crlf.find('\n', i + 2))
        crlf.replace(i, 1, "\r\n");
    expect_pyramid(read_mesh(folder.file("5.off", "\xEF\xBB\xBF" + crlf)));
    std::string no_newline = pyramid_off;
    no_newline.pop_back();
    expect_pyramid(read_mesh(folder.file("6.off", no_newline)));
    expect_pyramid(read_mesh(folder.file("7.off",
                                         "OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 0.7\n4 3 2 1 0 255 "
                                         "0 0\n3 0 1 4 0.5 0.5 0.5\n3 1 2 4 1\n3 2 3 4\n3 3 0 4 1 2 3 4\n")));
    expect_pyramid(read_mesh(folder.file("8.off",
                                         "CNOFF\n5 5 0\n0 0 0 0 0 1 9 9 9\n1 0 0 0 0 1 9 9 9\n1 1 0 0 0 1 9 "
                                         "9 9\n0 1 0 0 0 1 9 9 9\n0.5 0.5 0.7 0 0 1 9 9 9\n" +
                                             items.substr(items.find("4 3 2")))));
}

TEST(MeshReader, ObjLinesJoinedByBackslash) {
    const TemporaryFolder folder;
    const PolygonMesh mesh = read_mesh(folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 \\\n 1 0\nf 1 2 \\\n3\n"));
    EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2}));
}

TEST(MeshReader, FacesThatRepeatAVertexKeepTheirPlace) {
    const TemporaryFolder folder;
    const PolygonMesh obj =
        read_mesh(folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\nf 1 2\nf 3 3 3\n"));
    EXPECT_EQ(obj.offsets, (std::vector<int>{0, 3, 6, 8, 11}));
    EXPECT_EQ(obj.corners, (std::vector<int>{0, 0, 1, 0, 1, 2, 0, 1, 2, 2, 2}));
    const PolygonMesh off =
        read_mesh(folder.file("a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 0 1\n3 0 1 2\n2 1 2\n"));
    EXPECT_EQ(off.offsets, (std::vector<int>{0, 3, 6, 8}));
    const PolygonMesh stl = read_mesh(folder.file("a.stl", triangle_stl));
    EXPECT_EQ(stl.offsets, (std::vector<int>{0, 3, 6, 9}));
    EXPECT_EQ(stl.corners, (std::vector<int>{0, 1, 2, 1, 1, 2, 1, 3, 2}));
}

/// Formats differ here: only OBJ faces of three different vertices or more lose their repeats.
TEST(MeshReader, ObjFacesNameAVertexOnceInARow) {
    const TemporaryFolder folder;
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    const PolygonMesh obj =
        read_mesh(folder.file("a.obj", square + "f 1 2 3 3\nf 1 3 1 4 3\nf 1 2 2 1\nf 1 2 3 4\n"));
    EXPECT_EQ(obj.offsets, (std::vector<int>{0, 3, 8, 12, 16}));
    EXPECT_EQ(obj.corners, (std::vector<int>{0, 1, 2, 0, 2, 0, 3, 2, 0, 1, 1, 0, 0, 1, 2, 3}));
    const PolygonMesh off =
        read_mesh(folder.file("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 2\n"));
    EXPECT_EQ(off.corners, (std::vector<int>{0, 1, 2, 2}));
}

TEST(MeshReader, StlVerticesOfFacetsWithoutAreaComeLast) {
    const TemporaryFolder folder;
    const std::string bytes =
        binary_stl_of({Facet{{{5, 5, 5}, {5, 5, 5}, {6, 5, 5}}}, Facet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
    const PolygonMesh mesh = read_mesh(folder.file("a.stl", bytes));
    EXPECT_EQ(mesh.corners, (std::vector<int>{3, 3, 4, 0, 1, 2}));
    EXPECT_EQ(mesh.vertices[3], Eigen::Vector3d(5, 5, 5));
}

TEST(MeshReader, BinaryStlComesBackWeldedAndInOrder) {
    const TemporaryFolder folder;
    const TriMesh sphere = test::sphere(3);
    const PolygonMesh mesh = read_mesh(folder.file("s.stl", binary_stl(sphere)));
    EXPECT_EQ(mesh.vertex_count(), sphere.vertex_count());
    ASSERT_EQ(mesh.face_count(), sphere.face_count());
    for (int f = 0; f < sphere.face_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d& p =
                mesh.vertices[static_cast<std::size_t>(mesh.corners[static_cast<std::size_t>(3 * f + k)])];
            ASSERT_LT((p - sphere.vertices.col(sphere.faces(k, f))).norm(), 1e-6);
        }
    }
    std::string solid = binary_stl(sphere);  // some exporters write binary files that begin like text
    solid.replace(0, 6, "solid ");
    EXPECT_EQ(read_mesh(folder.file("t.stl", solid)).face_count(), sphere.face_count());
}

TEST(MeshReader, WrittenOffReadsBackToTheSameBits) {
    const TemporaryFolder folder;
    TriMesh mesh = test::torus(1, 0.3, 17, 9);
    mesh.vertices *= 1.0 / 3.0;
    mesh.vertices.colwise() += Eigen::Vector3d(1e7, -1e-9, 4.0 / 7.0);
    write_off(folder.path("t.off"), mesh);
    const PolygonMesh back = read_mesh(folder.path("t.off"));
    ASSERT_EQ(back.vertex_count(), mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
        ASSERT_EQ(back.vertices[static_cast<std::size_t>(v)], mesh.vertices.col(v));
    write_off(folder.path("u.off"), back);
    EXPECT_EQ(test::content_of(folder.path("t.off")), test::content_of(folder.path("u.off")));
}

struct BadFile {
    const char* name;
    std::string content;
    std::vector<std::string> words;  ///< that the message must hold
};

std::vector<BadFile> bad_files() {
    const std::string nan_stl =
        std::string(triangle_stl).replace(std::string(triangle_stl).find("vertex 0 0 0") + 7, 1, "nan");
    const std::string ply(pyramid_ply);
    return {
        {"a.off", "", {"a.off", "empty"}},
        {"b.off", "OFF\n5", {":2", "ends in its header"}},
        {"c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", {"2 of the 3 vertices"}},
        {"d.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {"1 of the 2 faces"}},
        {"e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", {":6", "face 0", "vertex 3", "3 vertices"}},
        {"f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", {":6", "face 0", "vertex -1"}},
        {"g.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", {":4", "vertex 1", "finite"}},
        {"h.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 inf 0\n3 0 1 2\n", {":5", "vertex 2", "finite"}},
        {"i.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n", {":5", "vertex 2", "finite"}},
        {"j.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e200 0\n3 0 1 2\n", {":5", "vertex 2", "1e37"}},
        {"k.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", {"no faces"}},
        {"l.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", {"no area"}},
        {"m.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n", {"no area"}},
        {"n.off", "OFF\n2000000000 2000000000 0\n", {"0 of the 2000000000 vertices"}},
        {"o.off", "OFF\n3 2000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {"1 of the 2000000000 faces"}},
        {"p.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", {"0 of the 1 faces"}},
        {"q.off", "OFF\n-3 1 0\n", {"'-3'"}},
        {"r.off", "OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {":3", "vertex 0", "three coordinates"}},
        {"t.off", "PK\x03\x04 something", {"ZIP archive"}},
        {"u.off", "OFF BINARY\n", {"binary OFF"}},
        {"w.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-1\n", {":6", "face 0"}},
        {"a.obj", "", {"empty"}},
        {"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"no faces"}},
        {"c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", {"face 0", "vertex 3", "3 vertices"}},
        {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", {":4", "face 0", "vertex 0"}},
        {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", {":4", "face 0", "vertex -4"}},
        {"f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf /1 2 3\n", {":4", "'/1'"}},
        {"g.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", {":2", "vertex 1", "'zero'"}},
        {"h.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", {":2", "vertex 1", "finite"}},
        {"j.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", {":4", "face 0"}},
        {"a.ply", "", {"empty"}},
        {"b.ply", "ply\nformat ascii 1.0\nelement vertex 5\n", {"end_header"}},
        {"c.ply", "ply\nend_header\n", {"format"}},
        {"d.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face "
         "0\nend_header\n0 0\n",
         {"'z'"}},
        {"e.ply", ply.substr(0, ply.size() - 4), {"face 4 of 5"}},
        {"f.ply",
         std::string(ply).replace(ply.find("4 3 2 1 0 7") + 2, 1, "9"),
         {"face 0", "vertex 9", "5 vertices"}},
        {"g.ply", std::string(ply).replace(ply.find("0.5 0.5"), 3, "nan"), {":18", "vertex 4", "finite"}},
        {"h.ply", pyramid_binary_ply(false).substr(0, pyramid_binary_ply(false).size() - 3), {"face 4 of 5"}},
        {"i.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float "
         "y\n"
         "property float z\nelement face 2000000000\nproperty list uint int vertex_index\nend_header\n",
         {"vertex 0 of 2000000000"}},
        {"j.ply",
         "ply\nformat ascii 1.0\nelement junk 2000000000\nelement face 1\nproperty list uchar int "
         "vertex_index\nend_header\n3 0 1 2\n",
         {"face 0"}},
        {"a.stl", "", {"empty"}},
        {"b.stl", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", {":4", "facet 0"}},
        {"c.stl", std::string(triangle_stl, std::strlen(triangle_stl) - 25), {"facet 2"}},
        {"d.stl", nan_stl, {":4", "facet 0", "finite"}},
        {"e.stl", binary_stl(test::sphere(0)).substr(0, 84 + 50 * 7 + 9), {"7 of the 20 facets"}},
        {"f.stl", binary_stl(test::sphere(0)).substr(0, 60), {"begins with 'sss"}},
        {"g.stl", "solid empty\nendsolid\n", {"no faces"}},
        {"mesh.txt", "OFF\n", {".txt", ".off"}},
        {"mesh", "OFF\n", {"without an extension"}},
    };
}

TEST(MeshReader, BadFilesAreNamedWithThePlace) {
    const TemporaryFolder folder;
    for (const BadFile& bad : bad_files()) {
        const auto start = std::chrono::steady_clock::now();
        const test::Caught caught = error_of([&] { read_mesh(folder.file(bad.name, bad.content)); });
        EXPECT_TRUE(caught.threw) << bad.name;
        EXPECT_EQ(caught.code, ExitCode::input) << bad.name;
        EXPECT_NE(caught.sentence.find(folder.path(bad.name)), std::string::npos) << caught.sentence;
        for (const std::string& word : bad.words) {
            EXPECT_NE(caught.sentence.find(word), std::string::npos) << caught.sentence << " lacks " << word;
        }
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1)) << bad.name;
    }
}

TEST(MeshReader, FoldersAndMissingFilesAreErrors) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path("d.off"));
    EXPECT_EQ(error_of([&] { read_mesh(folder.path("d.off")); }).code, ExitCode::input);
    EXPECT_NE(error_of([&] { read_mesh(folder.path("none.off")); }).sentence.find("No such file"),
              std::string::npos);
}

TEST(MeshReader, NothingIsPrinted) {
    const TemporaryFolder folder;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    read_mesh(folder.file("p.obj", pyramid_obj));
    read_mesh(folder.file("b.ply", pyramid_binary_ply(true)));
    for (const BadFile& bad : bad_files()) error_of([&] { read_mesh(folder.file(bad.name, bad.content)); });
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Reading and repairing must succeed or throw coseg::Error, nothing else.
void must_not_break(const std::string& name, const std::string& content) {
    error_of([&] {
        const PolygonMesh mesh = parse_mesh(content, name).mesh;
        EXPECT_GT(mesh.face_count(), 0);
        const RepairedMesh repaired = repair(mesh, name);
        EXPECT_EQ(repaired.map.label_donor.size(), static_cast<std::size_t>(mesh.face_count()));
    });
}

TEST(MeshReader, TruncatedAnywhereEndsInSuccessOrError) {
    const std::vector<std::pair<std::string, std::string>> files{
        {"f.off", pyramid_off},  {"f.obj", pyramid_obj},
        {"f.ply", pyramid_ply},  {"g.ply", pyramid_binary_ply(false)},
        {"f.stl", triangle_stl}, {"g.stl", binary_stl(test::sphere(0)).substr(0, 84 + 50 * 4)}};
    for (const auto& [name, content] : files) {
        for (std::size_t length = 0; length < content.size(); ++length)
            must_not_break(name, content.substr(0, length));
    }
}

TEST(MeshReader, FlippedBytesEndInSuccessOrError) {
    const std::vector<std::pair<std::string, std::string>> files{{"f.off", pyramid_off},
                                                                 {"f.obj", pyramid_obj},
                                                                 {"f.ply", pyramid_ply},
                                                                 {"g.ply", pyramid_binary_ply(false)},
                                                                 {"h.ply", pyramid_binary_ply(true)},
                                                                 {"f.stl", triangle_stl},
                                                                 {"g.stl", binary_stl(test::sphere(0))}};
    SeededStream random(7);
    for (const auto& [name, content] : files) {
        for (int round = 0; round < 3000; ++round) {
            std::string mutated = content;
            const int flips = 1 + static_cast<int>(random() % 4);
            for (int k = 0; k < flips; ++k) {
                char& byte = mutated[random() % mutated.size()];
                byte = random() % 2 == 0 ? static_cast<char>(random())
                                         : static_cast<char>(byte ^ (1 << random() % 8));
                if (random() % 4 == 0) byte = "0123456789 -\n.ef/#"[random() % 18];
            }
            must_not_break(name, mutated);
        }
    }
}

TEST(MeshReader, RealMeshesHaveTheCountsOfTheirHeaders) {
    const std::vector<std::string> meshes = test::real_meshes();
    if (meshes.empty()) GTEST_SKIP() << "no real meshes; set COSEG_DATA";
    for (std::size_t i = 0; i < meshes.size(); i += 5) {
        std::ifstream file(meshes[i]);
        std::string magic;
        int vertices = 0;
        int faces = 0;
        file >> magic >> vertices >> faces;
        const PolygonMesh mesh = read_mesh(meshes[i]);
        EXPECT_EQ(mesh.vertex_count(), vertices) << meshes[i];
        EXPECT_EQ(mesh.face_count(), faces) << meshes[i];
        double edges = 0.0;
        double x = 0.0;
        file >> edges >> x;
        EXPECT_EQ(mesh.vertices[0].x(), x) << meshes[i];
    }
}

const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

TEST(CheckedPolygons, AreThoseThatAreGiven) {
    const std::vector<int> corners = {0, 1, 2, 3, 0, 2, 2};
    const std::vector<int> offsets = {0, 4, 4, 7};
    const ParsedMesh parsed = checked_polygons({square, corners, offsets}, "shape 0");
    EXPECT_EQ(parsed.mesh.offsets, offsets);
    EXPECT_EQ(parsed.mesh.corners, corners);
    EXPECT_EQ(parsed.mesh.vertices[2], Eigen::Vector3d(1, 1, 0));
    EXPECT_TRUE(parsed.warnings.empty());
    const std::vector<int> triangles = {0, 1, 2, 0, 2, 3};
    EXPECT_EQ(checked_polygons({square, triangles, {}}, "").mesh.offsets, (std::vector<int>{0, 3, 6}));
}

TEST(CheckedPolygons, UnusableVerticesMayBeThereWithoutAFace) {
    std::vector<double> vertices = square;
    vertices.insert(vertices.begin(), {NAN, 0, 0});
    const std::vector<int> corners = {1, 2, 3};
    const ParsedMesh parsed = checked_polygons({vertices, corners, {}}, "shape 0");
    EXPECT_EQ(parsed.mesh.vertex_count(), 4);
    EXPECT_EQ(parsed.mesh.corners, (std::vector<int>{0, 1, 2}));
    ASSERT_EQ(parsed.warnings.size(), 1U);
    const std::vector<int> used = {1, 2, 3, 0, 1, 2};
    const test::Caught caught = test::error_of([&] { checked_polygons({vertices, used, {}}, "shape 0"); });
    EXPECT_EQ(caught.sentence.find("shape 0: vertex 0"), 0U) << caught.sentence;
}

TEST(CheckedPolygons, RefuseWhatIsNoMesh) {
    const auto sentence = [](const std::vector<int>& corners, const std::vector<int>& offsets) {
        return test::error_of([&] { checked_polygons({square, corners, offsets}, "shape 5"); }).sentence;
    };
    EXPECT_EQ(sentence({0, 1, 2, 0, 2, 4}, {}).find("shape 5: face 1 refers to vertex 4, but there are 4"),
              0U);
    EXPECT_EQ(sentence({0, 1, -1}, {}).find("shape 5: face 0 refers to vertex -1"), 0U);
    EXPECT_NE(sentence({0, 1, 2, 3}, {}).find("without offsets"), std::string::npos);
    for (const std::vector<int>& offsets : {std::vector<int>{0, 3}, {1, 4}, {0, 3, 2, 4}, {0, 5}})
        EXPECT_NE(sentence({0, 1, 2, 3}, offsets).find("offsets"), std::string::npos);
    EXPECT_NE(sentence({}, {}).find("no faces"), std::string::npos);
    EXPECT_NE(sentence({0, 1, 1}, {}).find("no area"), std::string::npos);
}

}  // namespace
}  // namespace coseg
